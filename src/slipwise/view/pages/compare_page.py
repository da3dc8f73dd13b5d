"""The report of a comparison: a page that a professor understands in one minute, and everything behind it."""

from typing import Any

from slipwise.comparison.cells import Cell
from slipwise.comparison.component_level import NAMES
from slipwise.comparison.result import Comparison
from slipwise.comparison.sentences import UNITS
from slipwise.noise.level import AT_FLOOR
from slipwise.view.figures import compare_figures as figures
from slipwise.view.figures import error_maps
from slipwise.view.figures.friction_clouds import clouds_figure, friction
from slipwise.view.figures.style import styled
from slipwise.view.pages.fitted_numbers import fitted_numbers, predicted_runs
from slipwise.view.pages.html import Html, Section, bullets, callout, details, figure, page, paragraph, table, verdict
from slipwise.view.words.compare_answers import capital, headline, one_minute, place_words, roles, size, tones
from slipwise.view.words.gauge_rows import gauge_rows


def compare_page(found: Comparison) -> str:
    """Make the report of a comparison: the text of one HTML file that needs nothing else."""
    name = found.campaign.name
    clouds = Section("Friction over load, against speed and pressure", _friction_clouds(found))
    sections = [
        *([Section("The bearings together", _layer(found))] if found.layer else []),
        Section("How well the model does", _errors(found)),
        Section("Where it fails", _places(found)),
        Section("Histories", _histories(found)),
        Section("Loops", _loops(found)),
        *([] if found.layer else [clouds]),
        Section("Are the instruments telling the truth", _audit(found)),
        Section("Noise floor", _floor(found)),
        Section("Fitted numbers", fitted_numbers(found)),
        Section("What was done, and what could not be", _about(found)),
    ]
    return page(f"{name}: the model against the measurement", sections, _summary(found))


def _summary(found: Comparison) -> list[Any]:
    title, words, tone = headline(found)
    facts = {}
    for held, label in ((True, "held out"), (False, "fitted")):
        value = found.error(found.worst[0], held_out=held)
        if value is not None:
            facts[f"worst balance, {label}"] = f"{value:.3g} floors"
    slip = found.system_errors.get("slip_x")
    if slip is not None:
        facts["slip of the replay"] = f"{slip:.3g} floors"
    facts["runs"] = roles(found)
    # a grid, so that the four answers are seen at once on a desk and one below the other on a phone
    columns = "display:grid;gap:0 1.2rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,24rem),1fr))"
    boxes = "".join(
        callout(question, answer, own).text
        for (question, answer), own in zip(one_minute(found), tones(found), strict=True)
    )
    first = [callout("Before anything was fitted", f"{one.words}.", "warn") for one in found.corrections]
    return [verdict(title, words, tone, facts), *first, Html(f'<div style="{columns}">{boxes}</div>')]


def _layer(found: Comparison) -> list[Any]:
    words = (
        "No bearing's force was measured: what all of them give together follows from the accelerations of girder and "
        "storeys, and is known as well as the masses are. Stiffness and damping are those of the linear layer nearest "
        "to each run; period, fraction of critical and what is left do not depend on the masses."
    )
    rows = [
        {
            "run": one.run,
            "role": one.role,
            "period [s]": f"{one.period:.3g}",
            "of critical": f"{one.damping:.1%}",
            "stiffness [kN/m]": f"{one.stiffness / 1e3:.4g}",
            "energy [kJ]": f"{one.energy / 1e3:.3g}",
            "slip [mm]": f"{1e3 * one.peak_slip:.3g}",
            "force over weight": f"{one.peak_force:.1%}",
            "left by a linear layer": f"{one.linear_left:.1%}",
            "left by the model": f"{one.model_left:.1%}",
        }
        for one in found.layer
    ]
    return [paragraph(words), table(rows)]


