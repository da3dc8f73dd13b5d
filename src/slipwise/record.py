"""A record: channels over time, measured or simulated, with its provenance.

Inside, every channel is SI. Parquet files are SI with unit, sign and place beside every column; CSV files are in the
units that people read, named in the header as "pad_A_N [kN]".
"""

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from slipwise.arrays import Array
from slipwise.channels import PADS, channel, pads_in, part_of
from slipwise.display import Drawn, frame
from slipwise.errors import InputError, SettingError
from slipwise.input_file import check_input
from slipwise.jobs.atomic_write import atomic
from slipwise.units import parse_unit

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, repr=False)
class Record(Drawn):
    """Channels that share one time axis.

    Attributes:
        time: (n,) [s].
        channels: name -> (n,) in the SI unit of `channels.channel(name)`.
        provenance: what made it, as JSON can hold it (versions, rig, model, motion, settings, hashes).
    """

    time: Array
    channels: Mapping[str, Array]
    provenance: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse columns of unequal length and names that are no channels."""
        for name, values in self.channels.items():
            channel(name)
            if values.shape != self.time.shape:
                raise SettingError(f"channel {name!r} has {values.shape} values, time has {self.time.shape}")

    def __getitem__(self, name: str) -> Array:
        """Return one channel (n,).

        Raises:
            InputError: the record does not hold it; the message lists what it holds.
        """
        if name == "time":
            return self.time
        if name not in self.channels:
            raise InputError(f"this record has no channel {name!r}; it has: {', '.join(sorted(self.channels))}")
        return self.channels[name]

    def __contains__(self, name: str) -> bool:
        return name in self.channels

    def __len__(self) -> int:
        return len(self.time)

    @property
    def dt(self) -> float:
        """Sampling step [s]: the median, so that single dropped samples do not move it."""
        return float(np.median(np.diff(self.time)))

    def stacked(self, pattern: str, pads: Sequence[str] | None = None) -> Array:
        """Return the pads' channels as (n, n_pads), e.g. `stacked("pad_{}_N")`.

        Args:
            pattern: of their names.
            pads: which; all of which the record has this channel when not given, in the order of their names.

        Raises:
            InputError: the record lacks one of them, or has none.
        """
        named = pads_in(n for n in self.channels if n == pattern.format(part_of(n)[1])) if pads is None else pads
        return np.stack([self[pattern.format(pad)] for pad in named or PADS], axis=1)

    def has_all(self, *names: str) -> bool:
        """Return whether every one of these channels is there.

        Args:
            *names: of channels.
        """
        return all(name in self.channels for name in names)

    def replaced(self, **channels: Array) -> "Record":
        """Return a record with these channels added or replaced.

        Args:
            **channels: name -> samples (n,) in the channel's SI unit.
        """
        return Record(self.time, {**self.channels, **channels}, self.provenance)

    def between(self, start: float, end: float) -> "Record":
        """Return the part with start <= time <= end [s].

        Args:
            start: first time that is kept [s].
            end: last time that is kept [s].
        """
        inside = (self.time >= start) & (self.time <= end)
        return Record(self.time[inside], {n: v[inside] for n, v in self.channels.items()}, self.provenance)

    def to_pandas(self) -> "DataFrame":
        """Return time and channels as the columns of a pandas frame, SI.

        Raises:
            InputError: pandas is not installed.
        """
        return frame({"time": self.time, **self.channels})

    def _headline(self) -> str:
        if len(self) < 2:
            return f"{len(self.channels)} channels, {len(self)} samples"
        return f"{len(self.channels)} channels, {len(self)} samples of {self.dt:.4g} s"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"channel": n, "unit": channel(n).unit, "smallest": float(v.min()), "largest": float(v.max())}
            for n, v in self.channels.items()
            if len(v)
        ]


def write_text(path: Path, text: str) -> None:
    """Write a text file so that it is there whole or not at all.

    Raises:
        OutputError: it cannot be written.
    """
    with atomic(path, "w") as stream:
        stream.write(text)


def write_json(path: Path, content: object) -> None:
    """Write JSON so that it is there whole or not at all; NaN is refused, it is not JSON."""
    write_text(path, json.dumps(content, indent=1, allow_nan=False) + "\n")


def write_record(record: Record, path: Path) -> None:
    """Write a record; ".parquet" (SI, metadata in the schema) or ".csv" (units of the table of channels).

    The same record gives the same bytes.

    Args:
        record: what is written.
        path: of the file, NAME.parquet or NAME.csv.

    Raises:
        SettingError: another suffix.
        OutputError: it cannot be written.
    """
    if path.suffix == ".parquet":
        with atomic(path) as stream:
            _write_parquet(record, stream)
    elif path.suffix == ".csv":
        with atomic(path) as stream:
            _write_csv(record, stream)
    else:
        raise SettingError(
            f"{path.name}: a record is written as .parquet or .csv, not {path.suffix or 'without a suffix'}"
        )


def _write_parquet(record: Record, stream: IO[bytes]) -> None:
    fields, columns = [], []
    for name, values in (("time", record.time), *record.channels.items()):
        known = channel(name)
        about = {"unit": known.unit, "sign": known.sign, "place": known.place}
        fields.append(pa.field(name, pa.float64(), nullable=False, metadata=about))
        columns.append(pa.array(np.ascontiguousarray(values)))
    provenance = json.dumps(record.provenance, sort_keys=True)
    schema = pa.schema(fields, metadata={"slipwise": "record 1", "provenance": provenance})
    pq.write_table(pa.Table.from_arrays(columns, schema=schema), stream, compression="zstd")


def _write_csv(record: Record, stream: IO[bytes]) -> None:
    names = ["time", *record.channels]
    shown = [channel(name) for name in names]
    # A column in degC would need an offset: temperatures stay in kelvin in CSV.
    units = [c.unit if c.shown_in == "degC" else c.shown_in for c in shown]
    factors = [1.0 / parse_unit(unit, c.unit, name) for name, unit, c in zip(names, units, shown, strict=True)]
    table = np.stack([record.time, *record.channels.values()], axis=1) * np.array(factors)
    text = io.TextIOWrapper(stream, encoding="utf-8", newline="\n", write_through=True)
    text.write(",".join(f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)) + "\n")
    np.savetxt(text, table, delimiter=",", fmt="%.10g")
    text.detach()


def read_record(path: Path | str) -> Record:
    """Read a record that `write_record` wrote as parquet.

    Args:
        path: of the file, record.parquet.

    Raises:
        InputError: no such file, not a parquet file, or not written by Slipwise.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"{path}: no such file; `slipwise replay MOTION --out DIR` writes a record.parquet")
    try:
        table = pq.read_table(check_input(path))
    except (pa.ArrowInvalid, OSError) as error:
        raise InputError(f"{path}: not a readable parquet file ({error})") from None
    about = table.schema.metadata or {}
    if b"slipwise" not in about or "time" not in table.column_names:
        raise InputError(
            f"{path}: this parquet file is no Slipwise record (it has no 'slipwise' mark); name it in a campaign.toml"
        )
    columns = {name: table.column(name).to_numpy().astype(float) for name in table.column_names}
    time = columns.pop("time")
    return Record(time, columns, json.loads(about.get(b"provenance", b"{}")))
