"""The paper, figure by figure: what it states, what we get, whether it holds, and what had to be assumed."""

from slipwise.studies.paper.finding import VERDICTS, Finding, Study
from slipwise.studies.paper.member import Member, run_ensemble, run_member
from slipwise.studies.paper.plan import Plan, plan
from slipwise.studies.paper.reenact import Reenactment, as_json, assumptions, reenact
from slipwise.studies.paper.settings import SETTINGS, PaperSettings, change, paper_model

__all__ = [
    "SETTINGS",
    "VERDICTS",
    "Finding",
    "Member",
    "PaperSettings",
    "Plan",
    "Reenactment",
    "Study",
    "as_json",
    "assumptions",
    "change",
    "paper_model",
    "plan",
    "reenact",
    "run_ensemble",
    "run_member",
]