def _errors(found: Comparison) -> list[Any]:
    pieces: list[Any] = [
        figure(
            figures.errors_figure(found),
            "Error of every balance and channel in multiples of its noise floor. A model that is right stands at the "
            "green line, but for chance; blue bars are runs that the fit has not seen.",
            "Bars of error over floor for every balance and channel",
            narrow=figures.errors_figure(found, narrow=True),
        )
    ]
    rows = []
    for e in found.components:
        rows.append(
            {
                "balance": NAMES[e.relation][0],
                "run": e.run,
                "role": e.role,
                "error [floors]": round(e.error, 3),
                "of measured": "" if e.share != e.share else f"{e.share:.2%}",
                "samples": e.samples,
            }
        )
    pieces.append(details("Every balance in every run", [table(rows)]))
    pieces += predicted_runs(found)
    if found.system:
        own = [
            {
                "channel": e.channel,
                "run": e.run,
                "role": e.role,
                "error [floors]": round(e.error, 3),
                "of measured": f"{e.share:.2%}",
                "gauge noise": e.gauge / e.floor,
                "noise fed in": e.fed / e.floor,
                "step halved": e.step / e.floor,
            }
            for e in found.system.errors
        ]
        words = (
            "The floor of a replay has three parts, shown as parts of it: noise of the gauge, noise of table motion "
            "and restarts gone through the rig, and the change when the step is halved."
        )
        pieces.append(details("Every channel of the replay in every run", [words, table(own)]))
    return pieces


def _places(found: Comparison) -> list[Any]:
    pieces: list[Any] = []
    if found.places:
        pieces.append(bullets([capital(p.words) + "." for p in found.places]))
    else:
        pieces.append(paragraph(place_words(found)))
    pieces.append(
        figure(
            error_maps.map_figure(found),
            f"Error by balance and state of motion, in floors. Bold: above the floor beyond doubt (more than "
            f"{AT_FLOOR:g} floors, corrected for the {len(found.cells)} cells looked at).",
            "Table of error over floor by balance and state of motion",
        )
    )
    for relation in error_maps.shown_relations(found):
        called = NAMES[relation][0]
        if any(p.relation == relation for p in found.patterns):
            pieces.append(
                figure(
                    error_maps.patterns_figure(found, relation),
                    f"{capital(called)}: mean residual (measured less predicted) over every state, both directions "
                    "of sliding apart, with two standard errors. Mirrored curves are friction, equal curves a constant "
                    "pull. Hollow: too few independent samples to say how sure the mean is.",
                    f"Mean residual of {called} over states of motion",
                )
            )
        pieces.append(
            figure(
                error_maps.plane_figure(found, relation),
                f"{capital(called)}: error over slip and velocity, all runs.",
                f"Map of the error of {called} over slip and velocity",
            )
        )
    worst = sorted((c for c in found.cells if c.above), key=lambda c: -c.error)[:24]
    if worst:
        pieces.append(details("The worst cells", [table([_cell_row(c) for c in worst])]))
    split = [
        {
            "balance": NAMES[p.relation][0],
            "turns with the direction [floors]": round(p.odd, 2),
            "does not turn [floors]": round(p.even, 2),
            "rms sliding to +x": round(p.plus, 2),
            "rms sliding to −x": round(p.minus, 2),
        }
        for p in found.parities.values()
    ]
    if split:
        pieces.append(details("Odd and even part in the direction of sliding", [table(split)]))
    return pieces


def _cell_row(cell: Cell) -> dict[str, Any]:
    label = cell.label
    if not label:
        unit, factor = UNITS[cell.kind]
        label = f"{factor * cell.low:.3g} to {factor * cell.high:.3g} {unit}"
    return {
        "balance": NAMES[cell.relation][0],
        "sorted by": cell.kind,
        "cell": label,
        "error [floors]": round(cell.error, 2),
        "samples": cell.samples,
        "independent": round(cell.effective),
        "by chance": "below 1e-9" if cell.chance < 1e-9 else f"{cell.chance:.1g}",
    }


