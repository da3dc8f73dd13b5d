"""What marks a function of the law: plain Python that numba compiles where compiled code calls it."""

from collections.abc import Callable
from typing import Any, TypeVar

from numba.extending import register_jitable

F = TypeVar("F", bound=Callable[..., Any])
#: No wrappers for Python and C, which take a fifth of the time of compiling: only compiled code calls these functions.
#: A division by zero gives infinity or NaN, which ends the simulation with a reason: MuJoCo, which calls them, knows no
#: exceptions, and Python would print a traceback and go on.
INNER = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, "error_model": "numpy"}


def compilable(function: F) -> F:
    """Let numba compile a function where compiled code calls it; Python runs it as it is."""
    return register_jitable(**INNER)(function)
