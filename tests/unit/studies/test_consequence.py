"""What a named effect means for the bridge: both models, the same earthquakes, sizes from their intervals."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest

import slipwise as sw
from slipwise.studies.ensemble.distributions import Varied, draw
from slipwise.studies.ensemble.responses import RESPONSES

QUAKE = "quake:seed={},peak=0.5g,f=1.5Hz,strong=4s"


def diagnosis(folder, effects=("run_in",), **sizes):
    """A diagnosis.json as `slipwise diagnose` writes it, as far as it is read."""
    entries = {key: dict(zip(("value", "low", "high"), numbers, strict=True)) for key, numbers in sizes.items()}
    best = {"effect": " + ".join(effects), "parameters": {k.replace("__", "."): v for k, v in entries.items()}}
    content = {"rig": "bridge2", "effects": list(effects), "candidates": [best]}
    (folder / "diagnosis.json").write_text(json.dumps(content))
    return folder


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Four earthquakes on bridge1, with run_in that a diagnosis has named and without."""
    folder = tmp_path_factory.mktemp("consequence")
    named = diagnosis(folder, run_in__rise=(0.6, 0.4, 0.8), run_in__distance=(0.2, None, None))
    return sw.consequence("bridge1", ["quake:peak=0.5g,f=1.5Hz,strong=4s"], folder, diagnosis=named, drawn=4, workers=1)


def test_a_named_effect_that_the_model_lacks_is_put_in_and_its_size_drawn(found):
    assert found.named == ("run_in",) and [v.key for v in found.drawn] == ["run_in.rise"]
    notes = " ".join(found.notes)
    assert "is of bridge2: what was found there is put on bridge1" in notes
    assert "put in at the size of diagnosis.json" in notes and "run_in.distance has no interval" in notes
    rows = pq.read_table(found.path).to_pylist()
    assert [row["model"] for row in rows] == ["without", "with"] * 4
    rises = {row["run_in.rise"] for row in rows}
    assert len(rises) == 4 and all(0.2 < rise < 1.0 for rise in rises)


def test_the_model_without_slides_as_the_base_model_does_under_the_shortened_motion(found):
    motion = sw.motion.scale_time(sw.load_motion(QUAKE.format(1)), 10.69)
    slip = sw.replay("bridge1", motion).largest_slip
    assert found.distributions[0].without[0] == pytest.approx(slip, rel=1e-3)


def test_the_bridge_is_larger_by_similarity_and_the_sentence_says_its_slip(found):
    slip, _, load, buffer = found.distributions
    assert (slip.to_bridge, load.to_bridge, buffer.to_bridge) == pytest.approx((10.69, 10.69**2, 10.69**2))
    before, after = (1e3 * 10.69 * np.quantile(v, 0.9) for v in (slip.without, slip.with_named))
    verb = "raises" if after > before else "lowers"
    assert found.sentence.startswith(f"run_in {verb} the 90 % peak slip of the bridge from {before:.3g}")
    assert buffer.without == pytest.approx(slip.without * 18.5e6 / 10.69, rel=0.02)


def test_a_second_call_runs_nothing_anew_and_says_the_same(found):
    folder = found.path.parent
    drawn = {"drawn": 4, "workers": 1, "diagnosis": folder}
    again = sw.consequence("bridge1", ["quake:peak=0.5g,f=1.5Hz,strong=4s"], folder, **drawn)
    assert again.run == 0 and again.sentence == found.sentence


def test_a_size_is_drawn_within_its_bounds_and_95_percent_of_it_within_its_interval():
    one = Varied("a.b", 0.05, 0.4, "1", value=0.1, bounds=(0.0, 0.5))
    values = draw([one], 4096, "sobol", 1)[:, 0]
    assert np.mean((values > 0.05) & (values < 0.4)) == pytest.approx(0.95, abs=0.005)
    assert np.median(values) == pytest.approx(0.1, abs=1e-3) and values.min() >= 0.0 and values.max() <= 0.5


def test_records_of_a_folder_are_read_and_what_cannot_be_read_is_said(tmp_path):
    records = tmp_path / "records"
    records.mkdir()
    for seed in (1, 2):
        motion = sw.load_motion(QUAKE.format(seed))
        lines = [f"{t:.4f},{a:.6f}" for t, a in zip(motion.time[::20], motion.acceleration[::20, 0], strict=True)]
        (records / f"{seed}.csv").write_text("\n".join(["time [s],table_ax [m/s^2]", *lines]) + "\n")
    (records / "readme.txt").write_text("two records\n")
    model = sw.base_model("bridge1").adding(sw.use("heating"))
    found = sw.consequence(model, [str(records)], tmp_path / "out", workers=1)
    assert found.earthquakes == 2 and found.named == ("heating",) and not found.drawn
    notes = " ".join(found.notes)
    assert "readme.txt" in notes and "no interval of a size is known" in notes


@pytest.mark.parametrize(
    ("model", "options", "words"),
    [
        ("bridge1", {}, "nothing is named that could be left out"),
        ("bridge1", {"without": ["heating"]}, "has no effect 'heating'"),
        ("pad", {"without": ["shear_rate"]}, "slip is prescribed"),
        ("bridge1", {"diagnosis": "nowhere"}, "slipwise diagnose"),
        ("bridge1", {"without": ["shear_rate"], "length_scale": -1.0}, "above 0"),
        ("bridge1", {"without": ["shear_rate"], "drawn": 3}, "without a seed"),
    ],
)
def test_what_cannot_be_answered_is_refused_in_a_sentence(tmp_path, model, options, words):
    with pytest.raises(sw.SlipwiseError, match=words):
        sw.consequence(model, ["sine:2Hz,0.3g,cycles=9"], tmp_path, workers=1, **options)
    assert not (tmp_path / "members.parquet").exists()


def test_an_ensemble_tells_the_buffers_force_too():
    assert {"pad_load", "buffer_force"} <= {r.name for r in RESPONSES}


@pytest.mark.slow
def test_one_worker_and_two_write_the_same_bytes(tmp_path):
    model = sw.base_model("bridge1").adding(sw.use("run_in"))
    named = diagnosis(tmp_path, run_in__rise=(0.3, 0.2, 0.4))
    bytes_of = []
    for workers in (1, 2):
        out = tmp_path / str(workers)
        given = {"diagnosis": named, "drawn": 12, "workers": workers}
        bytes_of.append(sw.consequence(model, ["quake:f=1.5Hz,strong=4s"], out, **given).path.read_bytes())
    assert bytes_of[0] == bytes_of[1]
