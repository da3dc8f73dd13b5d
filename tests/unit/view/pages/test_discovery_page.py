"""The page, the pictures and the recording of a discovery show the law, the data under it, and what it takes away."""

from dataclasses import replace

import numpy as np
import pytest
from rerun.chunk import RrdReader

from hypotheses import base
from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.curve_search import weigh_curves
from slipwise.discovery.curve_system import make_curve_system
from slipwise.discovery.form import forms
from slipwise.discovery.law import Law, LawConstant, TiedForm
from slipwise.discovery.law_objective import FittedLaw, LawObjective, PlacedLaw
from slipwise.discovery.matching import Match
from slipwise.discovery.result import Discovery
from slipwise.estimation.least_squares import Solution, compute_jacobian
from slipwise.relations.table import Residuals
from slipwise.residual_map.ports import pad_ports
from slipwise.residual_map.states import pad_instants, pad_states
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.view.figures.discovery_errors import binned_rms, errors, errors_figure, loops_figure, states_figure
from slipwise.view.figures.discovery_figures import law_figure
from slipwise.view.figures.discovery_samples import candidate_cloud, law_cloud, predicted_forces
from slipwise.view.figures.figure_files import figures_into
from slipwise.view.figures.style import styled
from slipwise.view.pages.discovery_page import discovery_page
from slipwise.view.recordings.discovery_recording import write_discovery_recording
from slipwise.view.words.discovery_words import number_rows, range_words, tied_words

NAN = float("nan")
#: Added to the coefficient of friction at the reference speed [1], and that speed [m/s].
STRENGTH, REFERENCE = 0.02, 0.1
NUMBERS = {"strength": STRENGTH, "reference": REFERENCE}


def _law(candidate: CurveCandidate, fitted: FittedLaw) -> Law:
    constants = (
        LawConstant("strength", STRENGTH, 0.019, 0.021, "1"),
        LawConstant("reference", REFERENCE, NAN, NAN, "m/s"),
    )
    return Law(
        name="law", states=("speed",), port="adds to mu", where="all", parity="odd", form="square",
        tied=("power",), rivals=(), constants=constants, share=0.99, other_states=False, at_buffers=False,
        valid={"speed": (0.0, 0.12)}, fitted=fitted,
        tied_forms=(TiedForm((forms()["power"],), {**NUMBERS, "exponent": 1.9}),),
    )  # fmt: skip


