"""How time and memory grow with a campaign: `compare` and `diagnose` of more runs, longer runs and faster loggers.

    python scripts/12_growth.py [--quick] [--out out/growth]

Each campaign is a replay of the paper's rig with a breakaway peak, with the noise of gauges, and is looked at in a
process of its own. Time is that of all processors together, so that a busy machine does not count; memory is what all
processes of a command hold at once, shared pages counted once. The exponent says how time grows with samples: 1 is a
straight line. Linux only, for memory is read from /proc.
"""

import argparse
import os
import resource
import threading
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, Logger, Run
from slipwise.comparison.compare import compare
from slipwise.diagnosis.diagnose import diagnose
from slipwise.jobs.parallel import begin_worker
from slipwise.model import base_model, use
from slipwise.record import Record, write_json
from slipwise.signals.filters import LowPass, lowpass
from slipwise.simulation.replay import replay

#: Runs, seconds of each, samples a second.
Size = tuple[int, float, float]
SIZES: dict[str, tuple[Size, ...]] = {
    "runs": tuple((runs, 5.0, 500.0) for runs in (2, 5, 20, 60)),
    "seconds": tuple((5, seconds, 1000.0) for seconds in (10.0, 60.0, 600.0)),
    "rate": tuple((5, 10.0, rate) for rate in (200.0, 500.0, 1000.0, 2000.0)),
}
QUICK: dict[str, tuple[Size, ...]] = {"runs": ((2, 3.0, 200.0),)}
VERBS: dict[str, Callable[[Campaign], object]] = {
    "compare": lambda campaign: compare(campaign, system=False),
    "diagnose": diagnose,
}
#: End of a channel's name -> noise of a laboratory's gauge [SI].
NOISE = {"ax": 0.02, "az": 0.02, "slip_x": 2e-5, "N": 60.0, "Fx": 15.0}
FILTER = LowPass(80.0)
#: Between two looks at the memory [s].
_LOOK = 0.2


@dataclass(frozen=True)
class Cost:
    """What a command took.

    Attributes:
        verb: of the command.
        runs: of the campaign.
        seconds: of each.
        rate: samples a second [Hz].
        samples: of all runs.
        processor: time of all processors [s].
        memory: held at most [bytes].
    """

    verb: str
    runs: int
    seconds: float
    rate: float
    samples: int
    processor: float
    memory: int

    @property
    def words(self) -> str:
        """A line of a table."""
        size = f"{self.runs:3d} runs of {self.seconds:5g} s at {self.rate:5g} Hz, {self.samples:8d} samples"
        return f"{self.verb:8s} {size}: {self.processor:6.1f} s of processors, {self.memory / 2**20:6.0f} MB"


def campaign_of(runs: int, seconds: float, rate: float) -> Campaign:
    """Replay different earthquakes and measure them; the last run is held out."""
    model, rng = base_model("bridge1").adding(use("breakaway")), np.random.default_rng(1)
    out = []
    for number in range(runs):
        motion = f"quake:seed={number + 1},peak=0.7g,f=3Hz,strong={max(seconds, 2.0):g}s,vertical=0.3g"
        shaken = replay(model, motion, output_dt=1.0 / rate).record
        count = min(len(shaken), round(seconds * rate))
        channels = {}
        for name, values in shaken.channels.items():
            noise = NOISE.get(name if name == "slip_x" else name.rpartition("_")[2])
            if noise is not None and name.startswith(("slip_x", "table_a", "girder_a", "pad_")):
                seen = lowpass(values, shaken.dt, FILTER) if rate > 3.0 * FILTER.frequency else values
                channels[name] = (seen + rng.normal(0.0, noise, len(values)))[:count]
        role = "holdout" if number == runs - 1 else "fit"
        out.append(
            Run(f"run{number}", role, Record(shaken.time[:count], channels), 1800.0, None, f"{number}", f"{number}")
        )
    return Campaign("grown", "bridge1", model.specimen, Logger(FILTER, known=True), tuple(out), Path())


def cost(verb: str, size: Size) -> Cost:
    """Run a command on a campaign of this size, in a process of its own."""
    campaign = campaign_of(*size)
    held, before = [_held()], _processor()
    over = threading.Event()

    def look() -> None:
        while not over.wait(_LOOK):
            held.append(_held())

    watching = threading.Thread(target=look)
    watching.start()
    VERBS[verb](campaign)
    over.set()
    watching.join()
    return Cost(verb, *size, sum(len(run.record) for run in campaign.runs), _processor() - before, max(held))


def _processor() -> float:
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in used)


def _held() -> int:
    """Give the memory of this process and its children now [bytes], shared pages counted once."""
    total, waiting = 0, [os.getpid()]
    while waiting:
        process = Path(f"/proc/{waiting.pop()}")
        try:
            waiting += [
                int(p) for task in (process / "task").iterdir() for p in (task / "children").read_text().split()
            ]
            lines = (process / "smaps_rollup").read_text().splitlines()
        except OSError:  # it has ended
            continue
        total += sum(1024 * int(line.split()[1]) for line in lines if line.startswith("Pss:"))
    return total


def exponent(costs: list[Cost]) -> float:
    """Give the power of the samples with which time grows; NaN for one size."""
    if len(costs) < 2:
        return float("nan")
    samples, seconds = (np.log([getattr(c, name) for c in costs]) for name in ("samples", "processor"))
    return float(np.polyfit(samples, seconds, 1)[0])


def main() -> None:
    """Measure, print, keep."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/growth"))
    parser.add_argument("--quick", action="store_true", help="`compare` of two runs of 3 s only")
    parser.add_argument("--only", choices=sorted(SIZES), help="what grows")
    given = parser.parse_args()
    sizes, verbs = (QUICK, ("compare",)) if given.quick else (SIZES, tuple(VERBS))
    found: list[Cost] = []
    for name in (n for n in sizes if given.only in (None, n)):
        for verb in verbs:
            part = []
            for size in sizes[name]:
                ready = partial(begin_worker, own_cores=True)
                with ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=ready) as pool:
                    part.append(pool.submit(cost, verb, size).result())
                one = part[-1]
                print(one.words, flush=True)
            print(f"{verb:8s} time grows with samples to the power {exponent(part):.2f} with {name}", flush=True)
            found += part
    write_json(given.out / "growth.json", {"costs": [asdict(one) for one in found], "clock": time.strftime("%F")})


if __name__ == "__main__":
    main()
