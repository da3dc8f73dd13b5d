"""Hold the limits of what is not named against true sizes, and twins against replays of the same model.

    python scripts/count_limits.py --out out/families --only usual_dirt small_effects
    python scripts/count_limits.py --campaign out/families/campaigns/uneven_seating-ode-710000 --twins heating run_in

The first diagnoses campaigns of `scripts/16_families.py` and counts how many true sizes of effects that were not named
lie below their limits. The second fits the base model to a campaign, replays its runs with one effect at the limit of
what matters, filtered and with noise as the gauges have, fits anew, and prints the size that the effect's column tells:
1 where a twin made of products of columns is what a replay gives.
"""

import argparse
import json
from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import fit_prepared
from slipwise.record import Record
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.candidates import list_candidates
from slipwise.selection.columns import compute_raw_columns, list_forms
from slipwise.selection.importance import build_answering_model, compute_answer
from slipwise.selection.initial_grid import shapes, strengths
from slipwise.selection.sensitivities import small
from slipwise.selection.units import compute_units
from slipwise.signals.filters import lowpass


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, help="folder of the families")
    parser.add_argument("--only", nargs="*", default=[], help="beginnings of names of campaigns")
    parser.add_argument("--campaign", type=Path, help="folder of a campaign of which nothing is missing")
    parser.add_argument("--twins", nargs="*", default=[], help="effects that are put into replays of it")
    given = parser.parse_args()
    if given.out is not None:
        count_below(given.out, tuple(given.only))
    if given.campaign is not None:
        print_sizes_of_twins(given.campaign, given.twins)


def count_below(out: Path, only: tuple[str, ...]) -> None:
    """Diagnose campaigns, and print how many true sizes lie below their limits."""
    below = count = 0
    for folder in sorted(p for p in (out / "campaigns").iterdir() if p.name.startswith(only or ("",))):
        answer = json.loads((out / "answers" / f"{folder.name}.json").read_text(encoding="utf-8"))
        limits = diagnose(folder).limits
        for name, of in answer["effects"].items():
            if name in limits:
                count, below = count + 1, below + (of["of_limit"] <= limits[name].size)
                print(f"{folder.name} {name}: true {of['of_limit']:.2f}, limit {limits[name].size:.2f}", flush=True)
    print(f"{below} of {count} true sizes lie below their limits")


@one_thread_algebra()
def print_sizes_of_twins(folder: Path, effects: list[str]) -> None:
    """Print the size of each effect in a replay of a campaign that has it at the limit of what matters."""
    prepared = prepare(folder)
    base = fit_prepared(prepared)
    terms = {t.label: t for t in list_candidates(base)[0]}
    for number, name in enumerate(effects):
        term, moved = terms[name], strengths(terms[name].effect)[0]
        share = compute_units(base, [term], [], prepared.recorded.materiality, {})[name, moved.name].share
        values = small(term.effect, shapes(term.effect)[0], moved)
        off = float(moved.neutral or 0.0)
        unit = (values[moved.name] - off) / share
        values[moved.name] = off + unit
        twin = replayed(load_campaign(folder), base, term, values, np.random.default_rng(number))
        size, error = size_of(fit_prepared(prepare(twin)), name, unit)
        print(f"{name}: {size:.2f} limits, standard error of white noise {error:.2f}", flush=True)


def replayed(
    campaign: Campaign, base: BaseFit, term: Term, values: dict[str, float], rng: np.random.Generator
) -> Campaign:
    """Return a campaign with what the fitted model and one more effect answer to its table motions."""
    model = build_answering_model(base).adding(*term.uses({f"{term.label}.{n}": v for n, v in values.items()}))
    runs = []
    for place, run in enumerate(campaign.runs):
        of = base.objective.run(place)
        answer = compute_answer(model, base, place, replayed=True).channels
        channels = dict(run.record.channels)
        for name in (n for n in channels if n in answer and not n.startswith("table")):
            channels[name] = lowpass(answer[name], of.dt, campaign.logger.of(name))
            channels[name] += rng.normal(0.0, of.noise[name], len(of.time))
        runs.append(replace(run, record=Record(run.record.time, channels)))
    return replace(campaign, runs=tuple(runs))


def size_of(base: BaseFit, label: str, unit: float) -> tuple[float, float]:
    """Return the size of an effect that a fit without it lacks, beside its base numbers, and its standard error."""
    term = next(t for t in list_candidates(base)[0] if t.label == label)
    rows = make_averaged_rows(base.objective)
    moved = strengths(term.effect)[0].name
    column = next(
        c for c in compute_raw_columns(base, list_forms(base, [term]), rows) if c.form == 0 and c.strength == moved
    )
    every = np.column_stack([rows.average(base.solution.jacobian), column.column.astype(float) * (unit / column.unit)])
    left = rows.average(base.solution.residuals.stacked(base.objective.fitted))
    products = every.T @ every
    products += np.diag(1e-9 * np.diag(products) + 1e-12)
    return float(-np.linalg.solve(products, every.T @ left)[-1]), float(np.linalg.inv(products)[-1, -1] ** 0.5)


if __name__ == "__main__":
    main()
