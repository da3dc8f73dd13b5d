"""The page of a plan: what gauges and motions of a test would show, and what to add."""

from typing import Any

from slipwise.planning.result import PlannedTest
from slipwise.view.figures.plan_figures import chances_figure
from slipwise.view.pages.html import Section, bullets, callout, details, figure, page, paragraph, table, verdict
from slipwise.view.words.numbers import counted
from slipwise.view.words.plan_tables import (
    list_advice,
    list_classes,
    list_effect_rows,
    list_gauge_rows,
    list_kind_rows,
    list_matrix_rows,
    list_motion_rows,
    list_set_rows,
    name_sets,
)

_HOW = (
    "What can be seen and told apart is decided by the balances alone: by which quantities stand in which equation, "
    "and which of them a gauge measures. An effect can be seen where an equation that it breaks still checks something "
    "once every unknown has been eliminated; it is told from another where that holds without the equations that the "
    "other breaks.",
    "Laws of one port, such as those of pad friction, break the same equations: no gauge tells them apart, only their "
    "form in a motion does.",
    "Limit of materiality: the size at which an effect changes peak slip, energy, the largest load or a channel by "
    "2 %, or a gauge's fault its channel by 1 %, unless campaign.toml says otherwise; from replays of the last motion.",
    "Chances: the motions are replayed on the model, filtered, sampled and given noise; the model is fitted to that; "
    "then campaigns are drawn in which the effect is there at its limit, beside small imperfections of everything. "
    "Seen: an effect is said to be there, whether it matters or not. Named: this effect is said to matter. From: the "
    "size, in limits, from which it is large enough to be named; at one limit a verdict is half a matter of chance.",
    "An effect of which a fit leaves less than two thirds of the noise in every relation is never named, however long "
    "the test: that is why some are named from several limits only.",
    "Of other sets of gauges whole relations are left out, and nothing is fitted again. Yaw and gauges across count by "
    "the balances alone where they are not planned.",
)


def plan_page(found: PlannedTest) -> str:
    """Make the page of a plan: the text of one HTML file that needs nothing else."""
    sections = [
        Section("Gauges to add", _advice(found)),
        Section("Sets of gauges", _sets(found)),
        *([Section("Effects by gauges", _effects(found))] if any(one.chances for one in found.sets) else []),
        *([Section("Motions", _motions(found))] if found.motions else []),
        Section("What the planned gauges tell apart", _kinds(found)),
        Section("How this was found", [bullets(_HOW), *_about(found)]),
    ]
    return page(f"{found.rig}: plan of a test", sections, _summary(found))


def _summary(found: PlannedTest) -> list[Any]:
    told, seen, _ = found.planned.structure.score
    facts: dict[str, Any] = {"channels": len(found.planned.channels), "can be seen": seen, "told apart": told}
    asked = [c for c in found.planned.of_rig if c.possible]
    if asked:
        facts["named at the limit"] = f"{sum(c.named >= 0.5 for c in asked)} of {len(asked)}"
        facts["motions"] = len(found.motions)
    pieces: list[Any] = [verdict(f"{found.rig}: {counted(len(found.planned.channels), 'channel')}", found.sentence,
                                 "plain", facts)]  # fmt: skip
    pieces += [callout("Note", words) for words in found.notes]
    if found.planned.unsized:
        pieces.append(callout("No chances with the planned gauges", f"{found.planned.unsized}.", "warn"))
    if found.unused:
        words = f"No balance of {found.rig} uses {', '.join(found.unused)}: nothing is said of them."
        pieces.append(callout("Not used", words, "warn"))
    pieces += [callout("Not replayed", f"{name}: {why}", "warn") for name, why in found.failed.items()]
    if found.hardly:
        words = f"The specimen hardly slides in {', '.join(found.hardly)}: such motions say little of friction."
        pieces.append(callout("Hardly slides", words, "warn"))
    return pieces


def _advice(found: PlannedTest) -> list[Any]:
    advice = list_advice(found)
    return [bullets(advice)] if advice else [paragraph("The planned gauges show everything, and tell it apart.")]


def _sets(found: PlannedTest) -> list[Any]:
    words = "How many effects of the rig each set can show and tell from all else by the balances alone"
    words += ", and its mean chance to name one at its limit." if found.planned.chances else "."
    channels = [f"{letter}: {', '.join(one.channels)}" for letter, one in name_sets(found).items()]
    return [paragraph(words), table(list_set_rows(found)), details("Channels of each set", [bullets(channels)])]


def _effects(found: PlannedTest) -> list[Any]:
    if not list_matrix_rows(found):
        return [paragraph("No effect of the rig can reach its limit of materiality in these motions.")]
    caption = "Chance to name each effect at its limit of materiality, by set of gauges; -: the set cannot show it."
    pieces: list[Any] = [
        figure(chances_figure(found), caption, "Effects by sets of gauges", narrow=chances_figure(found, narrow=True))
    ]
    if not found.planned.chances:
        return pieces
    pieces.append(table(list_effect_rows(found.planned), caption="With the planned gauges"))
    pieces.append(details("Faults of the gauges", [table(list_gauge_rows(found.planned))]))
    small = [c.effect for c in found.planned.of_rig if not c.possible]
    if small:
        pieces.append(paragraph(f"Too small to matter in these motions, whatever their size: {', '.join(small)}."))
    return pieces


def _motions(found: PlannedTest) -> list[Any]:
    words = (
        "In the sequence that names most as early as possible: the first rows are the motions to make first. Alone: "
        "mean chance to name an effect by this motion. So far: by all up to it; a calm motion after a strong one can "
        "lower it, for what an effect leaves is judged against the noise of all samples."
    )
    return [paragraph(words), table(list_motion_rows(found))]


def _kinds(found: PlannedTest) -> list[Any]:
    pieces: list[Any] = [table(list_kind_rows(found.planned))]
    if classes := list_classes(found.planned):
        pieces += [paragraph("Effects that no gauge tells apart:"), bullets(classes)]
    if found.untestable:
        reasons = [f"{name}: {why}" for name, why in sorted(found.untestable.items())]
        pieces.append(details("Effects that this test cannot show", [bullets(reasons)]))
    return pieces


def _about(found: PlannedTest) -> list[Any]:
    return [paragraph(f"Made in {found.seconds:.0f} s.")]
