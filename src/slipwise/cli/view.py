"""`slipwise view`: open a recording."""

from pathlib import Path
from typing import Annotated

import typer

from slipwise.cli.console import say_next


def view(folder: Annotated[Path, typer.Argument(help="A folder that a command wrote, or an .rrd file.")]) -> None:
    """Open a folder's recording in the rerun viewer, which listens on this machine only.

    Example: `slipwise view out/replay`
    """
    from slipwise.view.recordings.viewer import open_viewer

    open_viewer(folder)
    say_next("`slipwise compare CAMPAIGN` holds a model against what was measured")
