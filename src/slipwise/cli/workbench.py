"""`slipwise workbench`: a local page on which a model is compared, changed, fitted and accepted."""

from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import say_next
from slipwise.cli.options import Allowed, CampaignFolder, Trusted


def workbench(
    campaign: CampaignFolder,
    effect: Allowed = None,
    trust: Trusted = False,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on; 0 takes any that is free.")] = 0,
    show: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,
) -> None:
    """Open a page of this machine: compare, see where it fails, add what is missing, watch the error fall, go back.

    It listens on this machine only, and every step is on disk at once. Ctrl-C ends it.

    Example: `slipwise workbench campaigns/march`
    """
    sw.workbench.serve(campaign, trust=trust or effect or (), port=port, show=show)
    say_next(f"`slipwise workbench {quote(str(campaign))}` goes on where this ended")
