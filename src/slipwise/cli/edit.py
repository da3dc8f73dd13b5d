"""`slipwise add` and `slipwise remove`: edit model.toml, refit, and print the error before and after."""

from pathlib import Path
from typing import Annotated

import typer

from slipwise.campaign import load_campaign
from slipwise.cli.console import OUT
from slipwise.cli.diagnose import start_model, steps
from slipwise.estimation.base_fit import BaseFit, fit_finely
from slipwise.model import Model, base_model
from slipwise.model_file import save_model
from slipwise.view.terminal import print_table

Folder = Annotated[Path, typer.Option("--campaign", help="Folder with campaign.toml; model.toml is kept there too.")]


def add(
    name: Annotated[str, typer.Argument(help="An effect of `slipwise effects`, or a file of your own: ./mine.py.")],
    campaign: Folder = Path(),
) -> None:
    """Add an effect to model.toml, refit everything, and print the error before and after.

    Example: `slipwise add run_in --campaign campaigns/march`
    """
    from slipwise.diagnosis.ladder import ladder

    measured = load_campaign(campaign)
    with steps() as tell:
        climbed = ladder(measured, [name], start_model(campaign, None), progress=tell)
    _tell(climbed.steps[0].relations, climbed.steps[-1].relations)
    _save(_model(climbed.fits[-1]), campaign)


def remove(
    name: Annotated[str, typer.Argument(help="Name of an effect of model.toml.")],
    campaign: Folder = Path(),
) -> None:
    """Take an effect out of model.toml, refit everything, and print the error before and after.

    Example: `slipwise remove run_in --campaign campaigns/march`
    """
    from slipwise.diagnosis.hypothesis import base_hypothesis
    from slipwise.evidence.residual_summary import error_of

    measured = load_campaign(campaign)
    before = start_model(campaign, None) or base_model(measured.specimen)
    after = before.without(name)
    with steps() as tell:
        tell("fitting with it", 0.0)
        old = fit_finely(measured, before)
        tell("fitting without it", 0.5)
        new = fit_finely(measured, after)
    errors = []
    for fit in (old, new):
        account = base_hypothesis(fit).summary
        errors.append({relation: error_of(account, relation) for relation in account.fitted})
    _tell(*errors)
    _save(_model(new), campaign)


def _model(fit: BaseFit) -> Model:
    return fit.problem.model(fit.solution.values)


def _tell(before: dict[str, float], after: dict[str, float]) -> None:
    rows = [{"balance": n, "before": round(before[n], 2), "after": round(after.get(n, before[n]), 2)} for n in before]
    print_table("Held-out error in multiples of the noise floor", rows)


def _save(model: Model, campaign: Path) -> None:
    path = campaign / "model.toml"
    save_model(model, path)
    OUT.print(f"wrote {path}", markup=False, highlight=False, soft_wrap=True)


def register(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    app.command()(add)
    app.command()(remove)
