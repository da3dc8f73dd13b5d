"""An author elsewhere can hold an effect to the contract, and offer it in a package of one's own."""

import subprocess
import sys
import textwrap
from dataclasses import fields
from pathlib import Path

import pytest

from slipwise.effects import CONTRACT, Effect, ForDiagnosis, Gauges, Rare, load_effect, skeleton, write_effect
from slipwise.errors import SettingError, SlipwiseWarning
from slipwise.testing import ContractError, check_effect

VISCOUS = '''
"""A viscous share: friction rises with slip speed.

    mu += c V

It is there in greased plates.

Valid: V below 1 m/s.
Source: assumed, an example.
"""

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def shear(shear, true_pressure, speed, rise):
    """Raise the shear strength [Pa] with speed."""
    return shear + rise * speed * true_pressure


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(Parameter("rise", "s/m", 0.05, 0.0, 0.5, 0.0, "assumed", "c: rise with speed"),),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu += c V",
        moves=RESPONSE,
        signature="odd in velocity, largest at the highest speed",
        confused_with={"shear_rate": "constant high speeds: shear_rate has levelled off"},
    ),
)
'''
PROJECT = """
[build-system]
requires = ["hatchling"]
build-backend = "hatchling.build"

[project]
name = "greased-plates"
version = "1.0"

[project.entry-points."slipwise.effects"]
viscous = "greased_plates.viscous"
"""


def written(folder: Path, text: str = VISCOUS) -> Path:
    path = folder / "viscous.py"
    path.write_text(textwrap.dedent(text).lstrip(), encoding="utf-8")
    return path


@pytest.mark.long
def test_a_file_of_before_the_contract_works_and_is_told_what_to_add(tmp_path: Path) -> None:
    (advice,) = check_effect(written(tmp_path, VISCOUS.replace("    contract=1,\n", "")))
    assert f"add contract={CONTRACT} to EFFECT" in advice
    assert check_effect(written(tmp_path)) == ()


def test_a_file_of_a_later_contract_is_refused_with_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(SettingError, match=r"contract 9 .*`pip install --upgrade slipwise"):
        load_effect(written(tmp_path, VISCOUS.replace("contract=1", "contract=9")))


def test_what_is_begun_by_the_command_line_states_its_contract(tmp_path: Path) -> None:
    assert load_effect(write_effect(skeleton("mine"), tmp_path)).contract == CONTRACT


BROKEN = (
    VISCOUS.replace("shear + rise * speed", "shear + (rise + 0.1) * speed")
    .replace("moves=RESPONSE", 'moves=("yaw",)')
    .replace('{"shear_rate": "constant high speeds: shear_rate has levelled off"}', "{}")
    .replace("It is there in greased plates.\n\n", "")
)


@pytest.mark.slow
def test_an_effect_that_breaks_the_contract_is_told_of_every_breach(tmp_path: Path) -> None:
    with pytest.raises(ContractError) as caught:
        check_effect(written(tmp_path, BROKEN))
    lines = str(caught.value).splitlines()
    told = ("a sentence in plain words", "`confused_with` is empty", "at its neutral values", "add these to `moves`")
    for words in told:
        assert [line for line in lines if words in line and line.startswith("viscous.py: ")], words


def test_a_newcomer_reads_twelve_fields() -> None:
    """Those of every effect, up to the other blocks, and those of a diagnosis."""
    own = [f.name for f in fields(Effect)]
    assert len(own[: own.index("gauges")]) + len(fields(ForDiagnosis)) <= 12


def test_every_field_of_a_block_is_read_from_the_effect(tmp_path: Path) -> None:
    effect = load_effect(written(tmp_path))
    for block in (effect.diagnosis, effect.gauges, effect.rare):
        # of `gauges` some are asked for as `effect.gauges.sits`
        read = [f.name for f in fields(block) if hasattr(effect, f.name) or block is not effect.gauges]
        assert [getattr(effect, name) for name in read] == [getattr(block, name) for name in read]


FLAT = (
    VISCOUS.replace("    diagnosis=ForDiagnosis(\n", "")
    .replace("    ),\n)\n", '    gauges=Gauges(sits="alone"),\n    lag="rise",\n    steady="the load",\n)\n')
    .replace("Effect, ForDiagnosis", "Effect, Gauges")
    .replace("        ", "    ")
)


def test_a_file_that_knows_no_blocks_works_and_is_told_once_what_to_write(tmp_path: Path) -> None:
    path = written(tmp_path, FLAT)
    with pytest.warns(SlipwiseWarning) as told:
        effect, again = load_effect(path), load_effect(path)
    assert effect.diagnosis == load_effect(written(tmp_path)).diagnosis == again.diagnosis
    assert (effect.gauges, effect.rare) == (Gauges(sits="alone", lag="rise"), Rare(steady="the load"))
    (words,) = (str(each.message) for each in told)
    assert "viscous.py works as it is" in words and "gauges=Gauges(lag=...)" in words
    assert "diagnosis=ForDiagnosis(component=..., equation=..., moves=..., signature=..., confused_with=...)" in words
    assert effect.advice == (words,)


def test_a_package_that_is_installed_from_its_folder_offers_its_effect(tmp_path: Path) -> None:
    """Installed by pip into a folder of its own, without a network, and found by another process."""
    pytest.importorskip("hatchling", reason="builds the package; `pip install hatchling`")
    home = tmp_path / "project" / "greased_plates"
    home.mkdir(parents=True)
    written(home)
    (home / "__init__.py").write_text("", encoding="utf-8")
    (home.parent / "pyproject.toml").write_text(PROJECT, encoding="utf-8")
    site = tmp_path / "site"
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*pip, "--target", str(site), str(home.parent)], check=True, capture_output=True, text=True)
    asked = "from slipwise.effects import find_effect; print(find_effect('viscous').path)"
    found = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(site)!r}); {asked}"],
        check=True, capture_output=True, text=True,
    )  # fmt: skip
    assert Path(found.stdout.strip()) == site / "greased_plates" / "viscous.py"
