"""What a linearisation at a model with effects knows of the numbers that came with them."""

from dataclasses import replace

from hypotheses import base
from slipwise.campaign.materiality import Materiality
from slipwise.effects import catalogue
from slipwise.estimation.least_squares import with_slopes
from slipwise.relations.parameters import PITCH_INERTIA, Term
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.hypothesis import refit
from slipwise.selection.linearisation import linearise


def test_the_inertia_by_which_a_pitching_table_shows_cannot_stand_for_its_absence() -> None:
    """Free down to nothing it made a table's pitch of two floors look like no pitch at all."""
    fit, term = base(), Term(catalogue()["table_pitch"])
    begun = refit(fit, [term], {term.label: {**term.effect.typical(), "compliance": 1e-5}}, most=0)
    found = replace(begun, solution=with_slopes(begun.objective, begun.solution))
    here = linearise(fit, found, make_averaged_rows(found.objective), [], Materiality())
    place = here.keys.index(PITCH_INERTIA)
    assert not here.of_base[place]
    _, spread = here.tolerances[place]
    scale = here.numbers[place].scale
    assert spread * scale < 0.1 * found.solution.values[PITCH_INERTIA]
    assert all(here.of_base[here.keys.index(f.key)] for f in fit.free if f.key in here.keys)
