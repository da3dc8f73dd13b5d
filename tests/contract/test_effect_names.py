"""No file but an effect's own knows it by its name, and what effects declare of each other holds."""

import ast
import re
from pathlib import Path

import pytest

from slipwise.effects import NEEDS, Effect, base_effects, catalogue
from slipwise.selection.candidates import HAS

PACKAGE = Path(__file__).parents[2] / "src" / "slipwise"
NAMES = re.compile(rf"(?<!\w)({'|'.join(catalogue())})(?!\w)")
#: Where a word that is also an effect's name means something else, or is an example that a user reads.
ALLOWED = {
    ("channels.py", "table_pitch"),  # a channel
    ("simulation/sensor_channels.py", "table_pitch"),  # the channel
    ("view/recordings/scene.py", "table_pitch"),  # the channel
    ("view/recordings/series.py", "table_pitch"),  # the channel
    ("rig/build.py", "table_pitch"),  # a joint of the rig
    ("rig/known.py", "buffer_height"),  # a number of the rig
    *((f"rig/{part}.py", "buffer_height") for part in ("bounds", "changed_parts", "places", "specimen_file")),
    ("rig/mjcf/writer.py", "table_pitch"),  # a joint of the rig
    ("view/pages/paper_page.py", "buffer_height"),  # the same, in an example of a command
    ("comparison/motion_states.py", "breakaway"),  # a state of motion
    # what standards ask of a bearing: its friction as sliding begins
    *((f, "breakaway") for f in ("bearings/judge.py", "bearings/quantities.py", "view/words/bearing_tables.py")),
    ("cli/effects.py", "heating"),  # an example of a command
    ("cli/bench.py", "run_in"),  # an example of an answer
    ("cli/ensemble.py", "shear_rate"),  # an example of a command
    ("rig/mjcf/parts.py", "table_pitch"),  # a joint of the rig
    # what a user takes in the place of what an MJCF may not hold
    *(("rig/mjcf/comparison.py", n) for n in ("buffer_damping", "guide_drag", "key_clearance", "key_friction")),
    ("model/entry.py", "heating"),  # an example of an entry
    ("model/model.py", "buffer_damping"),  # what bearings that do not slide have for a base model
    *(
        (f, "superstructure") for f in ("data_files/column_words.py", "view/figures/paper_rig_pictures.py")
    ),  # of a bridge
}


def _named(path: Path) -> set[str]:
    """Names of effects in a file's text constants but docstrings."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    words = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and isinstance(node.body[0], ast.Expr)
    }
    texts = (n for n in ast.walk(tree) if isinstance(n, ast.Constant) and isinstance(n.value, str))
    return {name for text in texts if id(text) not in words for name in NAMES.findall(str(text.value))}


def test_only_its_own_file_and_the_studies_name_an_effect() -> None:
    found = set()
    for path in PACKAGE.rglob("*.py"):
        place = path.relative_to(PACKAGE).as_posix()
        if not place.startswith(("effects/", "studies/")):
            found |= {(place, name) for name in _named(path)}
    assert found == ALLOWED


def test_every_need_of_an_effect_is_looked_for_in_a_campaign() -> None:
    assert list(HAS) == list(NEEDS)


@pytest.mark.parametrize("effect", catalogue().values(), ids=lambda e: e.name)
def test_what_an_effect_says_of_others_holds(effect: Effect) -> None:
    for twin, unless in effect.same_unless.items():
        assert catalogue()[twin].same_unless[effect.name] == unless, "one thing whichever of the two is asked"
        assert twin in effect.confused_with
    if effect.plainer:
        plain = catalogue()[effect.plainer]
        assert plain.lag and "corner" in effect.hooks
        assert {n for n in plain.parameter_names if n != plain.lag} == set()
    assert not effect.in_samples or effect.port == "gauge"


def test_the_base_model_has_a_law_springs_and_one_stick() -> None:
    assert [e.port for e in base_effects("law")] == ["area", "shear"]
    assert len(base_effects("springs")) == 1
    (stick,) = base_effects("stick")
    assert "stick" in stick.hooks and "length" in stick.parameter_names
