"""A verdict does not depend on how a campaign was written down: the same names, as sure."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise_benchmarks import Campaign as Made
from slipwise_benchmarks import build_campaign, make_bearing
from slipwise_benchmarks.bearing import draw_bearing, drive_of, record, write_bearing
from slipwise_benchmarks.campaign import with_faults
from slipwise_benchmarks.in_memory import as_campaign
from slipwise_benchmarks.rewritten import REWRITINGS, Rewriting, with_another_zero_of_slip

#: What a probability may differ by [1]: written otherwise, and with other noise.
_WRITTEN, _NOISE = 0.05, 0.15
_REST = 1800.0
#: Rewritings of a slider that are tried at once.
_AT_ONCE = ("x mirrored", "in other units", "pads renamed and reordered")
#: Roles and speeds of a bearing's runs [m/s].
_RUNS = {"slow": ("fit", 1.0, 0.06), "fast": ("fit", 0.9, 0.25), "other": ("holdout", 0.7, 0.12)}


def by_name(name: str) -> Rewriting:
    return next(rewriting for rewriting in REWRITINGS if rewriting.name == name)


@cache
def bearing(folder: Path, kind: str, seed: int) -> tuple[Campaign, Diagnosis]:
    """Give a single slider that rested before every run, so that the order of its runs is free, and its diagnosis."""
    make_bearing(folder, kind, seed)
    read = load_campaign(folder)
    rested = replace(read, runs=tuple(replace(run, rest_before=_REST) for run in read.runs))
    return rested, diagnose(rested)


@cache
def girder() -> tuple[Campaign, Diagnosis]:
    campaign = as_girder(build_campaign(54010, effects=("buffer_hardening",), size="large"))
    return campaign, diagnose(campaign)


def as_girder(made: Made) -> Campaign:
    """Give the two earthquakes that are fitted and the one that is held out."""
    whole = as_campaign(made)
    return replace(whole, runs=(whole.runs[1], whole.runs[2], whole.runs[4]))


def assert_the_same(rewriting: Rewriting, campaign: Campaign, found: Diagnosis) -> None:
    assert rewriting.applies(campaign)
    other = diagnose(rewriting.of(campaign)).verdict
    assert rewriting.is_same(other.kind, other.effects, found.verdict.kind, found.verdict.effects), other.effects
    assert other.probability == pytest.approx(found.verdict.probability, abs=_WRITTEN)


def all_at_once(campaign: Campaign) -> Campaign:
    for name in _AT_ONCE:
        campaign = by_name(name).of(campaign)
    return campaign


@pytest.mark.long
def test_a_spring_with_a_wall_is_found_though_all_of_it_is_written_otherwise(tmp_path_factory) -> None:
    campaign, found = bearing(tmp_path_factory.getbasetemp() / "written_spring", "spring", 54301)
    assert set(found.verdict.effects) == {"restrainer", "slide_curvature"} and found.final_error < 1.2
    assert_the_same(Rewriting("all at once", all_at_once), campaign, found)


@pytest.mark.long
@pytest.mark.parametrize("rewriting", REWRITINGS, ids=lambda rewriting: rewriting.name)
def test_a_spring_with_a_wall_is_found_however_it_was_written_down(tmp_path_factory, rewriting: Rewriting) -> None:
    campaign, found = bearing(tmp_path_factory.getbasetemp() / "written_spring", "spring", 54301)
    assert set(found.verdict.effects) == {"restrainer", "slide_curvature"}
    assert_the_same(rewriting, campaign, found)


@pytest.mark.long
def test_a_pendulum_is_found_however_often_it_was_sampled(tmp_path_factory) -> None:
    campaign, found = bearing(tmp_path_factory.getbasetemp() / "written_pendulum", "pendulum", 54300)
    assert set(found.verdict.effects) == {"slide_curvature"}
    assert_the_same(by_name("every second sample"), campaign, found)


@pytest.mark.long
def test_a_pendulum_that_is_mirrored_leaves_the_same_errors(tmp_path_factory) -> None:
    campaign, found = bearing(tmp_path_factory.getbasetemp() / "written_pendulum", "pendulum", 54300)
    mirrored = diagnose(by_name("x mirrored").of(campaign))
    assert mirrored.verdict.effects == found.verdict.effects
    assert mirrored.verdict.probability == pytest.approx(found.verdict.probability, abs=1e-3)
    assert (mirrored.base_error, mirrored.final_error) == pytest.approx((found.base_error, found.final_error), rel=1e-3)


@pytest.mark.long
def test_a_wall_shows_by_how_much_the_zero_of_the_slip_is_off(tmp_path_factory) -> None:
    campaign, _ = bearing(tmp_path_factory.getbasetemp() / "written_spring", "spring", 54301)
    shifted = with_another_zero_of_slip(campaign)
    more = float(np.mean(shifted.runs[0].record["slip_x"] - campaign.runs[0].record["slip_x"]))
    found = diagnose(shifted)
    assert set(found.verdict.effects) == {"restrainer", "slide_curvature", "channel_offset"}
    offset = found.final.solution.values["channel_offset[slip_x].offset"]
    assert 0.1 * offset == pytest.approx(more, rel=0.05)  # of a gauge of 100 mm


@pytest.mark.long
def test_other_noise_of_the_gauges_leaves_the_names(tmp_path: Path) -> None:
    spring, found = draw_bearing("spring", 54301), []
    for seed in (1, 2):
        drives, noise = np.random.default_rng(54301), np.random.default_rng(seed)
        tables = {name: record(spring, noise, drive_of(spring, drives, *of[1:])) for name, of in _RUNS.items()}
        write_bearing(tmp_path / f"noise_{seed}", spring, {name: of[0] for name, of in _RUNS.items()}, tables)
        found.append(diagnose(tmp_path / f"noise_{seed}").verdict)
    assert set(found[0].effects) == set(found[1].effects) == {"restrainer", "slide_curvature"}
    assert found[1].probability == pytest.approx(found[0].probability, abs=_NOISE)


@pytest.mark.long  # at half its rate this logger's filter lets through what is folded down
@pytest.mark.parametrize("name", [r.name for r in REWRITINGS if r.name != "every second sample"])
def test_a_girder_is_judged_alike_however_it_was_written_down(name: str) -> None:
    campaign, found = girder()
    assert found.verdict.effects == ("buffer_hardening",)
    assert_the_same(by_name(name), campaign, found)


@pytest.mark.long
def test_a_girder_with_other_noise_of_its_gauges_is_judged_alike() -> None:
    made = build_campaign(54010, effects=("buffer_hardening",), size="large")
    campaign, found = girder()
    other = diagnose(as_girder(with_faults(made, (), 1))).verdict
    assert set(other.effects) == set(found.verdict.effects) and other.kind == found.verdict.kind
    assert other.probability == pytest.approx(found.verdict.probability, abs=_NOISE)
