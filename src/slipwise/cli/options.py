"""Options that commands share, and the model from which they start."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.errors import InputError

CampaignFolder = Annotated[Path, typer.Argument(help="Folder with campaign.toml and the measured runs.")]
System = Annotated[bool, typer.Option(help="Replay the models in MuJoCo as well (system level).")]
ModelFile = Annotated[
    Path | None,
    typer.Option("--model", help="A model.toml to start from; the one beside campaign.toml if there is one."),
]
Own = Annotated[
    list[str] | None, typer.Option("--effect", help="An effect of your own that competes too, by its file (./mine.py).")
]
Trusted = Annotated[
    bool, typer.Option("--trust", help="Run the effect files that model.toml names; they are code: look at them first.")
]
Allowed = Annotated[
    list[str] | None, typer.Option("--effect", help="Run this effect file where model.toml names it; may be repeated.")
]
Figures = Annotated[
    bool, typer.Option("--figures", help="Write every figure of the report as SVG too, with its numbers as CSV beside.")
]
Json = Annotated[bool, typer.Option("--json", help="Print the result as JSON for a program to read.")]


def start_model(
    campaign: Path, given: Path | None, trust: bool = False, allowed: list[str] | None = None
) -> "sw.Model | None":
    """Return the user's model: the file named, or model.toml beside campaign.toml, or nothing.

    Args:
        campaign: its folder.
        given: the model.toml that the user names.
        trust: run every effect file that it names.
        allowed: effect files that the command names, and that may be run for that.
    """
    beside = campaign / "model.toml"
    path = given or (beside if beside.is_file() else None)
    return None if path is None else sw.load_model(path, trust=trust or allowed or ())


def refuse_unnamed(allowed: list[str] | None, start: "sw.Model | None") -> None:
    """Refuse effect files that may be run where the model to start from does not name them: nothing would run.

    Raises:
        InputError: a file that the model does not name.
    """
    named = {use.effect.path for use in start.uses} - {Path()} if start is not None else set[Path]()
    for path in allowed or []:
        if Path(path).resolve() not in {one.resolve() for one in named}:
            here = ", ".join(sorted(map(str, named))) or "none"
            raise InputError(
                f"--effect {path}: the model to start from does not name it; effect files that it names: {here}; "
                "`slipwise diagnose --effect` lets a file compete, `slipwise add` puts one into the model"
            )


def own_effects(given: list[str] | None, start: "sw.Model | None" = None) -> "tuple[sw.Effect, ...]":
    """Return the effects of a user's own files, but for those that the model to start from holds already."""
    held = {use.effect.path for use in start.uses} if start is not None else set()
    return tuple(effect for path in given or [] if (effect := sw.effects.find_effect(path)).path not in held)
