"""What a diagnosis says beside its verdict, in sentences: whether runs confirm it, and what is there but small."""

from math import isfinite

from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.verdict import Verdict, leaves_much
from slipwise.noise.level import is_at_floor
from slipwise.view.words.limit_words import missed_words


def error_name(found: Diagnosis) -> str:
    """Say which error the numbers of a diagnosis are: where no run is held out, nothing may be called held-out."""
    return "held-out error" if found.held_out else "error of fitted runs"


def floors(error: float) -> str:
    """Write an error in noise floors; "unknown" where there is none."""
    return (f"{error:.2f}" if abs(error) < 100.0 else f"{error:.0f}") if isfinite(error) else "unknown"


def percent(share: float) -> str:
    """Write a share without digits that say nothing."""
    return f"{100.0 * share:.2g} %" if abs(share) < 0.0995 else f"{100.0 * share:.0f} %"


def confirmed_words(found: Diagnosis) -> str:
    """Say whether the held-out runs agree with what was found; "" where nothing was found that they could confirm."""
    if not weighed(found.verdict):
        return ""
    if not found.held_out:
        return "Not confirmed: no run outside the fit can be judged; what was found rests on the runs that were fitted."
    runs = " and ".join(run.name for run in found.final.campaign.with_role("holdout"))
    whole = _whole_words(found)
    if found.confirmed is None:
        return f"Not confirmed: the held-out runs ({runs}) cannot show what was found.{whole}"
    if found.confirmed:
        return f"Confirmed on runs that no fit has seen: {runs}.{whole}"
    if found.final_error < found.base_error and leaves_much(found.base_error, found.final_error):
        share = percent(found.final_error / found.base_error)
        left = f"{floors(found.final_error)} noise floors, {share} of the error"
        return f"Not confirmed: on {runs}, which no fit has seen, {left}, are left unexplained.{whole}"
    return f"It does not carry over to {runs}, which no fit has seen: the error there does not fall.{whole}"


def _whole_words(found: Diagnosis) -> str:
    """Say the error over all samples of runs of which a stretch was judged, as a further sentence; "" without any."""
    if not found.all_samples:
        return ""
    worst = max(found.all_samples, key=lambda r: found.all_samples[r][0])
    before, after = found.all_samples[worst]
    return f" Over all their samples, {NAMES[worst][0]} errs by {floors(before)} -> {floors(after)} floors."


def cannot_tell_words(found: Diagnosis) -> list[str]:
    """Say what a campaign could not test, a line for each reason: of one bearing twenty effects lack the same."""
    alike: dict[str, list[str]] = {}
    for line in found.cannot_tell:
        what, _, reason = line.partition(": ")
        alike.setdefault(reason, []).append(what)
    return [f"{', '.join(every)}: {reason}" for reason, every in alike.items()]


def four_answers(found: Diagnosis) -> list[tuple[str, str]]:
    """Return the four questions that everybody asks, with their answers in a sentence each."""
    good = [NAMES[r][0] for r, (base, _) in found.relations.items() if is_at_floor(base)]
    bad = {NAMES[r][0]: pair for r, pair in found.relations.items() if not is_at_floor(pair[0])}
    after = bool(found.added)
    missed = missed_words(found) if found.verdict.kind == "complete" else ""
    fails = ", ".join(f"{n} {floors(a)}" + (f" -> {floors(b)}" if after else "") for n, (a, b) in bad.items())
    agrees = ", ".join(good) + (" are" if len(good) > 1 else " is") + " at the noise floor." if good else "No balance."
    return [
        ("What agrees?", agrees),
        ("Where does it fail?", f"In noise floors: {fails}." if fails else "Nowhere: no balance is above its floor."),
        ("What is missing?", " ".join(filter(None, [found.sentence, missed]))),
        ("What next?", _next_words(found)),
    ]


def _next_words(found: Diagnosis) -> str:
    if found.discriminating_tests:
        return f"To tell them apart: {found.discriminating_tests[0]}"
    if found.law:
        return law_words(found)
    if found.verdict.is_doubtful and found.verdict.kind != "unknown":
        return "Another run before anything is built on it: `slipwise next CAMPAIGN` says which motion would tell most."
    match found.verdict.kind:
        case "instrument":
            return "See to the gauge, or correct it: `slipwise audit` says how."
        case "unknown":
            return "`slipwise discover` looks for its law."
        case "complete":
            return "Nothing: the model may be used as far as these motions go."
    return f"Put it into the model: `slipwise diagnose CAMPAIGN --accept`. Then: {found.left_over}."


def law_words(found: Diagnosis) -> str:
    """Say which law is proposed, and what that is named is not needed with it; "" without one."""
    if not found.law:
        return ""
    needless = found.needless_with_law
    less = f"With it, {', '.join(needless)} {'is' if len(needless) == 1 else 'are'} not needed." if needless else ""
    return " ".join(filter(None, [found.law["words"], less, "`slipwise discover` writes it as an effect."]))


def weighed(found: Verdict) -> tuple[str, ...]:
    """Return the named effects for which there is evidence of a fit: faults of samples have none, they are seen."""
    known = {f.name for f in found.findings}
    return tuple(name for name in found.effects if name in known)


def minor_words(found: Diagnosis) -> str:
    """Say what is there and does not matter; "" where there is nothing of the kind."""
    minor = found.verdict.minor
    if not minor:
        return ""
    part = "it is" if len(minor) == 1 else "they are"
    use = f"{part} in the fitted model" if found.added else "the model may do without"
    return (
        f"There, but most likely immaterial: {', '.join(minor)}; {use}. What is found by its size seems larger than it "
        "is: on the bench, changes of up to about twice the limit were more often below it than above."
    )


def limits_words(found: Diagnosis) -> str:
    """Say from which size on an effect matters to the user of this campaign."""
    limits = found.final.campaign.materiality
    return (
        f"An effect matters if the model without it changes a measured channel by more than {percent(limits.channel)} "
        "of that channel's rms about its mean, or the peak slip, the dissipated energy or the largest pad load by more "
        f"than {percent(limits.response)}; a gauge's fault if it changes its channel by more than "
        f"{percent(limits.gauge)}. `[materiality]` in campaign.toml sets other limits."
    )
