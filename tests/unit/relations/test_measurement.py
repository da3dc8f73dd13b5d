"""A fault of a cell that shows in load and friction is taken out of both."""

import numpy as np
import pytest

from slipwise.effects import catalogue
from slipwise.relations.measurement import compute_noise_scale, without
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import fit_runs
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def run():
    return fit_runs(as_campaign(build_campaign(31, effects=(), rig="bridge1")))[0]


def test_the_inertia_of_a_plate_is_taken_out_of_load_and_friction(run):
    term = Term(catalogue()["cell_inertia"], tuple(f"pad_{p}_N" for p in "ABCD"), "pad_*")
    corrected = without(
        term, {f"{term.label}.mass": 40.0, f"{term.label}.horizontal": 1.0, f"{term.label}.weighed": 0.0}, run
    )
    vertical, along = run.record["table_az"], run.record["table_ax"]
    assert corrected.load - run.load == pytest.approx(np.repeat(-40.0 * vertical[:, None], 4, axis=1))
    assert corrected.force - run.force == pytest.approx(np.repeat(40.0 * along[:, None], 4, axis=1))


@pytest.mark.parametrize(("name", "value"), [("channel_delay", 2e-3), ("clock_skew", 2e-4)])
def test_slopes_of_a_delay_are_those_of_the_signal_not_of_its_noise(run, name: str, value: float) -> None:
    """Noise of 5 % and little of it in the signal's band: moved with the signal it would be most of the slope."""
    signal = np.sin(2.0 * np.pi * 2.0 * run.time)
    noisy = signal + 0.05 * np.random.default_rng(3).normal(size=len(signal))
    term = Term(catalogue()[name], ("girder_ax",), "girder_ax")
    own = term.effect.parameters[0].name
    here, near = ({f"{term.label}.{own}": share * value} for share in (1.0, 1.01))

    def slope(values: np.ndarray, around: dict[str, float] | None) -> np.ndarray:
        of = run.with_record(run.record.replaced(girder_ax=values), moved=False)
        first, second = (without(term, v, of, around).record["girder_ax"] for v in (here, near))
        return (second - first)[100:-100]

    clean, true, plain = slope(signal, None), slope(noisy, here), slope(noisy, None)
    assert np.linalg.norm(plain) > 2.0 * np.linalg.norm(clean)
    assert np.linalg.norm(true - clean) < 0.5 * np.linalg.norm(plain - clean)
    alike = without(term, here, run.with_record(run.record.replaced(girder_ax=noisy), moved=False))
    again = without(term, here, run.with_record(run.record.replaced(girder_ax=noisy), moved=False), here)
    np.testing.assert_array_equal(alike.record["girder_ax"], again.record["girder_ax"])


def test_noise_grows_by_what_undoing_a_gain_makes_of_it(run):
    gain = Term(catalogue()["channel_gain"], ("girder_ax",), "girder_ax")
    assert compute_noise_scale([gain], {f"{gain.label}.gain": 0.25}, run) == pytest.approx({"girder_ax": 0.8})
    cells = Term(catalogue()["channel_gain"], tuple(f"pad_{p}_N" for p in "ABCD"), "pad_*_N")
    found = compute_noise_scale([cells], {f"{cells.label}.gain": -0.2}, run)
    assert found == pytest.approx(dict.fromkeys(("loads", "heave", "pitch", "roll", "warp"), 1.25))
