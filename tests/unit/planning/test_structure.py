"""What gauges of the reference rig show and tell apart, whatever the motion."""

import numpy as np
import pytest

from slipwise.effects import catalogue
from slipwise.errors import InputError
from slipwise.model import base_model
from slipwise.planning.balance_equations import list_equations
from slipwise.planning.gauge_kits import choose_set, list_kits, list_remedies, list_sets
from slipwise.planning.structure import Structure, compute_structure, list_faults, make_arrays
from slipwise.rig import load_specimen

LOADS = tuple(f"pad_{pad}_N" for pad in "ABCD")
FRICTION = tuple(f"pad_{pad}_Fx" for pad in "ABCD")
BASIC = ("slip_x", "girder_ax", "table_ax")
RIG = load_specimen("bridge1")
EQUATIONS = list_equations(RIG)
KITS = list_kits(RIG)
EVERY = tuple(dict.fromkeys(c for kit in KITS for c in kit.channels))
BASE = base_model(RIG)
EFFECTS = [e for e in catalogue().values() if e.base != "springs" and not e.in_samples and e.name not in BASE]
FAULTS, CANNOT = list_faults(EQUATIONS, EVERY, EFFECTS)
SETS = {
    "usual": (*LOADS, *FRICTION, *BASIC),
    "with vertical accelerometers": (*LOADS, *FRICTION, *BASIC, "girder_az_1", "girder_az_2"),
    "without pad forces": (*LOADS, *BASIC, "girder_az"),
    "without load cells": (*FRICTION, *BASIC, "girder_az"),
    "without cells": (*BASIC, "girder_az"),
    "everything": EVERY,
}


def judge(channels) -> Structure:
    return compute_structure(EQUATIONS, FAULTS, channels)


def apart(channels, one: str, other: str) -> bool:
    found = judge(channels)
    return not {one, other} & set(found.unseen) and not {(one, other), (other, one)} & set(found.confused)


def test_vertical_accelerometers_part_load_cells_from_friction_where_friction_has_no_cells():
    assert not apart((*LOADS, *BASIC), "pad friction", "pad_*_N")
    assert apart((*LOADS, *BASIC, "girder_az_1", "girder_az_2"), "pad friction", "pad_*_N")


def test_a_girder_that_bends_is_seen_by_a_vertical_accelerometer_alone():
    assert "girder_bending" in judge(SETS["usual"]).unseen
    assert "girder_bending" not in judge((*SETS["usual"], "girder_az")).unseen


def test_a_drag_on_the_girder_is_told_from_its_accelerometer_by_that_of_the_table():
    assert not apart((*LOADS, *FRICTION, "slip_x", "girder_ax"), "guide_drag", "girder_ax")
    assert apart(SETS["usual"], "guide_drag", "girder_ax")


def test_buffers_and_friction_are_one_without_cells_for_friction():
    assert not apart(SETS["without pad forces"], "pad friction", "buffer")
    assert apart(SETS["usual"], "pad friction", "buffer")


def test_the_laws_of_pad_friction_are_one_to_every_gauge():
    [friction] = [fault for fault in FAULTS if fault.name == "pad friction"]
    assert {"heating", "breakaway", "presliding", "run_in", "slide_tilt"} <= set(friction.effects)


def test_one_more_gauge_never_hides_an_effect():
    for channels in SETS.values():
        before = set(judge(channels).unseen)
        for more in set(EVERY) - set(channels):
            kinds = judge(channels).kinds
            assert set(judge((*channels, more)).unseen) & set(kinds) <= before, more


def test_every_effect_of_the_catalogue_breaks_a_balance_or_has_a_reason():
    named = {name for fault in FAULTS for name in fault.effects} | CANNOT.keys()
    assert {effect.name for effect in EFFECTS} <= named
    assert all(CANNOT.values())


def test_a_remedy_shows_what_it_says_it_shows():
    planned = judge(SETS["without pad forces"])
    remedies = list_remedies(planned, KITS, judge)
    assert any(remedy.kits for remedy in remedies)
    for remedy in (r for r in remedies if r.kits):
        then = judge((*planned.channels, *(c for c in remedy.channels if c not in planned.channels)))
        assert remedy.first not in then.unseen
        assert (remedy.first, remedy.second) not in then.confused


def test_a_larger_budget_never_tells_less():
    chosen = [choose_set(list_sets(RIG, KITS, budget), judge) for budget in (3, 6, 10, 13)]
    assert [len(one.channels) <= budget for one, budget in zip(chosen, (3, 6, 10, 13), strict=True)] == [True] * 4
    assert [one.score for one in chosen] == sorted(one.score for one in chosen)


def test_a_budget_that_no_fit_can_do_with_is_refused():
    with pytest.raises(InputError, match="budget of 2 channels is less than every fit needs"):
        list(list_sets(RIG, KITS, 2))


def test_a_slider_has_its_law_alone():
    slider = load_specimen("pad")
    equations = list_equations(slider)
    faults, cannot = list_faults(equations, ("slip_x", "pad_A_N", "pad_A_Fx"), EFFECTS)
    assert {"pad friction"} <= {fault.name for fault in faults}
    assert {"guide_drag", "buffer_damping", "table_pitch"} <= cannot.keys()


@pytest.mark.parametrize("name", SETS)
def test_the_structure_is_that_of_the_fault_diagnosis_toolbox(name):
    toolbox = pytest.importorskip("faultdiagnosistoolbox", reason="of the extra `dev`")
    found, channels = judge(SETS[name]), SETS[name]
    equations = EQUATIONS.with_gauges(channels)
    unknown = sorted(set().union(*equations.values()))
    faults = {f"f{i}": fault for i, fault in enumerate(found.faults)}
    relations = [
        [*(f"x_{quantity}" for quantity in of), *(key for key, fault in faults.items() if equation in fault.equations)]
        + ([f"z_{equation}"] if equation in channels else [])
        for equation, of in equations.items()
    ]
    # the toolbox's own test of detectability knows faults of one equation alone: a fault is detectable where it is
    # isolable from one that breaks an equation which checks nothing
    relations.append(["x_none", "f_none"])
    model = toolbox.DiagnosisModel(
        {
            "type": "VarStruc",
            "x": [*(f"x_{quantity}" for quantity in unknown), "x_none"],
            "f": [*faults, "f_none"],
            "z": [f"z_{channel}" for channel in channels],
            "rels": relations,
        },
        name=name,
    )
    incidence, broken = make_arrays(EQUATIONS, found.faults, channels)
    assert np.array_equal(np.asarray(model.X, bool)[:-1, :-1], incidence)
    assert np.array_equal(np.asarray(model.F, bool)[:-1, :-1], broken)
    told = ~np.asarray(model.IsolabilityAnalysis(), bool)  # its matrix is 1 where a fault is not isolable from another
    looked_for = np.array([not fault.needs for fault in found.faults])
    assert np.array_equal(told[:-1, -1][looked_for], found.answer.detectable[looked_for])
    assert np.array_equal(told[:-1, :-1][looked_for], found.answer.isolable[looked_for])
