"""`--workers` and `--cluster`: where many pieces of work are done."""

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Annotated

import typer

import slipwise as sw


def _possible(given: int | None) -> int | None:
    """Return the number of processes as it was given.

    Raises:
        SettingError: fewer than one.
    """
    sw.executors.checked_workers(given)
    return given


Workers = Annotated[
    int | None, typer.Option(callback=_possible, help="Processes; as many as there are cores when not given.")
]
Cluster = Annotated[
    str | None,
    typer.Option(
        help="Address of a dask scheduler that does the work, e.g. tcp://host:8786; its workers need Slipwise."
    ),
]


@contextmanager
def chosen_executor(cluster: str | None) -> Iterator[Executor | None]:
    """Lend the executor of a cluster; None where the work is done on this machine."""
    if cluster is None:
        yield None
        return
    with sw.executors.on_cluster(cluster) as executor:
        yield executor
