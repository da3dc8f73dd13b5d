"""One law over specimens of made columns: what all have, what one has alone, and what cannot be compared."""

from collections.abc import Mapping

import numpy as np
import pytest

from slipwise.cli.batch import judge_together
from slipwise.errors import InputError
from slipwise.estimation.intervals import Interval
from slipwise.specimens.judge import judge_specimens
from slipwise.specimens.result import OWN, SHARED
from slipwise.specimens.specimen import SpecimenStatistics, condense
from slipwise.specimens.specimen_file import read_specimen, write_specimen
from slipwise.studies.campaigns import Compared, Outcome
from slipwise.view.pages.campaigns_page import campaigns_page
from slipwise.view.words.specimen_words import effect_sentences
from weighed import BASE_SLOPE, column, noise, terms_of, waves, weigh

#: Effect of the catalogue -> what one limit of it leaves, over the floor of a made column [1].
LOUD = {"breakaway": 0.35, "run_in": 1.0, "guide_drag": 1.0}
#: Mass that the noise of a campaign would give were the effects known, and its standard error [kg].
MASS, ERROR = 1.0e4, 20.0


def specimen(
    name: str, seed: int, sizes: Mapping[str, float], *, rig: str = "bridge1", mixed: float = 0.0
) -> SpecimenStatistics:
    """Give a specimen that has these effects; a part of what they change looks like its base number."""
    made = waves(len(LOUD), seed)
    columns = {label: loud * (made[:, k] + mixed * BASE_SLOPE[:, 0]) for k, (label, loud) in enumerate(LOUD.items())}
    left = noise(seed + 100) - sum((x * columns[label] for label, x in sizes.items()), np.zeros(len(made)))
    # the fit has taken for its number what looks like it
    taken = float(BASE_SLOPE[:, 0] @ left / (BASE_SLOPE[:, 0] @ BASE_SLOPE[:, 0]))
    every = [column(label, values) for label, values in columns.items()]
    weighed = weigh(left - taken * BASE_SLOPE[:, 0], every, number=MASS - 100.0 * taken)
    entry = Interval("rig.mass", MASS, MASS - 1.96 * ERROR, MASS + 1.96 * ERROR, MASS, "kg", "")
    return condense(name, rig, weighed, terms_of(every), [entry], ())


@pytest.fixture(scope="module")
def four() -> list[SpecimenStatistics]:
    """Four specimens with a breakaway that is too small to be named in each; one has also run in."""
    return [
        specimen(name, seed, {"breakaway": 0.65, "run_in": 2.0 if name == "c" else 0.0})
        for seed, name in enumerate("abcd")
    ]


def test_a_trifle_that_no_campaign_shows_alone_is_evidence_where_all_show_it(four: list[SpecimenStatistics]) -> None:
    assert all(s.chance["breakaway"] < 0.5 for s in four)
    found = next(e for e in judge_specimens(four).effects if e.of == SHARED)
    assert found.effect == "breakaway" and found.probability > 0.75
    assert found.size == pytest.approx(0.65, abs=0.25)


def test_what_one_specimen_has_and_the_others_contradict_is_a_property_of_that_one(
    four: list[SpecimenStatistics],
) -> None:
    found = judge_specimens(four)
    own = [e for e in found.effects if e.of == OWN]
    assert [(e.effect, e.specimen) for e in own] == [("run_in", "c")]
    assert own[0].probability > 0.9
    values = own[0].sizes[0].values
    assert values["c"] > 10.0 * max(abs(values[name]) for name in "abd")
    assert any(words.startswith("run_in is a property of c (") for words in effect_sentences(found))


def test_specimens_without_effects_share_none_and_their_numbers_agree() -> None:
    found = judge_specimens([specimen(name, seed, {}) for seed, name in enumerate("abc", start=20)])
    assert found.effects == ()
    mass = found.numbers[0]
    assert mass.over is not None and mass.over.low < MASS < mass.over.high and mass.over.spread < 2.0 * ERROR


def test_a_number_moves_to_where_it_lies_beside_the_shared_law() -> None:
    fitted = [specimen(name, seed, {"run_in": 2.0}, mixed=0.5) for seed, name in enumerate("ab", start=40)]
    assert all(abs(s.numbers[0].value - MASS) > 50.0 for s in fitted)
    mass = judge_specimens(fitted).numbers[0]
    assert all(abs(value - MASS) < 15.0 for value in mass.values.values())


def test_between_rigs_a_share_is_compared_and_a_damping_is_not() -> None:
    found = judge_specimens(
        [
            specimen(name, seed, {"breakaway": 3.0, "guide_drag": 2.0}, rig=rig)
            for seed, (name, rig) in enumerate((("a", "bridge1"), ("b", "bridge2"), ("c", "bridge1")), start=60)
        ]
    )
    assert "breakaway" in [e.effect for e in found.effects if e.of == SHARED]
    assert found.not_compared == {"guide_drag": ("N*s/m",)}
    assert all(e.of == OWN for e in found.effects if e.effect == "guide_drag")
    assert found.numbers == ()


def test_what_cannot_be_joined_is_told_in_a_sentence(four: list[SpecimenStatistics]) -> None:
    with pytest.raises(InputError, match="needs two campaigns at least; only a was given"):
        judge_specimens(four[:1])
    with pytest.raises(InputError, match="two campaigns are called a"):
        judge_specimens([four[0], four[0]])
    strange = [specimen(name, 80, {}, rig=name) for name in ("x", "y")]
    only = [s.__class__(**{**vars(s), "columns": tuple(_as_gauge(c) for c in s.columns)}) for s in strange]
    with pytest.raises(InputError, match="share no law"):
        judge_specimens(only)


def _as_gauge(of):
    return of.__class__(**{**vars(of), "gauge": True})


def test_a_specimen_that_was_written_says_the_same(four: list[SpecimenStatistics], tmp_path) -> None:
    read = [read_specimen(write_specimen(s, tmp_path / f"{s.name}.npz")) for s in four]
    assert judge_specimens(read).as_json() == judge_specimens(four).as_json()
    (tmp_path / "a.npz").write_bytes(b"half a file")
    with pytest.raises(InputError, match="diagnose its campaign again"):
        read_specimen(tmp_path / "a.npz")


def test_a_campaign_that_cannot_be_joined_is_told_and_the_rest_is_joined(
    four: list[SpecimenStatistics], tmp_path
) -> None:
    for s in four[:3]:
        write_specimen(s, tmp_path / s.name / "specimen.npz")
    outcomes = [Outcome(name, {"weighed": True}) for name in "abcd"]
    found, reasons = judge_together([*outcomes, Outcome("e", {"failed": "no unit"})], tmp_path)
    assert found is not None and found.names == ("a", "b", "c")
    assert [words[:13] for words in reasons] == ["d is left out", "e is left out"]
    page = campaigns_page([], Compared((), (), ()), found, reasons)
    assert "One law over all specimens" in page and "run_in is a property of c" in page and "d is left out" in page
    nothing, reasons = judge_together(outcomes[:1], tmp_path)
    assert nothing is None and "no law over all" in reasons[-1]
