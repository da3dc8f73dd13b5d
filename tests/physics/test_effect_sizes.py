"""How much each effect matters on an earthquake, against an independent planar simulator (physics of the design, 4)."""

import math
import runpy
from functools import cache
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

SCRIPT = runpy.run_path(str(Path(__file__).parents[2] / "scripts" / "01_sizes_of_effects.py"))
ROWS, COLUMNS = SCRIPT["ROWS"], SCRIPT["COLUMNS"]
#: (effect, column) that differ by more, and why.
INACTIVE = {
    # 0.4 against 4 %, although the load of pad A agrees (43 against 43 %); how its key rubs is not told.
    ("key_friction 0.15", "slip"),
}


@cache
def ours() -> dict[str, dict[str, float]]:
    numbers = SCRIPT["sizes"]()
    names = ["base", *(row.name for row in ROWS)]
    return {name: dict(zip(COLUMNS, n, strict=True)) for name, n in zip(names, numbers, strict=True)}


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_every_row_has_the_order_of_magnitude_of_the_other_program(row) -> None:
    for column, theirs in zip(COLUMNS, row.expected, strict=True):
        if not math.isnan(theirs) and theirs >= 2.0 and (row.name, column) not in INACTIVE:
            assert 1 / 3 < ours()[row.name][column] / theirs < 3.0, column


def test_what_is_blind_at_pad_level_is_blind_here_too() -> None:
    """Buffers, keys, seating, table: below 2 % at pad level, where the friction law itself is right."""
    for row in ROWS:
        if row.expected[-1] <= 0.1:
            assert ours()[row.name]["pad level"] < 2.0, row.name


def test_signs_that_do_not_hang_on_the_realisation_agree() -> None:
    """Over twelve seeds these have one sign each; stiffness, gaps and pre-sliding turn theirs with the spectrum."""
    base = ours()["base"]
    for name, slip, energy in (
        ("mu +5 %", -1, 0), ("heating", 1, 0), ("buffer_damping 4 %", -1, -1), ("table_gain -5 %", -1, -1)
    ):  # fmt: skip
        row = ours()[name]
        assert slip * (row["max slip"] - base["max slip"]) > 0.0, name
        assert energy * (row["E"] - base["E"]) >= 0.0, name


def test_an_instrument_changes_no_motion() -> None:
    for name in ("channel_delay 5 ms", "load_crosstalk 1 %", "cell_inertia 30 kg", "channel_gain 3 %"):
        assert ours()[name]["slip"] == 0.0 and ours()[name]["pad level"] > 2.0
