"""The workbench: a local page on which a session is worked at.

`serve` opens it; nothing else here is for users.
"""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from slipwise.effects import Trust


def serve(campaign: Path | str, *, trust: "Trust" = False, port: int = 0, show: bool = True) -> None:
    """Open a campaign on a page of this machine, and stay until Ctrl-C; what is done there is on disk at once.

    Args:
        campaign: its folder.
        trust: effect files that a model or the last session names and that may be run.
        port: to listen on; any that is free if 0.
        show: open the page in the browser.

    Raises:
        InputError: the campaign cannot be read, another program has it open, or the extra is not installed.
    """
    from slipwise.workbench.server import run

    run(campaign, trust=trust, port=port, show=show)


__all__ = ["serve"]
