"""One stacked fit of pads and balances with one set of numbers."""

from slipwise.fit.base import BaseFit, fit_base
from slipwise.fit.problem import Problem
from slipwise.fit.residuals import RELATIONS
from slipwise.fit.solve import Solution, solve
from slipwise.fit.terms import Free, Term

__all__ = ["RELATIONS", "BaseFit", "Free", "Problem", "Solution", "Term", "fit_base", "solve"]
