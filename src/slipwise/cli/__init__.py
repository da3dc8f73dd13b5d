"""The command line: one short function per command; each command is one verb of the library."""

import sys
import warnings
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli import (
    bench,
    campaign,
    demo,
    diagnose,
    discover,
    edit,
    effects,
    ensemble,
    lists,
    next_test,
    paper,
    replay,
    view,
)
from slipwise.errors import SlipwiseError, SlipwiseWarning, visible

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
edit.register(app)
next_test.register(app)
ensemble.register(app)
bench.register(app)
paper.register(app)
view.register(app)
lists.register(app)
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


def _show_warning(message: Warning | str, category: type[Warning], *_: object, **__: object) -> None:
    if issubclass(category, SlipwiseWarning):
        print(f"warning: {visible(str(message))}", file=sys.stderr)


def main() -> None:
    """Run the command line: 0 done, 2 bad input (one clear message), 130 interrupted."""
    with warnings.catch_warnings():
        warnings.simplefilter("always", SlipwiseWarning)
        warnings.showwarning = _show_warning
        try:
            code = app(standalone_mode=False)
        except typer.TyperException as error:
            words = getattr(error, "format_message", error.__str__)()
            print(f"error: {visible(words.rstrip('.'))}; `slipwise --help` shows what is possible", file=sys.stderr)
            code = 2
        except SlipwiseError as error:
            print(f"error: {visible(str(error))}", file=sys.stderr)
            code = 2
        except (KeyboardInterrupt, typer.Abort):
            print("interrupted: nothing half-written was left", file=sys.stderr)
            code = 130
        except BrokenPipeError:
            sys.stderr.close()
            code = 0
    sys.exit(code if isinstance(code, int) else 0)
