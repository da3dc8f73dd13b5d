"""The API reference: no public name or argument is undocumented, and every example runs."""

import inspect
import os
import runpy
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

import slipwise as sw
from slipwise import effects

ROOT = Path(__file__).parents[2]
REFERENCE = runpy.run_path(str(ROOT / "scripts" / "reference.py"))
PUBLIC = {
    **REFERENCE["list_public"](sw),
    **{f"effects.{name}": each for name, each in REFERENCE["list_public"](effects).items()},
}
#: What can be called or made, or holds others: a constant says by itself what it is.
SHOWN = [n for n, each in PUBLIC.items() if inspect.ismodule(each) or (callable(each) and hasattr(each, "__name__"))]
EXAMPLES = REFERENCE["read_examples"]()


@pytest.fixture
def campaign_folder(tmp_path: Path) -> Iterator[None]:
    """A folder that holds `my_campaign`, where the examples run."""
    shutil.copytree(Path(sw.rig.__file__).parents[1] / "demo_data", tmp_path / "my_campaign")
    was = Path.cwd()
    os.chdir(tmp_path)
    yield
    os.chdir(was)


@pytest.mark.parametrize("name", PUBLIC)
def test_a_public_name_is_documented_with_all_of_its_arguments(name: str) -> None:
    assert not list(REFERENCE["find_undocumented"](name, PUBLIC[name]))


def test_every_public_name_has_an_example_and_every_example_a_public_name() -> None:
    assert set(EXAMPLES) <= set(PUBLIC)
    assert not set(SHOWN) - set(EXAMPLES)


def test_the_pages_hold_every_name() -> None:
    for page in REFERENCE["PAGES"]:
        text = REFERENCE["reference_page"](page)
        for name in REFERENCE["list_public"](REFERENCE["PAGES"][page][0]):
            assert f"\n## {name}\n" in text


def run_examples(wanted: set[bool]) -> None:
    names: dict[str, object] = {}
    for code, long in dict.fromkeys(EXAMPLES.values()):
        if long in wanted:
            exec(compile(code, "scripts/reference_examples.py", "exec"), names)


def test_the_examples_run_one_after_another(campaign_folder: None, capsys: pytest.CaptureFixture[str]) -> None:
    run_examples({False})
    assert "did you mean bridge2 or bridge1" in capsys.readouterr().out


@pytest.mark.long
def test_the_examples_that_take_minutes_run_too(campaign_folder: None) -> None:
    run_examples({False, True})
