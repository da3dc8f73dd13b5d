"""The paper's replays, all at once: on all cores or on somebody else's, resumable, each member run once."""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from pathlib import Path

from slipwise.jobs.executors import run_all
from slipwise.jobs.job_log import Numbers
from slipwise.studies.paper.member import Member, run_member


def run_ensemble(
    members: Sequence[Member],
    folder: Path,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> list[Numbers]:
    """Run what has not been run yet and give the numbers of all members in their order.

    Args:
        members: the replays; equal ones are run once.
        folder: of `members.jsonl`, see `slipwise.jobs.executors`; made if absent.
        executor: any of `concurrent.futures`, also a cluster's, e.g. `dask.distributed.Client(...).get_executor()`; it
            is left running. Processes on this machine when not given.
        workers: processes when no executor is given; as many as there are cores when not given.
        progress: called with the fraction done.

    Returns:
        For every member what `run_member` gives; it does not depend on executor, workers or interruptions.

    Raises:
        InputError: `members.jsonl` was not written by an ensemble.
        OutputError: it cannot be written.
        SlipwiseError: processes were killed. What is finished is kept.
    """
    keys = [member.key() for member in members]

    def tell(done: int, total: int) -> None:
        if progress is not None and total:
            progress(done / total)

    path = folder / "members.jsonl"
    finished = run_all(run_member, keys, members.__getitem__, path, executor=executor, workers=workers, progress=tell)
    return list(finished.numbers(keys))
