"""members.parquet: one row for every member, SI, written a batch at a time."""

from collections.abc import Iterable, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from slipwise.arrays import Array
from slipwise.record import atomic
from slipwise.studies.ensemble.distributions import Varied
from slipwise.studies.ensemble.responses import RESPONSES

#: Rows that are held at once.
_ROWS = 4096


def write_members(
    rows: Iterable[dict[str, Any]], varied: Sequence[Varied], path: Path, *, of_models: bool = False
) -> None:
    """Write the table; the same rows give the same bytes.

    Args:
        rows: motion, scale, member, the drawn values by key, and what `run_shaken` gives.
        varied: what was drawn.
        path: of the file.
        of_models: whether rows also say of which "model" they are.
    """
    schema = _schema(varied)
    if of_models:
        schema = schema.insert(0, pa.field("model", pa.string(), nullable=False))
    with atomic(path) as stream, pq.ParquetWriter(stream, schema, compression="zstd") as writer:
        left = iter(rows)
        while batch := list(islice(left, _ROWS)):
            writer.write_table(pa.Table.from_pylist(batch, schema=schema))


def responses_of(path: Path, motion: str, scale: float) -> tuple[dict[str, Array], int]:
    """Return the responses of one motion at one scale.

    Returns:
        Name -> values of the members that were finished [SI], and how many diverged.
    """
    names = [response.name for response in RESPONSES]
    chosen = (pc.field("motion") == motion) & (pc.field("scale") == scale)
    table = pq.read_table(path, columns=[*names, "failed"], filters=chosen)
    whole = table.filter(table["failed"].is_null())
    values = {name: np.asarray(whole[name].to_numpy(), dtype=float) for name in names}
    return values, len(table) - len(whole)


def _schema(varied: Sequence[Varied]) -> pa.Schema:
    fields = [
        pa.field("motion", pa.string(), nullable=False),
        pa.field("scale", pa.float64(), nullable=False, metadata={"unit": "1"}),
        pa.field("member", pa.int64(), nullable=False),
        *(pa.field(v.key, pa.float64(), nullable=False, metadata={"unit": v.unit}) for v in varied),
    ]
    for response in RESPONSES:
        kind = pa.int64() if response.name == "uplifts" else pa.float64()
        fields.append(pa.field(response.name, kind, metadata={"unit": response.unit, "meaning": response.meaning}))
    fields += [pa.field("buffer_hit", pa.bool_()), pa.field("failed", pa.string())]
    return pa.schema(fields, metadata={"slipwise": "members 1"})
