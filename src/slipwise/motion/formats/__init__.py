"""The formats that are read, one file each; a file's format is found from its content."""

from collections.abc import Callable
from dataclasses import dataclass

from slipwise.motion.formats import columns, csmip_v2, geonet_v2a, jma_csv, knet, peer_at2, slipwise_csv, usgs_smc
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
    """

    name: str
    note: str
    recognise: Callable[[bytes], bool]
    read: Callable[[SourceFile, Given], list[Trace]]


#: In the order in which they are tried; plain columns take what has nothing but numbers, so they come last.
FORMATS: tuple[Format, ...] = (
    Format("GeoNet V2A", "three components a file", geonet_v2a.recognise, geonet_v2a.read),
    Format("CSMIP/CESMD V2", "all channels in a file, both dialects", csmip_v2.recognise, csmip_v2.read),
    Format("JMA CSV", "three components a file, Shift-JIS", jma_csv.recognise, jma_csv.read),
    Format("K-NET and KiK-net ASCII", "one component a file; the mean is removed", knet.recognise, knet.read),
    Format("USGS SMC", "one component a file", usgs_smc.recognise, usgs_smc.read),
    Format("Slipwise CSV", "the table's channels of a motion or a run", slipwise_csv.recognise, slipwise_csv.read),
    Format("PEER AT2", "one component a file", peer_at2.recognise, peer_at2.read),
    Format(
        "text columns",
        "acceleration, or time and acceleration; give --motion-dt and --unit where the file does not state them",
        columns.recognise,
        columns.read,
    ),
)
