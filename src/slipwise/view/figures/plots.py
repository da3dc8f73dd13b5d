"""One picture for every result: what its `.plot()` gives."""

from collections.abc import Callable, Mapping
from typing import Any

from matplotlib.figure import Figure

from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.panels import AFTER, error_bars
from slipwise.view.figures.style import AXIS_COLOURS, INK, MUTED, envelope, styled


def plot(result: object) -> Figure:
    """Draw a result of the library.

    Args:
        result: of one of the kinds of `_PICTURES`.
    """
    with styled():
        return _PICTURES[type(result).__name__](result)


def _record(record: Any) -> Figure:
    from slipwise.view.figures.pictures import histories_figure

    return histories_figure(record)


def _comparison(found: Any) -> Figure:
    from slipwise.view.figures.compare_figures import errors_figure

    return errors_figure(found)


def _bearing(found: Any) -> Figure:
    from slipwise.view.figures.bearing_figures import loops_figure

    return loops_figure(found)


def _consequence(found: Any) -> Figure:
    from slipwise.view.figures.consequence_figure import consequence_figure

    return consequence_figure(found)


def _diagnosis(found: Any) -> Figure:
    from slipwise.view.figures.diagnosis_figures import balances_figure

    return balances_figure(found)


def _ladder(found: Any) -> Figure:
    from slipwise.view.figures.diagnosis_figures import ladder_figure

    return ladder_figure(found)


def _plan(found: Any) -> Figure:
    from slipwise.view.figures.plan_figures import chances_figure

    return chances_figure(found)


def _discovery(found: Any) -> Figure:
    """Draw the first law, or else the state that explains most, or else the errors."""
    from slipwise.view.figures.discovery_errors import errors_figure
    from slipwise.view.figures.discovery_figures import candidate_figure, law_figure

    if found.laws:
        return law_figure(found.laws[0])
    return candidate_figure(found.organised) if found.organised else errors_figure(found)


def _effect(effect: Any) -> Figure:
    from slipwise.view.figures.effect_picture import effect_picture

    return effect_picture(effect)


def _motion(motion: Any) -> Figure:
    figure = new_figure(10.0, 5.0, motion.title)
    panels = figure.subplots(3, 1, sharex=True)
    for axes, (axis, colour), values in zip(panels, AXIS_COLOURS.items(), motion.acceleration.T, strict=True):
        axes.plot(*envelope(motion.time, values), color=colour)
        axes.set_ylabel(f"{axis} [m/s^2]")
        axes.margins(x=0.0)
    panels[-1].set_xlabel("time [s]")
    return figure


def _campaign(campaign: Any) -> Figure:
    figure = new_figure(10.0, 1.2 + 1.3 * len(campaign.runs), f"Slip in every run of {campaign.name}")
    panels = figure.subplots(len(campaign.runs), 1, squeeze=False)[:, 0]
    for axes, run in zip(panels, campaign.runs, strict=True):
        axes.set_title(f"{run.name} ({run.role})", fontweight="normal", fontsize=9.0)
        axes.set_ylabel("mm")
        axes.margins(x=0.0)
        if "slip_x" in run.record:
            axes.plot(*envelope(run.record.time, run.record["slip_x"] * 1e3), color=INK)
    panels[-1].set_xlabel("time [s]")
    return figure


def _audit(report: Any) -> Figure:
    held = {b.relation: (b.left, b.explained) for b in report.balances}
    return _floors("Balances of the gauges", held, ("as recorded", "after the findings"))


def _change(change: Any) -> Figure:
    held = {n: (b, change.after.get(n, b)) for n, b in change.before.items()}
    return _floors(change.words, held, ("before", "after"))


def _floors(title: str, errors: Mapping[str, tuple[float | None, float | None]], labels: tuple[str, str]) -> Figure:
    """Draw errors before and after, in multiples of the noise floor; what is not judged has none."""
    figure = new_figure(8.0, 3.4, title)
    axes = figure.subplots()
    judged = {name: (before, after) for name, (before, after) in errors.items() if before is not None}
    places = error_bars(axes, list(judged.values()), labels)
    axes.annotate("noise floor", (1.0, 1.0), xycoords=("axes fraction", "data"), ha="right", va="bottom", color=MUTED)
    axes.set_xticks(places, list(judged), rotation=30, ha="right")
    axes.set_ylabel("error / floor")
    axes.legend(handles=axes.containers)
    return figure


def _session(session: Any) -> Figure:
    before = {e.relation: e.error for e in session.errors(session.reference)}
    held = {e.name: (before.get(e.relation, e.error), e.error) for e in session.errors()}
    return _floors(f"{session.campaign.name}: {session.state.words}", held, ("before", "now"))


def _next_test(found: Any) -> Figure:
    shown = [p for p in found.proposals if not p.refused and not p.failed]
    figure = new_figure(9.0, 1.2 + 0.4 * max(len(shown), 1), "How well each motion would tell the rivals apart")
    axes = figure.subplots()
    axes.barh([p.motion for p in reversed(shown)], [p.separation for p in reversed(shown)], color=AFTER)
    axes.set_xlabel("separation [variances of the noise]")
    return figure


#: Kind of result -> what draws it. By name, so that a picture of a record loads no diagnosis.
_PICTURES: dict[str, Callable[[Any], Figure]] = {
    "AuditReport": _audit,
    "BearingReport": _bearing,
    "Campaign": _campaign,
    "Checks": lambda checks: _audit(checks.report),
    "Comparison": _comparison,
    "Consequence": _consequence,
    "Diagnosis": _diagnosis,
    "Discovery": _discovery,
    "Effect": _effect,
    "Ladder": _ladder,
    "ModelChange": _change,
    "NextTest": _next_test,
    "PlannedTest": _plan,
    "Record": _record,
    "Replay": lambda replay: _record(replay.record),
    "Session": _session,
    "TableMotion": _motion,
}
