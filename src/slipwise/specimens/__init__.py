"""Several specimens of one kind: one law over their campaigns, whose sizes vary from specimen to specimen."""

from slipwise.specimens.result import JointEffect, NumberOverSpecimens, SpecimensReport
from slipwise.specimens.specimen import SpecimenStatistics, make_specimen
from slipwise.specimens.specimen_file import read_specimen, write_specimen

__all__ = [
    "JointEffect",
    "NumberOverSpecimens",
    "SpecimenStatistics",
    "SpecimensReport",
    "make_specimen",
    "read_specimen",
    "write_specimen",
]
