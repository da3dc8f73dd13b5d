"""An effect that becomes a plainer one at an end of its bounds is named only for what the plainer one cannot do."""

import pytest

from hypotheses import base, decided, left_by, searched
from slipwise.effects import catalogue
from slipwise.relations.parameters import Term
from slipwise.selection import plainer
from slipwise.selection.plainer import holds_as_limit, plainest

RIM, SPRING = Term(catalogue()["restrainer"]), Term(catalogue()["slide_curvature"])


@pytest.mark.parametrize(("with_gap", "named"), [(9.0, SPRING), (8.8, SPRING), (8.0, RIM)])
def test_a_rim_must_explain_a_share_of_what_a_spring_leaves(with_gap: float, named: Term) -> None:
    of = base(pads=400.0)
    rim, spring = left_by(RIM, of=of, pads=with_gap), left_by(SPRING, of=of, pads=9.0)
    assert plainest(searched(of, rim, spring), rim)[1].terms == (named,)
    assert plainest(searched(of, spring, rim), spring)[1].names == ("slide_curvature",), "a spring is no rim"


@pytest.mark.parametrize(("gap", "left", "named"), [(1.0, 9.0, SPRING), (10.0, 9.0, RIM), (1.0, 8.0, RIM)])
def test_at_its_end_an_effect_is_the_plainer_one_whatever_motions_that_are_left_out_seem_to_say(
    gap: float, left: float, named: Term, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Left-out motions are judged by one linear step, which may go far wrong; all motions together fit alike."""
    of, low = base(pads=400.0), catalogue()["restrainer"].parameter("limit").low
    rim = left_by(RIM, of=of, values={"restrainer.limit": gap * low}, pads=left)
    spring = left_by(SPRING, of=of, pads=9.0)
    monkeypatch.setattr(plainer, "is_kept", lambda *of: True)
    assert plainest(searched(of, rim, spring), rim)[1].terms == (named,)


def test_beside_another_effect_the_same_is_asked() -> None:
    of = base(pads=400.0, girder=100.0)
    both, plain = left_by("buffer_damping", RIM, of=of), left_by("buffer_damping", SPRING, of=of)
    assert set(plainest(searched(of, both, plain), both)[1].names) == {"buffer_damping", "slide_curvature"}


def test_what_holds_the_named_effect_as_its_limit_is_no_rival_of_it() -> None:
    """A rim whose gap is nearly nothing fits a sphere as well as a sphere does."""
    of = base(pads=400.0)
    spring, rim, other = left_by(SPRING, of=of), left_by(RIM, of=of), left_by("slide_tilt", of=of)
    assert holds_as_limit(rim, spring) and not holds_as_limit(spring, rim) and not holds_as_limit(other, spring)
    assert decided(searched(of, spring, rim)).kind == "named"
    assert decided(searched(of, spring, other)).kind == "ambiguous"
