"""What all tests share: the law and the bench's simulator are compiled once, and no worker waits for another's core."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
BENCHMARKS = TESTS.parent / "benchmarks" / "src"
#: What compiles, each for itself: the library's law over records and in a replay, the second simulator.
COMPILING = (
    "from slipwise.model import base_model; from slipwise.motion import load_motion;"
    "from slipwise.simulation.replay import replay; from slipwise.simulation.predict import predictor;"
    "model = base_model('bridge1'); predictor(model); replay(model, load_motion('sine:5Hz,0.1g,cycles=9'))",
    "from slipwise_benchmarks import build_campaign; build_campaign(1, effects=())",
)


def pytest_configure(config: pytest.Config) -> None:
    """Compile on both cores at once; else every worker would compile all of it, and wait.

    Every core has a worker: a second thread of linear algebra would spin beside another worker. Only the environment
    of a process that has not loaded the library yet reaches all of its threads.
    """
    if hasattr(config, "workerinput") or not config.getoption("numprocesses", None) or config.option.collectonly:
        return
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    paths = os.pathsep.join([str(TESTS), str(BENCHMARKS), os.environ.get("PYTHONPATH", "")])
    environment = {**os.environ, "PYTHONPATH": paths}
    started = [subprocess.Popen([sys.executable, "-c", code], env=environment) for code in COMPILING]
    for process in started:
        process.wait()
