"""The catalogue as people read it."""

import io
import json

import numpy as np
import pytest
from rich.console import Console

from slipwise.effects import Effect, catalogue
from slipwise.studies.demonstration import demonstrate
from slipwise.view.figures.effect_picture import effect_picture
from slipwise.view.figures.style import styled
from slipwise.view.words.effects import effect_rows, effects_table, print_effect, print_effects

every_effect = pytest.mark.parametrize("effect", catalogue().values(), ids=list(catalogue()))


def test_rows_hold_all_that_a_program_may_ask_for() -> None:
    rows = effect_rows()
    assert json.loads(json.dumps(rows, allow_nan=False)) == rows
    assert {row["name"] for row in rows} == set(catalogue())
    heating = next(row for row in rows if row["name"] == "heating")
    assert heating["valid"].startswith("up to about 250 degC") and "Source" not in heating["valid"]
    assert heating["source"].startswith("Kumar") and "\n" not in heating["source"]
    assert [p["name"] for p in heating["parameters"]] == ["share", "lump", "cooling", "cover", "remains"]


def test_numbers_are_in_the_unit_that_stands_beside_them() -> None:
    row = effect_rows([catalogue()["shear_rate"]])[0]
    found = {p["name"]: (p["typical"], p["unit"]) for p in row["parameters"]}
    assert found == {"strength": (1.379, "MPa"), "rate": (0.197, "s/cm"), "slow": (0.046, "1")}


@every_effect
def test_an_effect_is_shown_where_it_does_something(effect: Effect) -> None:
    shown = demonstrate(effect)
    assert shown.x.shape == shown.base.shape == shown.changed.shape
    assert np.isfinite(shown.base).all() and np.isfinite(shown.changed).all()
    assert not np.array_equal(shown.base, shown.changed)


def test_a_picture_shows_both_curves_and_what_the_effect_adds() -> None:
    with styled():
        above, below = effect_picture(catalogue()["breakaway"]).axes
    base, ours = (line.get_ydata() for line in above.lines)
    np.testing.assert_allclose(below.lines[0].get_ydata(), np.subtract(ours, base), atol=1e-12)
    assert "kN" in above.get_ylabel() and "mm" in below.get_xlabel()


def test_the_terminal_says_equation_numbers_and_rivals() -> None:
    out = io.StringIO()
    print_effect(catalogue()["breakaway"], Console(file=out, width=160))
    text = out.getvalue()
    for needed in ("mu += dmu", "Valid:", "Source:", "mm/s", "rate_and_state", "breakaway.py"):
        assert needed in text
    out = io.StringIO()
    print_effects(console=Console(file=out, width=200))
    assert all(name in out.getvalue() for name in catalogue())


def test_the_table_of_effects_has_a_row_for_every_effect() -> None:
    table = effects_table()
    for name in catalogue():
        assert f"| `{name}` |" in table
    rows = [line for line in table.splitlines() if line.startswith("|")]
    assert all(line.replace("\\|", "").count("|") == 5 for line in rows), "bars inside a cell are escaped"


def test_the_table_of_effects_says_which_effects_are_confused_with_which() -> None:
    rows = {line.split("`")[1]: line for line in effects_table().splitlines() if line.startswith("| `")}
    for name, effect in catalogue().items():
        written = rows[name].rsplit("|", 2)[1]
        assert written.strip() == ", ".join(f"`{rival}`" for rival in effect.confused_with)
