"""Effect files that the program writes: they read, run and look like the catalogue's, whatever words they are given."""

import ast
import shutil
import subprocess
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shaking import shaken, sine
from slipwise.effects import (
    DERIVED,
    HOOKS,
    LAGGING,
    PORTS,
    Effect,
    WrittenEffect,
    WrittenHook,
    effect_text,
    load_effect,
    skeleton,
    write_effect,
)
from slipwise.errors import OutputError, SettingError, UnknownNameError
from slipwise.params import Parameter
from slipwise.simulation.kernel import engine_for
from slipwise.testing.driven import answers, arrays, bridge, motion, with_effect
from slipwise.view.words.effects import effect_rows

ROOT = Path(__file__).parents[3]
every_port = pytest.mark.parametrize("port", PORTS)
#: Words that would end a docstring, a string, a comment or a line, or pass for a heading, if they were let.
HOSTILE = 'C:\\tests\\new "March" """\nimport os\r\x00\x1b[31m\u202e\u2028 \'\'\' Valid: never Source: {{ 7 }} 試験 \\'


def found(**changes: Any) -> WrittenEffect:
    """An effect as a program finds one: two hooks, a derived state that lags, a memory."""
    effect = WrittenEffect(
        name="late_load",
        title="friction follows a late load",
        equation="mu *= 1 + c (N_l/N - 1)",
        about=("Found in the residuals of one campaign.",),
        valid="10 to 30 kN.",
        source="fitted.",
        port="shear",
        component="pad friction",
        hooks=(
            WrittenHook(
                "coefficient",
                ("coefficient", "load", "lagged_load", "memory", "strength", "time_constant"),
                "scale the coefficient of friction [1]",
                (
                    "late = lagged_load / load",
                    "return coefficient * (1.0 + strength * tanh(late - 1.0)) + 0.0 * memory[0]",
                ),
            ),
            WrittenHook("rest", ("memory", "seconds"), "forget", ("memory[0] *= exp(-seconds)",)),
        ),
        parameters=(
            Parameter("strength", "1", 0.2, -0.5, 0.5, 0.0, "fitted", "c: size"),
            Parameter("time_constant", "s", 0.03, 1e-3, 1.0, None, "fitted", "t_c: of the lag", "ms"),
        ),
        signature="odd, in step with the rate of the load",
        confused_with={"channel_delay": "a delay shows in the balances too"},
        memory=("late",),
    )
    return replace(effect, **changes)


def body(*lines: str, arguments: tuple[str, ...] = ("coefficient", "strength")) -> WrittenEffect:
    """The same with one hook of these lines and one parameter."""
    hook = WrittenHook("coefficient", arguments, "change the coefficient", lines)
    return found(hooks=(hook,), parameters=found().parameters[:1], memory=())


def hostile() -> WrittenEffect:
    """Every text of it comes from elsewhere."""
    words = HOSTILE * 3
    texts = dict.fromkeys(("title", "equation", "valid", "source", "component", "signature"), words)
    told = tuple(replace(p, source=words, meaning=words, shown_in=HOSTILE) for p in found().parameters)
    hooks = tuple(replace(h, words=words) for h in found().hooks)
    return found(**texts, about=(words, words), parameters=told, hooks=hooks, confused_with={"run_in": words})


def parts(text: str) -> list[str]:
    """Kinds and names of what stands at the top of a file; of imports only the modules."""
    tree = ast.parse(text)
    names = {ast.FunctionDef: "name", ast.ImportFrom: "module"}
    return [f"{type(n).__name__} {getattr(n, names.get(type(n), ''), '')}".strip() for n in tree.body]


PARTS = [
    *("Expr", "ImportFrom math", "Import", "ImportFrom slipwise.effects", "ImportFrom slipwise.params"),
    *("FunctionDef coefficient", "FunctionDef rest", "Assign"),
]


