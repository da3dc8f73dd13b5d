"""Every form: its slopes against finite differences, its text as a scalar law, and files that break the contract."""

import math
from pathlib import Path

import numpy as np
import pytest

from slipwise.discovery.form import FUNCTIONS, forms, read_form
from slipwise.errors import SettingError

STATES = np.array([-2.3, -0.4, 0.7, 1.9])
SCALARS = {name: getattr(math, name, None) or {"abs": abs, "max": max, "min": min}[name] for name in FUNCTIONS}


def constants(form) -> dict[str, float]:
    return {c.name: 0.6 + 0.3 * i for i, c in enumerate(form.constants)}


def states(form) -> np.ndarray:
    return np.abs(STATES) if form.sized else STATES


@pytest.mark.parametrize("form", forms().values(), ids=lambda f: f.name)
def test_slopes_are_those_of_the_value(form) -> None:
    here, s = constants(form), states(form)
    for c in form.constants:
        if c.kind == "reference":
            continue
        step = 1e-6
        above, below = (form.at(s, {**here, c.name: here[c.name] + x}) for x in (step, -step))
        np.testing.assert_allclose(form.slopes(s, here)[c.name], (above - below) / (2 * step), rtol=1e-5, atol=1e-8)


@pytest.mark.parametrize("form", forms().values(), ids=lambda f: f.name)
def test_the_text_gives_the_same_for_one_number(form) -> None:
    """The same text stands in the effect file, where plain Python evaluates it."""
    here = constants(form)
    for s in states(form):
        one = eval(form.value, {"__builtins__": {}}, {**SCALARS, **here, "s": float(s)})
        assert one == pytest.approx(float(form.at(np.array([s]), here)[0]), rel=1e-12)


@pytest.mark.parametrize("form", forms().values(), ids=lambda f: f.name)
def test_a_form_contains_what_it_says(form) -> None:
    for name in form.contains:
        assert name in forms()


def test_a_file_without_form_is_told_what_it_needs(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text('"""Mine."""\n', encoding="utf-8")
    with pytest.raises(SettingError, match="needs a docstring that says the form in words, and FORM"):
        read_form(path)


def test_a_text_that_calls_what_there_is_not_is_told_what_there_is(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text(
        '"""Mine."""\nfrom slipwise.discovery.form import Form\nFORM = Form("__import__(\'os\').getcwd()")\n',
        encoding="utf-8",
    )
    with pytest.raises(SettingError, match="cannot be evaluated .* it may use s, its constants, arithmetic and exp"):
        read_form(path)
