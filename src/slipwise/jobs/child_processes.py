"""What every process that is started here has in common: no module of the current folder is taken for an installed one.

Python puts the current folder before all others for `python -c` and `python -m`, by which `multiprocessing` starts its
processes. In a stranger's folder a file multiprocessing.py, or numpy.py, would be run.
"""

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager

#: Python's own switch against it: set for a process, it holds for those that this one starts.
_SAFE = "PYTHONSAFEPATH"
_ONE_AT_A_TIME = threading.RLock()


@contextmanager
def on_a_safe_path() -> Iterator[None]:
    """Start processes within this block; whatever else starts processes later is as before."""
    with _ONE_AT_A_TIME:
        before = os.environ.get(_SAFE)
        os.environ[_SAFE] = "1"
        try:
            yield
        finally:
            if before is None:
                del os.environ[_SAFE]
            else:
                os.environ[_SAFE] = before
