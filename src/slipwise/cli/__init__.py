"""The command line: one short function per command; each command is one verb of the library."""

import sys
from collections.abc import Callable
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli import (
    bearing,
    bench,
    campaign,
    catalogue,
    consequence,
    demo,
    diagnose,
    discover,
    effects,
    ensemble,
    export,
    laws,
    model_edit,
    next_test,
    paper,
    plan,
    replay,
    view,
    watch,
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
#: What one does at a stage of the work -> its commands, as the README lists them.
STAGES: dict[str, tuple[Callable[..., object], ...]] = {
    "See what it does": (demo.demo,),
    "Measure": (plan.plan, campaign.init, watch.watch, campaign.audit, bearing.bearing),
    "Compare": (campaign.compare, workbench.workbench),
    "Name": (
        diagnose.diagnose, diagnose.ladder, discover.discover, laws.laws, model_edit.add, model_edit.remove,
        effects.effects, bench.bench,
    ),
    "Decide": (next_test.next_motion, consequence.consequence),
    "Simulate": (
        replay.replay, view.view, export.export, ensemble.ensemble, paper.paper, catalogue.rigs, catalogue.channels,
        catalogue.motions,
    ),
}  # fmt: skip
for stage, commands in STAGES.items():
    for command in commands:
        app.command("next" if command is next_test.next_motion else None, rich_help_panel=stage)(command)


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
    """Run the command line, and exit with what `exit_codes.py` makes of its end."""
    sys.exit(run_to_its_end(_command))


def _command() -> object:
    give_matplotlib_a_folder()
    pass_over_a_matplotlibrc_here()
    return app(standalone_mode=False)
