"""Work on many campaigns that goes on where it was stopped: every result is one line of a file."""

import json
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Any

from slipwise.jobs.parallel import begin_worker

Result = dict[str, Any]


def read_results(lines: Path) -> list[Result]:
    """Give the results that are there."""
    return [json.loads(line) for line in lines.read_text().splitlines()] if lines.exists() else []


def run_jobs(
    lines: Path, jobs: Mapping[str, tuple[Any, ...]], workers: int, line: Callable[[Result, int, int], str],
    begin: Callable[[], None] = begin_worker,
) -> list[Result]:  # fmt: skip
    """Run jobs in processes, write each result and print a line of it; fewer results if it is stopped.

    Each campaign has a process of its own: what one needs of memory is given back before the next.

    Args:
        lines: file to which results are added.
        jobs: name -> a function and its arguments.
        workers: processes.
        line: gives the line of a result, its number and how many there will be.
        begin: called in every process first; as given, it ends when this process is gone.
    """
    out = []
    with ThreadPoolExecutor(workers) as pool, lines.open("a") as stream:
        futures = [pool.submit(_alone, begin, *job) for job in jobs.values()]
        try:
            for number, future in enumerate(as_completed(futures), start=1):
                out.append(future.result())
                stream.write(json.dumps(out[-1]) + "\n")
                stream.flush()
                print(line(out[-1], number, len(jobs)), flush=True)
        except (KeyboardInterrupt, BrokenProcessPool):
            pass  # what is done is shown
        finally:  # else the campaigns that are left would run on, unseen, for as long as they take
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in active_children():
                worker.terminate()
    return out


def _alone(begin: Callable[[], None], work: Callable[..., Result], *arguments: Any) -> Result:
    """Do one job in a process of its own; `max_tasks_per_child` of one pool for all can wait for ever at its end."""
    with ProcessPoolExecutor(1, get_context("spawn"), begin) as process:
        return process.submit(work, *arguments).result()
