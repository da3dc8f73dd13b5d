"""Overdetermined equations, and which faults they show: small systems of which the answer is known."""

import numpy as np

from slipwise.planning.structural_analysis import analyse_structure, find_overdetermined


def test_two_gauges_of_one_quantity_check_each_other_but_accuse_neither():
    incidence = np.array([[1], [1]], bool)
    found = analyse_structure(incidence, np.eye(2, dtype=bool))
    assert found.detectable.all()
    assert not found.isolable.any()


def test_three_gauges_of_one_quantity_tell_which_of_them_is_wrong():
    found = analyse_structure(np.ones((3, 1), bool), np.eye(3, dtype=bool))
    assert np.array_equal(found.isolable, ~np.eye(3, dtype=bool))


def test_one_gauge_alone_checks_nothing():
    found = analyse_structure(np.ones((1, 1), bool), np.ones((1, 1), bool))
    assert not found.detectable.any()


def test_an_equation_of_known_quantities_alone_is_a_check():
    incidence = np.array([[0, 0], [1, 1]], bool)
    assert np.array_equal(find_overdetermined(incidence), [True, False])


def test_unknowns_of_an_underdetermined_part_leave_the_rest_checked():
    # two gauges of the first unknown; one equation for two others
    incidence = np.array([[1, 0, 0], [1, 0, 0], [1, 1, 1]], bool)
    assert np.array_equal(find_overdetermined(incidence), [True, True, False])


def test_a_fault_of_many_equations_is_seen_where_one_of_them_is_checked():
    incidence = np.array([[1, 0], [1, 0], [0, 1]], bool)
    broken = np.array([[1], [0], [1]], bool)
    assert analyse_structure(incidence, broken).detectable.all()


def test_an_isolable_fault_is_detectable():
    rng = np.random.default_rng(0)
    for _ in range(200):
        incidence, broken = rng.random((7, 5)) < 0.4, rng.random((7, 4)) < 0.3
        found = analyse_structure(incidence, broken)
        assert not (found.isolable & ~found.detectable[:, None]).any()
