"""Which physical effect does a model lack? Screening, refits, judgement, verdict."""

from slipwise.diagnose.leftover import Surface, leftover
from slipwise.diagnose.result import Candidate, Diagnosis
from slipwise.diagnose.run import as_fit, diagnose
from slipwise.diagnose.search import search
from slipwise.diagnose.tried import Search
from slipwise.diagnose.verdict import Verdict, judge

__all__ = [
    "Candidate",
    "Diagnosis",
    "Search",
    "Surface",
    "Verdict",
    "as_fit",
    "diagnose",
    "judge",
    "leftover",
    "search",
]
