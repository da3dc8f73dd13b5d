"""The specimen on the shaking table: rated values, similarity, and the compiled model."""

from slipwise.rig.build import Rig, build, check_step, largest_step, pad_frequencies
from slipwise.rig.files import RIGS
from slipwise.rig.load import load_specimen
from slipwise.rig.mjcf.writer import storey_names
from slipwise.rig.new_rig import new_rig, write_mjcf
from slipwise.rig.places import Buffer, Place
from slipwise.rig.readings import Readings, read_paper
from slipwise.rig.similarity import LENGTH_SCALE, Similarity, similarity
from slipwise.rig.specimen import Specimen
from slipwise.rig.storeys import Storey, fixed_base_frequencies

__all__ = [
    "LENGTH_SCALE",
    "Buffer",
    "Place",
    "RIGS",
    "Readings",
    "Rig",
    "Similarity",
    "Specimen",
    "Storey",
    "build",
    "check_step",
    "fixed_base_frequencies",
    "largest_step",
    "load_specimen",
    "new_rig",
    "pad_frequencies",
    "read_paper",
    "similarity",
    "storey_names",
    "write_mjcf",
]
