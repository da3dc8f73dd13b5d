"""What the page is told of a diagnosis: limits of what was not named, as long as they are of this model."""

from types import SimpleNamespace
from typing import Any, cast

from slipwise.session.session import Session
from slipwise.workbench.replies import _limits


def session_of(terms: list[str], findings: dict[str, Any]) -> Session:
    """A session with these terms and findings, and nothing else."""
    state = SimpleNamespace(terms=[SimpleNamespace(label=label) for label in terms])
    return cast("Session", SimpleNamespace(state=state, findings=findings))


def test_limits_are_told_in_words_until_the_model_has_changed() -> None:
    entry = {"size": 0.5, "value": 0.01, "parameter": "share", "measured": True, "peak_slip": 5e-5}
    findings = {"explain": {"of": ["run_in"], "limits": {"heating": entry}}}
    told = _limits(session_of(["run_in"], findings))
    assert told["heating"].startswith("At most 0.5 times what matters (95 %): share 0.01, 0.05 mm of peak slip")
    assert _limits(session_of(["run_in", "heating"], findings)) == {}
    assert _limits(session_of([], {})) == {}


def test_what_was_kept_before_limits_were_told_has_none() -> None:
    assert _limits(session_of([], {"explain": {"of": []}})) == {}