def test_a_written_file_is_an_effect_that_says_what_it_was_given(tmp_path: Path) -> None:
    effect = load_effect(write_effect(found(), tmp_path / "new"))
    assert effect.path == (tmp_path / "new" / "late_load.py").resolve()
    assert effect.parameters == found().parameters and effect.memory == ("late",)
    assert effect.derived == ("lagged_load",) and set(effect.hooks) == {"coefficient", "rest"}
    (row,) = effect_rows([effect])
    assert row["summary"] == "Friction follows a late load." and row["equation"] == "mu *= 1 + c (N_l/N - 1)"
    assert (row["valid"], row["source"]) == ("10 to 30 kN.", "fitted.")
    assert row["confused_with"] == {"channel_delay": "a delay shows in the balances too"}
    law = effect.hooks["coefficient"]
    asked = {"coefficient": 0.1, "load": 2.0, "lagged_load": 1.0, "memory": np.zeros(1), "time_constant": 1.0}
    assert law(**asked, strength=0.5) == pytest.approx(0.1 * (1.0 - 0.5 * np.tanh(0.5)))


def test_only_what_the_bodies_use_is_imported() -> None:
    text = effect_text(found())
    assert parts(text) == PARTS
    assert "from math import exp, tanh\n\nimport numpy as np\n" in text
    plain = effect_text(body("pi = 3.0", "return coefficient * strength * pi"))
    assert "math" not in plain and "numpy" not in plain, "a local of that name is the file's own"


def test_words_from_elsewhere_stay_words(tmp_path: Path) -> None:
    text = effect_text(hostile())
    assert parts(text) == PARTS
    assert not {c for c in text if not c.isprintable()} - {"\n"}
    effect = load_effect(write_effect(replace(hostile(), component="pad friction"), tmp_path))
    (row,) = effect_rows([replace(effect, parameters=())])
    assert row["valid"] == row["source"], "both were given the same words, and neither swallows the other"
    assert "{{ 7 }}" in row["valid"] and "試験" in row["valid"]


@settings(deadline=None, max_examples=60)
@given(st.text(max_size=400))
def test_no_text_whatever_adds_a_statement_or_a_long_line_of_words(words: str) -> None:
    text = effect_text(
        found(title=words, about=(words,), source=words, signature=words, confused_with={"run_in": words})
    )
    assert parts(text) == PARTS
    assert max(map(len, text[: text.index("from math")].splitlines())) <= 120


def mended_by_ruff(written: WrittenEffect, *asked: str) -> str:
    """What ruff says of a file of the catalogue with this text; nothing where all is well."""
    if shutil.which("ruff") is None:
        pytest.skip("ruff is not installed: pip install -e '.[dev]'")
    done = subprocess.run(
        ["ruff", *asked, "--stdin-filename", "src/slipwise/effects/mine.py", "-"],
        input=effect_text(written),
        capture_output=True,
        encoding="utf-8",
        cwd=ROOT,
    )
    return done.stdout + done.stderr if done.returncode else ""


@pytest.mark.parametrize("written", [found(), hostile()], ids=["found", "hostile"])
def test_ruff_finds_nothing_but_long_lines(written: WrittenEffect) -> None:
    assert mended_by_ruff(written, "check", "--ignore", "E501") == ""


@every_port
def test_ruff_neither_finds_nor_formats_anything_in_a_skeleton(port: str) -> None:
    assert mended_by_ruff(skeleton("mine", port), "check") == ""
    assert mended_by_ruff(skeleton("mine", port), "format", "--diff") == ""


def test_a_long_law_of_many_arguments_runs(tmp_path: Path) -> None:
    many = tuple(name for name in HOOKS["coefficient"].inputs if name not in LAGGING and name != "coefficient")
    law = " + ".join(f"strength * {name}" for name in many)
    text = effect_text(body(f"return coefficient + {law}", arguments=("coefficient", *many, "strength")))
    (tmp_path / "long_law.py").write_text(text, encoding="utf-8")
    hook = load_effect(tmp_path / "long_law.py").hooks["coefficient"]
    assert hook(coefficient=1.0, strength=0.5, **dict.fromkeys(many, 2.0)) == 1.0 + len(many)


@pytest.mark.parametrize(
    ("written", "error", "says"),
    [
        (body("return coefficient +"), SettingError, "invalid syntax.*must be Python"),
        (body('return """'), SettingError, "must be Python"),
        (body("x = 1.0\nimport os"), SettingError, "one line of text"),
        (body("return coefficient * strenth"), UnknownNameError, "did you mean strength"),
        (body("return coefficient", arguments=("coefficient=print(1)",)), SettingError, "no name in Python"),
        (found(port="sheer"), UnknownNameError, "did you mean shear"),
        (found(port="area"), UnknownNameError, "hook of port 'area'"),
        (found(memory=("a b",)), SettingError, "'a b'.*no name in Python"),
        (found(confused_with={"class": ""}), SettingError, "'class'"),
    ],
)
def test_what_is_no_effect_is_refused(written: WrittenEffect, error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says):
        effect_text(written)


