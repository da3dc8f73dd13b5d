"""A campaign is prepared once, and every command then speaks of the same error."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest

from slipwise.campaign import Campaign, Run
from slipwise.comparison.compare import compare
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.ladder import ladder
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit
from slipwise.preparation.prepare import prepare
from slipwise.record import Record
from slipwise.relations.parameters import Term
from slipwise.rig import load_specimen
from slipwise.selection import select
from slipwise.selection.candidates import list_candidates
from slipwise.session.session import Session
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

PADS = "ABCD"
LOADS = tuple(f"pad_{pad}_N" for pad in PADS)
CELLS = (*LOADS, *(f"pad_{pad}_Fx" for pad in PADS))
#: Length of a run that is enough for a fit [s].
SHORT = 9.0


@pytest.fixture(scope="module")
def sound() -> Campaign:
    whole = as_campaign(build_campaign(61, effects=(), rig="bridge1"))
    return replace(whole, runs=tuple(_beginning(whole.runs[i]) for i in (1, 4)))


def _beginning(run: Run) -> Run:
    record = run.record
    return replace(run, record=record.between(record.time[0], record.time[0] + SHORT))


def changed(campaign: Campaign, names: tuple[str, ...], change: Callable[[np.ndarray], np.ndarray]) -> Campaign:
    """Return a campaign with some channels of every run changed."""
    records = (r.record.replaced(**{name: change(r.record[name]) for name in names}) for r in campaign.runs)
    return replace(campaign, runs=tuple(replace(r, record=new) for r, new in zip(campaign.runs, records, strict=True)))


def late(values: np.ndarray) -> np.ndarray:
    return np.concatenate([np.full(200, values[0]), values[:-200]])


FAULTS: dict[str, Callable[[Campaign], Campaign]] = {
    "reversed": lambda sound: changed(sound, ("pad_B_Fx",), np.negative),
    "dead": lambda sound: changed(sound, ("pad_D_N",), np.zeros_like),
    "late": lambda sound: changed(sound, CELLS, late),
    "tared": lambda sound: changed(sound, LOADS, lambda values: values - values[:40].mean()),
    "wrong_rig": lambda sound: replace(sound, rig="bridge2", specimen=load_specimen("bridge2")),
}


@pytest.fixture
def heating_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a diagnosis ask for one effect: what is mended, and the error before, hang on no other candidate."""

    def listed(base: BaseFit, own: Iterable[Effect] = ()) -> tuple[list[Term], dict[str, str]]:
        terms, cannot = list_candidates(base, own)
        return [term for term in terms if term.effect.name == "heating"], cannot

    monkeypatch.setattr(select, "list_candidates", listed)


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=() if kind == "tared" else pytest.mark.long) for kind in FAULTS]
)
def test_every_command_mends_a_fault_says_so_and_tells_the_same_error(sound, heating_alone, kind):
    faulty = FAULTS[kind](sound)
    compared, found = compare(faulty, system=False), diagnose(faulty)
    climbed = ladder(faulty, ["heating"])
    session = Session(faulty, keep=False)
    session.fit()
    for corrections in (compared.corrections, found.corrections, climbed.corrections, session.corrections):
        assert [one.kind for one in corrections] == [kind]
    held = {r: compared.error(r, held_out=True) for r in compared.relations}
    errors = {relation: error for relation, error in held.items() if error is not None}
    in_session = {error.relation: error.error for error in session.errors()}
    assert errors and max(errors.values()) < 1.3
    assert found.base_error == pytest.approx(max(errors.values()), rel=1e-9)
    floors = {words.split()[2].rstrip(":") for words in found.cannot_tell if words.startswith("floor of")}
    assert floors <= set(errors)
    assert all(candidate.holdout_after > 0.5 for candidate in found.candidates)  # of a balance that is judged
    for relation, error in errors.items():
        told = (found.relations[relation][0], climbed.steps[0].relations[relation], in_session[relation])
        assert told == pytest.approx((error,) * 3, rel=1e-9), relation


def test_a_campaign_that_is_prepared_is_not_prepared_again(sound):
    ready = prepare(sound)
    assert prepare(ready) is ready


def test_a_sound_campaign_is_fitted_as_it_was_recorded(sound):
    ready = prepare(sound)
    assert not ready.faults and not ready.corrections and ready.other_rig is None
    for before, after in zip(sound.runs, ready.campaign.runs, strict=True):
        assert all(np.array_equal(before.record[name], after.record[name]) for name in before.record.channels)


def test_masks_tell_the_reason_why_samples_are_not_judged(sound):
    def with_peaks_cut(values: np.ndarray) -> np.ndarray:
        return np.minimum(values, 0.8 * values.max())

    ready = prepare(changed(sound, ("pad_A_Fx",), with_peaks_cut))
    assert set(ready.masks) == {"upper rail"}
    for run in sound.runs:
        bad = ready.masks["upper rail"][run.name]["pad_A_Fx"]
        unjudged = ready.invalid[run.name]["pad_A_Fx"]
        assert bad.any() and unjudged[bad].all() and not unjudged.all()


def test_a_wrong_rig_is_replaced_by_the_one_that_was_shaken(sound):
    ready = prepare(FAULTS["wrong_rig"](sound))
    assert ready.recorded.specimen.name == "bridge2" and ready.campaign.specimen == load_specimen("bridge1")


def test_a_campaign_without_any_channel_of_a_fit_is_prepared_all_the_same(sound):
    bare = tuple(
        replace(r, record=Record(r.record.time, {"table_ax": r.record["table_ax"]}, r.record.provenance))
        for r in sound.runs
    )
    ready = prepare(replace(sound, runs=bare))
    assert not ready.faults and [run.name for run in ready.campaign.runs] == [run.name for run in sound.runs]
