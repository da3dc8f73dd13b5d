"""A session shows where the model fails, sees the error fall as an effect is added and fitted, and goes back."""

import numpy as np
import pytest

import slipwise as sw
from session_campaign import MISSING
from slipwise.errors import SettingError, UnitError, UnknownNameError
from slipwise.model import base_model, use
from slipwise.session.session import Session


def error(session, relation="pads", state=None):
    return next(e for e in session.errors(state) if e.relation == relation)


@pytest.fixture
def back(fitted):
    """The fitted session; whatever a test does is taken back."""
    place, history, reference = fitted.state, fitted.history, fitted.reference
    yield fitted
    fitted.history, fitted.reference = history, reference
    assert fitted.state == place


def test_the_missing_effect_brings_the_pads_from_far_above_the_floor_to_it(back):
    before = error(back)
    assert before.fitted > 3.0
    back.toggle(MISSING)
    assert not back.state.fitted
    told = []
    back.fit(lambda words, share: told.append((words, share)))
    assert error(back).fitted < 1.15 and error(back).held_out < 1.15
    assert error(back, state=back.reference).fitted == pytest.approx(before.fitted)
    shares = [share for _, share in told]
    assert shares == sorted(shares) and shares[-1] == 1.0 and len({words for words, _ in told}) >= 4
    known = back.state.known[f"{MISSING}.rise"]
    assert known.low < back.state.values[f"{MISSING}.rise"] < known.high


def test_a_fit_gives_the_same_errors_as_the_comparison_of_the_same_model(back):
    found = sw.compare(back.campaign, system=False)
    for each in back.errors():  # samples of roll and warp that are zero to the last digit are counted here only
        assert each.fitted == pytest.approx(found.error(each.relation, held_out=False), rel=6e-3)
        assert each.held_out == pytest.approx(found.error(each.relation, held_out=True), rel=6e-3)


def test_what_progress_raises_ends_a_fit_and_leaves_the_session_as_it_was(back):
    class Enough(Exception):
        pass

    def stop(words, share):
        if share > 0.05:
            raise Enough

    before = back.state
    with pytest.raises(Enough):
        back.fit(stop)
    assert back.state is before


def test_an_effect_comes_back_with_the_size_it_had(back):
    back.toggle(MISSING)
    back.set(f"{MISSING}.rise", 0.42)
    back.toggle(MISSING)
    assert MISSING not in back.state.labels
    back.toggle(MISSING)
    assert back.state.values[f"{MISSING}.rise"] == 0.42


def test_dragging_one_number_is_one_step_of_the_history(back):
    back.toggle(MISSING)
    for value in np.linspace(0.1, 0.5, 9):
        back.set(f"{MISSING}.rise", float(value))
    assert len(back.history.states) == back.history.place + 1
    back.undo()
    assert back.state.words == f"{MISSING} added"
    back.redo()
    assert back.state.values[f"{MISSING}.rise"] == 0.5


def test_a_number_that_is_dragged_moves_the_error_and_the_curve(back):
    back.toggle(MISSING)
    back.set(f"{MISSING}.rise", 0.1)
    small, curve = error(back).fitted, back.series("sine_hv").predicted
    back.set(f"{MISSING}.rise", 1.5)
    assert error(back).fitted != pytest.approx(small, rel=0.05)
    assert np.nanmax(np.abs(back.series("sine_hv").predicted)) > 1.1 * np.nanmax(np.abs(curve))


def test_an_effect_at_its_absence_changes_nothing(back):
    before = back.series("sine_hv").predicted
    back.toggle(MISSING)
    back.set(f"{MISSING}.rise", 0.0)
    assert np.array_equal(back.series("sine_hv").predicted, before, equal_nan=True)


@pytest.mark.parametrize("relation", ["pads", "girder", "roll", "warp", "motion"])
def test_the_residual_of_a_series_is_what_the_error_is_made_of(back, relation):
    of = back.ready.residuals(back.state).block(relation, 1)
    part = of.value
    shown, judged = back.series("quake_hv", relation), part != 0.0
    assert shown.measured.shape == shown.predicted.shape == (len(shown.time), len(shown.labels))
    noise = of.noise if shown.unit != "1" else np.ones(part.shape)
    assert shown.residual.reshape(part.shape)[judged] == pytest.approx((part * noise)[judged], abs=1e-6 * noise.max())


def test_heave_and_pitch_are_predicted_to_their_floor(back):
    for relation in ("heave", "pitch"):
        shown = back.series("quake_hv", relation)
        assert np.std(shown.residual) < 0.1 * np.std(shown.measured)


def test_what_cannot_be_is_refused_in_a_sentence(back):
    with pytest.raises(SettingError, match="out of bounds"):
        back.set("rig.mass", 1.0)
    with pytest.raises(UnitError, match="dimension"):
        back.set("rig.mass", "3 m")
    with pytest.raises(UnknownNameError, match="number of this model"):
        back.set("rig.mas", 1e4)
    with pytest.raises(SettingError, match="acts on one gauge"):
        back.toggle("channel_gain")
    with pytest.raises(SettingError, match="no balance"):
        back.series("sine_hv", "heat")
    with pytest.raises(SettingError, match="`explain` looks for one"):
        back.take_suggestion()


def test_a_gauge_fault_on_a_card_has_one_set_of_numbers(back):
    before = error(back, "heave").fitted
    back.toggle("channel_gain", "pad_*_N")
    back.set("channel_gain[pad_*_N].gain", "2 %")
    assert error(back, "heave").fitted > 2.0 * before
    back.toggle("channel_gain", "pad_*_N")
    assert error(back, "heave").fitted == pytest.approx(before)


def test_another_model_is_judged_by_the_same_noise(back):
    same = back.compare_with(back.model)
    for row in same:
        assert row["the other"] == pytest.approx(row["this model"], rel=1e-6)
    rated = {row["balance"]: row["the other"] for row in back.compare_with("bridge1")}
    assert rated["pad friction"] > 1.2 * error(back).error


def test_the_held_out_replay_tells_what_an_engineer_asks_for(back):
    found = back.replay()
    assert found.run == "quake2_hv" and len(found.record) == len(back.series("quake2_hv").time)
    for name, value in found.measured.items():
        assert found.responses[name] == pytest.approx(value, rel=0.2)


def test_a_notebook_shows_table_and_picture(back):
    shown = back._repr_mimebundle_()
    assert "<table" in shown["text/html"] and "data:image/png;base64," in shown["text/html"]
    assert "pad friction" in shown["text/html"]


def test_a_model_whose_effect_speaks_of_an_inertia_begins_with_that_inertia(written):
    """What was added to such a model could not be fitted: the inertia was free and had no value."""
    model = base_model("bridge1").adding(use("table_pitch"))
    session = Session(written, model, keep=False)
    free = {f.key for f in session.ready.free(session.state)}
    assert "rig.pitch_inertia" in free and free <= session.state.values.keys()
