"""The formats that are read, one file each; a file's format is found from its content."""

from collections.abc import Callable
from dataclasses import dataclass

from slipwise.motion.formats import (
    abaqus_amplitude,
    columns,
    cosmos,
    csmip_v1,
    csmip_v2,
    csmnc,
    cwb,
    data_file,
    geonet_v2a,
    jma_csv,
    knet,
    midas_sgs,
    peer_at2,
    seismology,
    slipwise_csv,
    unam_asa,
    usgs_smc,
)
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given
from slipwise.motion.trace import Trace


@dataclass(frozen=True)
class Format:
    """One format.

    Attributes:
        name: as people call it.
        note: what a user should know of it.
        recognise: tells it from the first bytes of a file.
        read: gives the components of a file.
        binary: whether its files are no text.
    """

    name: str
    note: str
    recognise: Callable[[bytes], bool]
    read: Callable[[SourceFile, Given], list[Trace]]
    binary: bool = False


#: In the order in which they are tried; plain columns take what has nothing but numbers, so they come last.
FORMATS: tuple[Format, ...] = (
    Format(
        "SAC and miniSEED",
        "read by obspy (pip install 'slipwise[seismology]'); give --unit",
        seismology.recognise,
        seismology.read,
        binary=True,
    ),
    Format(
        "workbooks, MATLAB, Parquet and LabVIEW files",
        "tables as in campaigns (.xlsx, .mat, .parquet, .tdms), with the extras that read them",
        data_file.recognise,
        data_file.read,
        binary=True,
    ),
    Format("COSMOS", "V1 and V2; velocity and displacement are left out", cosmos.recognise, cosmos.read),
    Format("GeoNet V2A", "three components a file; V1A, uncorrected, too", geonet_v2a.recognise, geonet_v2a.read),
    Format(
        "CSMIP/CESMD V2",
        "all channels in a file or one, both dialects; choose by direction or number (--x 'Chan 3')",
        csmip_v2.recognise,
        csmip_v2.read,
    ),
    Format(
        "CSMIP/CESMD V1",
        "uncorrected, at equal steps; one digitized from film is refused",
        csmip_v1.recognise,
        csmip_v1.read,
    ),
    Format("CSMIP/CESMD V3", "spectra: refused by name", csmip_v1.recognise_spectra, csmip_v1.refuse_spectra),
    Format("CWB/TSMIP", "time and three components", cwb.recognise, cwb.read),
    Format("CSMNC", "one component a file", csmnc.recognise, csmnc.read),
    Format("UNAM ASA", "all channels in a file", unam_asa.recognise, unam_asa.read),
    Format("JMA CSV", "three components a file, Shift-JIS", jma_csv.recognise, jma_csv.read),
    Format("K-NET and KiK-net ASCII", "one component a file; the mean is removed", knet.recognise, knet.read),
    Format("USGS SMC", "one component a file", usgs_smc.recognise, usgs_smc.read),
    Format("Slipwise CSV", "the table's channels of a motion or a run", slipwise_csv.recognise, slipwise_csv.read),
    Format("MIDAS time function", "keywords name both axes", midas_sgs.recognise, midas_sgs.read),
    Format("Abaqus amplitude", "each is a component; give --unit", abaqus_amplitude.recognise, abaqus_amplitude.read),
    Format("PEER AT2", "one component a file", peer_at2.recognise, peer_at2.read),
    Format(
        "text columns",
        "acceleration, or time and acceleration, one or several values a line; step, unit, count, peak, component and "
        "station are taken from the header (ESM/ITACA and AFAD .asc, 'KEY: value', 'npts dt'); give --motion-dt and "
        "--unit where it does not state them",
        columns.recognise,
        columns.read,
    ),
)
