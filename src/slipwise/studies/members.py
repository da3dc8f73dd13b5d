"""Members of an ensemble, the paper's or a user's: each a replay with a key of all that decides it, run once."""

import hashlib
import json
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

from slipwise.errors import SimulationError
from slipwise.jobs.code_hash import hash_of_imports
from slipwise.jobs.executors import ONE_AT_A_TIME
from slipwise.jobs.job_log import Numbers


def key_of(content: Any, module: str) -> str:
    """Return the key of a member: a hash of its numbers, of the code that runs it and of MuJoCo's version.

    Args:
        content: all that decides the member beside code, as JSON can hold it.
        module: name of the module that runs it.
    """
    code = [version("mujoco"), hash_of_imports(module, "effects/*.py")]
    return hashlib.sha256(json.dumps([content, code], sort_keys=True).encode()).hexdigest()[:20]


def numbers_or_failure(shake: Callable[[], Numbers]) -> Numbers:
    """Shake one member; a simulation that diverges is a result too: "failed" says why."""
    with ONE_AT_A_TIME:
        try:
            return shake()
        except SimulationError as error:
            return {"failed": str(error)}