def _histories(found: Comparison) -> list[Any]:
    run = found.base.objective.run(figures.shown_run(found))
    how = (
        "replayed from the measured table motion in windows that restart from measured states"
        if found.system
        else "the law fed with the measured load, slip and speed"
    )
    caption = f"Run {run.name} ({_role_words(run.role)}): measured, and {how}. The difference is drawn below."
    return [figure(figures.histories_figure(found), caption, f"Measured and modelled histories of run {run.name}")]


def _loops(found: Comparison) -> list[Any]:
    run = found.base.objective.run(figures.shown_run(found))
    of = "friction" if run.forces_measured else "force of all bearings"
    caption = (
        f"Run {run.name} ({_role_words(run.role)}): {of} over slip, measured and as the law has it at the measured "
        "load and speed; the widest loop stands out, the rest of the run is grey."
    )
    return [figure(figures.loops_figure(found), caption, f"Friction loops of run {run.name}")]


def _role_words(role: str) -> str:
    return {"holdout": "held out", "fit": "fitted", "repeat": "repeated, fitted"}[role]


def _audit(found: Comparison) -> list[Any]:
    pieces: list[Any] = [paragraph(found.checks.words)]
    if found.checks.rows:
        pieces.append(table(found.checks.rows))
    if found.checks.notes:
        pieces.append(details("Small things", [bullets(found.checks.notes)]))
    if found.checks.cannot:
        pieces.append(details("What could not be tested", [bullets(found.checks.cannot)]))
    return pieces


def _floor(found: Comparison) -> list[Any]:
    rows = []
    for row in found.rows("floor"):
        again = row["repeated_runs"]
        rows.append(
            {
                "balance": NAMES[row["relation"]][0],
                "noise": size(row["floor"], row["unit"]),
                "near reversals": size(row["near_reversals"], row["unit"]),
                "a repeated run shows": "" if again is None else f"{again:.2f} floors",
            }
        )
    words = (
        "The floor of a balance is what a perfect model would leave: noise of its gauges, and near reversals the "
        "noise of the velocity, which turns friction round a little early or late. A repeated run tests it: what "
        "differs between two runs of one motion is noise."
    )
    single = (
        "The noise of every gauge, one sample, and what has shown it. The floors of the balances are made of it: it is "
        "what divides every error of this report."
    )
    return [paragraph(words), table(rows), paragraph(single), table(gauge_rows(found.gauges))]


def _about(found: Comparison) -> list[Any]:
    pieces: list[Any] = []
    if found.notes:
        pieces.append(bullets(found.notes))
    if found.cannot:
        pieces.append(callout("Could not be done:", "; ".join(found.cannot) + ".", "warn"))
    uses = ", ".join(u.label for u in found.model.uses) or "Coulomb friction alone"
    pieces.append(paragraph(f"Model: {found.campaign.rig} with {uses}. Made in {found.seconds:.0f} s."))
    runs = [
        {
            "run": r.name,
            "role": r.role,
            "file": r.file,
            "samples": len(r.record),
            "step [ms]": round(1e3 * r.record.dt, 4),
        }
        for r in found.campaign.runs
    ]
    return [*pieces, table(runs)]


def _friction_clouds(found: Comparison) -> list[Html]:
    """Make the part of a page that shows the clouds."""
    known = friction(found)
    if not len(known.speed):
        return [paragraph("No pad has both its friction and its load at the samples by which the pads are judged.")]
    caption = (
        "Coefficient of friction of every pad in every run while it slides: measured, one point a sample, thinned, and "
        "what the fitted law says at the same samples, as medians of bins. Each colour holds a third of the samples, "
        "cut by the variable over which the other panel is drawn. Points beside their line: there the law fails."
    )
    with styled():
        drawn = clouds_figure(known)
    return [figure(drawn, caption, "Clouds of friction over load against slip speed and against pressure")]
