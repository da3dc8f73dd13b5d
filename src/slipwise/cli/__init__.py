"""The command line: one short function per command; each command is one verb of the library."""

import sys
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli import (
    bench,
    campaign,
    catalogue,
    demo,
    diagnose,
    discover,
    effects,
    ensemble,
    model_edit,
    next_test,
    paper,
    replay,
    view,
    workbench,
)
from slipwise.cli.exit_codes import run_to_its_end
from slipwise.view.figures.matplotlib_folder import give_matplotlib_a_folder, pass_over_a_matplotlibrc_here

app = typer.Typer(
    name="slipwise",
    help="Which physical effect does the model of a structure on sliding bearings lack?",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
)
demo.register(app)
replay.register(app)
campaign.register(app)
diagnose.register(app)
discover.register(app)
workbench.register(app)
model_edit.register(app)
next_test.register(app)
ensemble.register(app)
bench.register(app)
paper.register(app)
view.register(app)
catalogue.register(app)
effects.register(app)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"slipwise {sw.__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Take what stands before the command."""


def main() -> None:
    """Run the command line, and exit with what `endings.py` makes of its end."""
    sys.exit(run_to_its_end(_command))


def _command() -> object:
    give_matplotlib_a_folder()
    pass_over_a_matplotlibrc_here()
    return app(standalone_mode=False)
