"""The paper, figure by figure: what it states, what we get, whether it holds, and what had to be assumed."""

from slipwise.paper.ensemble import run_ensemble
from slipwise.paper.finding import VERDICTS, Finding, Study
from slipwise.paper.member import Member, run_member
from slipwise.paper.plan import Plan, plan
from slipwise.paper.reenact import Reenactment, as_json, assumptions, reenact
from slipwise.paper.settings import SETTINGS, PaperSettings, change, paper_model

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
