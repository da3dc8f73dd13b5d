"""Workbooks, MATLAB, Parquet and LabVIEW files as motions: their tables are read as in a campaign."""

from slipwise.motion.column_traces import column_traces
from slipwise.motion.named_table import file_table
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given
from slipwise.motion.trace import Trace

#: How these files begin: ZIP, MATLAB 5 and 7.3, HDF5, Parquet, TDMS, MDF.
_BEGINNINGS = (b"PK\x03\x04", b"MATLAB ", b"\x89HDF", b"PAR1", b"TDSm", b"MDF ")


def recognise(head: bytes) -> bool:
    """Return whether a file begins as one of these formats does."""
    return head.startswith(_BEGINNINGS)


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every column of acceleration.

    Raises:
        InputError: the file cannot be read, or states no step, or its times do not rise evenly.
        UnitError: no unit, or one that is none of acceleration.
    """
    return column_traces(file_table(source), source, given)