def test_a_number_that_no_file_can_hold_is_refused() -> None:
    endless = Parameter("strength", "1", 0.2, -0.5, float("inf"), 0.0, "assumed", "c")
    with pytest.raises(SettingError, match="strength.* is inf: give a finite number"):
        effect_text(found(parameters=(endless, *found().parameters[1:])))


@pytest.mark.parametrize("name", ["", "two words", "../up", "_own", "class", "1st", "x.y", "café", "x\n"])
def test_a_name_that_is_no_module_is_refused_and_nothing_written(name: str, tmp_path: Path) -> None:
    with pytest.raises(SettingError, match="letters a to z"):
        write_effect(found(name=name), tmp_path)
    assert not list(tmp_path.iterdir())


def test_neither_the_catalogue_nor_a_file_is_written_over(tmp_path: Path) -> None:
    with pytest.raises(SettingError, match="run_in.*exists already; give yours another name"):
        write_effect(found(name="run_in"), tmp_path)
    path = write_effect(found(), tmp_path)
    before = path.read_bytes()
    with pytest.raises(SettingError, match=r"late_load\.py exists already and is left as it is"):
        write_effect(found(title="another"), tmp_path)
    assert path.read_bytes() == before and list(tmp_path.iterdir()) == [path]
    write_effect(found(title="another"), tmp_path, replace=True)
    assert path.read_bytes() != before


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"cannot write .*file exists; give a folder"):
        write_effect(found(), tmp_path / "file")


def begun(port: str, folder: Path) -> Effect:
    return load_effect(write_effect(skeleton(f"my_{port}", port), folder))


@every_port
def test_a_skeleton_is_neutral_at_its_neutral_values_and_acts_at_its_typical_ones(port: str, tmp_path: Path) -> None:
    effect = begun(port, tmp_path)
    moving = {name: values[:300] for name, values in motion().items()}
    base, off, on = (
        answers(model, "python", moving)
        for model in (bridge(), with_effect(effect, effect.neutral()), with_effect(effect))
    )
    assert effect.port == port and off["specimen"] == base["specimen"]
    before, neutral, acting = arrays(base), arrays(off), arrays(on)
    assert all(np.array_equal(values, neutral[name]) for name, values in before.items())
    moved = [name for name, values in before.items() if not np.array_equal(values, acting[name])]
    assert moved or on["specimen"] != base["specimen"], "at its typical size it must do something"
    assert all(np.isfinite(values).all() for values in acting.values())


@every_port
def test_a_skeleton_replays(port: str, tmp_path: Path) -> None:
    effect = begun(port, tmp_path)
    shake = sine(8.0, 6.0, 0.05)
    plain, off, on = (
        shaken(model, shake, engine="python").record
        for model in (bridge(), with_effect(effect, effect.neutral()), with_effect(effect))
    )
    assert all(np.array_equal(plain[name], off[name]) for name in plain.channels)
    assert any(not np.array_equal(plain[name], on[name]) for name in plain.channels)


@pytest.mark.slow
def test_all_skeletons_can_be_compiled(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert engine_for([begun(port, tmp_path) for port in PORTS]) == "compiled"


@every_port
def test_a_skeleton_says_what_its_hook_can_ask_for(port: str, tmp_path: Path) -> None:
    effect = begun(port, tmp_path)
    text = effect.path.read_text(encoding="utf-8")
    first = next(iter(effect.hooks))
    for name, words in HOOKS[first].inputs.items():
        star = "*" if name in LAGGING else ""
        assert f"    #   {name + star:<24} {words}\n" in text
    assert ("time_constant" in text) == bool(HOOKS[first].inputs.keys() & LAGGING)
    assert (DERIVED["slid"] in text) == ("slid" in HOOKS[first].inputs)


def test_a_skeleton_of_a_port_that_does_not_exist_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="did you mean shear"):
        skeleton("mine", "sheer")