@pytest.fixture(scope="module")
def found() -> Discovery:
    """A law mu += 0.02 (V / 100 mm/s)^2 that a base fit lacks, and a fit with it that leaves noise."""
    of = base(pads=1.0)
    objective, solution = of.objective, of.solution
    every = pad_instants(objective, solution.values)
    speed = next(s for s in pad_states(every) if s.name == "speed")
    port = next(p for p in pad_ports(every) if p.name == "adds to mu")
    noise = solution.residuals.of("pads")
    forces, lacking = [], []
    for i, run in enumerate(objective.runs):
        force = (STRENGTH * port.carrier[i] * (speed.values[i] / REFERENCE) ** 2)[:: run.fine]
        block = solution.residuals.block("pads", i)
        forces.append(run.force - force - np.where(block.mask, noise[i] * block.sigma, 0.0))
        lacking.append(np.where(block.mask, force / block.sigma, 0.0))

    def with_pads(residuals: Residuals, values: dict[str, float]) -> Solution:
        residuals = replace(residuals, pad_forces=tuple(forces))
        return replace(solution, values=values, residuals=residuals, cost=residuals.cost(objective.fitted))

    before = with_pads(solution.residuals.less({"pads": [-more for more in lacking]}), solution.values)
    before = replace(before, jacobian=compute_jacobian(objective, before.values, before.free, before.residuals))
    later = with_pads(solution.residuals, {**solution.values, "law.strength": STRENGTH})
    rows = make_averaged_rows(objective)
    left, slopes = rows.average(before.residuals.stacked(objective.fitted)), rows.average(before.jacobian)
    stretch = np.concatenate([np.arange(len(s.edges)) * 4 // len(s.edges) for s in rows.series])
    system = make_curve_system(rows, left, slopes, [f.key for f in before.free], (), {}, (), stretch)
    curves = weigh_curves(system, objective, every, before.values, before.free, {})
    candidate = next(c for c in curves.candidates if c.label == "speed: adds to mu")
    match = Match(candidate, (forms()["square"],), {"reference": REFERENCE}, 1.0, STRENGTH)
    placed = PlacedLaw("law", match, tuple(np.ones_like(s.load) for s in every.states))
    fitted = FittedLaw(placed, LawObjective(every, objective, (placed,)), later)
    start = replace(of, solution=before)
    return Discovery(
        "made up", "state", (_law(candidate, fitted),), candidate, curves.candidates[:10], 0.99, {"pads": (9.0, 1.0)},
        "pads",
        ("the heat: it does not vary in this campaign",), start, (), 1.0,
    )  # fmt: skip


@pytest.fixture(scope="module")
def nothing(found) -> Discovery:
    return replace(found, evidence="nothing", laws=(), organised=None, looked_at=(), share=0.0)


@pytest.fixture(scope="module")
def unknown(found) -> Discovery:
    return replace(found, evidence="unknown", laws=(), share=0.4)


def test_the_cloud_lies_on_the_law_within_its_noise_and_so_does_the_curve_without_a_form(found):
    cloud = law_cloud(found.laws[0])
    (speed,) = cloud.states
    law = STRENGTH * (speed / REFERENCE) ** 2
    off = cloud.height - law
    assert abs(np.mean(off)) < 0.05 * law.max() and np.std(off) < 0.2 * law.max()
    knots = cloud.curve.knots[0]
    middle = (knots > np.quantile(speed, 0.1)) & (knots < np.quantile(speed, 0.9))
    apart = cloud.curve.heights() - STRENGTH * (knots / REFERENCE) ** 2
    assert np.abs(apart[middle]).max() < 0.05 * law.max()


def test_a_cloud_is_thinned_evenly_over_the_range_so_that_rare_states_are_seen(found):
    cloud = law_cloud(found.laws[0])
    thin = cloud.thinned()
    assert len(thin.height) < len(cloud.height) and len(thin.height) <= 8000
    before, after = (np.histogram(of.states[0], 20, (0.0, cloud.states[0].max()))[0] for of in (cloud, thin))
    assert after.max() / after.min() < before.max() / before.min()


def test_where_no_form_is_claimed_the_curve_goes_through_what_the_base_fit_leaves(unknown):
    cloud = candidate_cloud(unknown.organised)
    said = np.interp(cloud.states[0], cloud.curve.knots[0], cloud.curve.heights())
    assert np.std(cloud.height - said) < 0.5 * np.std(cloud.height)


def test_the_law_adds_to_the_predicted_force_what_its_equation_says(found):
    place = found.base.objective.held_out[0]
    run = found.base.objective.runs[place]
    before, later = (predicted_forces(found, place, with_laws=w) for w in (False, True))
    fast = run.judged["pads"] & (np.abs(run.velocity) > 0.08)[:, None]
    added = STRENGTH * (run.velocity[:, None] / REFERENCE) ** 2 * np.sign(run.velocity)[:, None] * run.load
    assert np.allclose((later - before)[fast], added[fast], rtol=0.05)
    assert np.std((run.force - later)[fast]) < 0.5 * np.std((run.force - before)[fast])


def test_errors_fall_to_the_floor_on_fitted_and_on_held_out_runs(found):
    levels = errors(found)
    assert set(levels) == {"fitted runs", "held-out runs"}
    for of in levels.values():
        before, later = of["pads"]
        assert later == pytest.approx(1.0, abs=0.1) and before > 2.0 * later
    with styled():
        figure = errors_figure(found)
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["fitted runs", "held-out runs"]


def test_the_error_over_the_state_grows_before_and_is_flat_with_the_law(found):
    with styled():
        (axes, *_) = states_figure(found).axes
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in axes.lines}
    assert lines["before"][-1] > 3.0 * lines["before"][0]
    assert np.ptp(lines["with the law"]) < 0.5
    assert axes.get_xlabel() == "slip speed [mm/s]"


def test_bins_hold_the_rms_of_what_is_left():
    values = np.repeat([1.0, 2.0, 3.0], 100)
    middles, rms = binned_rms(values, 2.0 * values)
    assert np.allclose(rms, 2.0 * middles)


def test_the_picture_shows_the_chosen_form_whole_and_the_tied_one_dashed(found):
    with styled():
        (axes,) = law_figure(found.laws[0]).axes
    styles = {line.get_label(): line.get_linestyle() for line in axes.lines}
    assert styles["the form square"] == "-" and styles["not told from it: power"] == "--"
    bands = [c.get_label() for c in axes.collections]
    assert "its 95 % band" in bands and "measured, one sample each" in bands
    assert axes.get_ylabel() == "added to the coefficient of friction [1]"


def test_the_loops_are_of_a_fitted_and_a_held_out_run(found, unknown):
    with styled():
        panels = loops_figure(found).axes
        plain = loops_figure(unknown).axes
    assert [p.get_title(loc="left").rpartition(" (")[2] for p in panels] == ["fitted)", "held out)"]
    assert [line.get_label() for line in panels[0].lines][-2:] == ["before", "with the law"]
    assert "with the law" not in [line.get_label() for line in plain[0].lines]


def test_numbers_stand_in_units_that_people_read_with_their_intervals(found):
    strength, reference = number_rows(found.laws[0])
    assert strength["95 % interval"] == "0.019 to 0.021"
    assert (reference["value"], reference["unit"]) == ("100", "mm/s") and "chosen" in reference["95 % interval"]
    lag = replace(found.laws[0], constants=(LawConstant("time_constant", 0.02, 0.015, 0.03, "s"),))
    assert [(r["value"], r["95 % interval"], r["unit"]) for r in number_rows(lag)] == [("20", "15 to 30", "ms")]
    assert "the slip speed from 0 to 120 mm/s" in range_words(found.laws[0])


def test_ties_and_rivals_are_told_in_words(found):
    assert tied_words(found.laws[0]) == ["Over the same state, the form power cannot be told from it by these data."]
    alone = replace(found.laws[0], tied=(), tied_forms=())
    assert tied_words(alone) == ["No other state and no other form that was tried leaves as little."]
    rival = replace(alone, rivals=("load: adds to mu, linear",))
    assert tied_words(rival) == ["Another explanation leaves as little: load: adds to mu, linear."]


def test_the_page_holds_the_law_its_range_and_that_no_mechanism_is_claimed(found):
    text = discovery_page(found)
    assert found.laws[0].equation in text and "0.019 to 0.021" in text and "Known for the slip speed" in text
    assert text.count("<svg") == 5 and "No mechanism is claimed" in text
    assert (
        "the heat: it does not vary" in text
        and f"{100.0 * found.looked_at[0].share:.0f} %" in text
        and "nan" not in text.lower().split("<svg")[0]
    )


def test_every_figure_of_the_page_is_written_with_its_numbers(found, tmp_path):
    with figures_into(tmp_path / "figures") as files:
        discovery_page(found)
    assert {f.suffix for f in files} == {".svg", ".csv"} and len(files) == 8
    balances = next(f for f in files if "error_of_every_balance" in f.name and f.suffix == ".csv").read_text()
    assert "with the law" in balances and "pad friction" in balances


def test_the_page_says_first_where_there_is_no_law(found, unknown, nothing):
    organised = discovery_page(replace(found, evidence="organised"))
    assert organised.index("but no law was found") < organised.index("<nav") and ">The law<" not in organised
    text = discovery_page(unknown)
    assert text.index("No law was found") < text.index("<nav")
    assert text.count("<svg") == 5 and "with the law" not in text
    empty = discovery_page(nothing)
    assert (
        "Nothing is left that a law could explain" in empty and empty.count("<svg") == 3
    )  # one of them twice, for a phone too


def test_a_curve_that_no_other_motion_confirms_is_no_share_of_anything(unknown):
    """It was told as "most, -1820 %, goes with" it."""
    without = replace(unknown, share=0.0)
    assert "each motion asks for another curve" in without.sentence and "%" not in without.sentence
    page = discovery_page(without)
    assert "each motion asks for another curve" in page and "Most, " not in page


def test_the_recording_holds_the_pictures_and_the_dots_of_the_pads(found, tmp_path):
    path = write_discovery_recording(found, tmp_path / "discovery.rrd")
    entities = {chunk.entity_path for chunk in RrdReader(path).stream()}
    assert {f"/boards/{i}/board" for i in range(4)} <= entities
    assert {f"/boards/0/0/{pad}" for pad in "ABCD"} <= entities
    assert "/loops/2/sum/past" in entities


def test_a_discovery_shows_itself(found):
    assert repr(found).startswith("<Discovery: made up:") and "<td>0.019</td>" in found._repr_html_()
    assert list(found.to_pandas()["constant"]) == ["strength", "reference"]
    (axes,) = found.plot().axes
    assert axes.get_xlabel() == "slip speed [mm/s]"
