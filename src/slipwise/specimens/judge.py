"""The verb: fit one law over several specimens, and say what all of them have and what one has alone."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.diagnosis.result import Diagnosis
from slipwise.errors import InputError
from slipwise.evidence.decision import EVEN_ODDS
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.specimens.random_effects import combine
from slipwise.specimens.result import OWN, SHARED, JointEffect, NumberOverSpecimens, SpecimensReport
from slipwise.specimens.shared_columns import SharedColumns, list_shared_columns
from slipwise.specimens.shared_law import SharedLaw, fit_shared_law, list_own_trifles
from slipwise.specimens.specimen import SpecimenStatistics, is_of_model, make_specimen

#: Units of base numbers that mean the same on any rig: those of friction over speed and pressure.
_OF_THE_FACES = ("1", "Pa", "1/Pa", "s/m", "m/s")
#: A size is known no better than to this share of a limit: below it is round-off [limits].
_EXACT = 1e-3
#: What shows less than this in a campaign may be an error that every campaign repeats [noise floors].
_FAINT = 0.3


@one_thread_algebra()
def judge_specimens(found: Sequence[Diagnosis | SpecimenStatistics]) -> SpecimensReport:
    """Fit one law over several specimens whose sizes differ from one to another, and say what all of them have.

    An effect that is too small to be named in each campaign, and is seen alike in all, is evidence here; one that is
    seen in one and contradicted by the others is told as a property of that specimen.

    Args:
        found: diagnoses of the campaigns, one of each specimen.

    Raises:
        InputError: fewer than two campaigns, two that are called alike, or none that share a law.
    """
    specimens = [one if isinstance(one, SpecimenStatistics) else make_specimen(one) for one in found]
    if len(specimens) < 2:
        given = f"only {specimens[0].name} was given" if specimens else "none was given"
        raise InputError(f"one law over several specimens needs two campaigns at least; {given}")
    twice = [name for name, count in Counter(s.name for s in specimens).items() if count > 1]
    if twice:
        raise InputError(f"two campaigns are called {twice[0]}; give each a name of its own in its campaign.toml")
    shared = list_shared_columns(specimens)
    if not shared.columns:
        rigs = ", ".join(dict.fromkeys(s.rig for s in specimens))
        raise InputError(
            f"these campaigns share no law whose sizes could be compared (rigs: {rigs}): an effect is compared where "
            "two of them can show it, and between rigs only where its strength is a pure number; give specimens of one "
            "kind"
        )
    law = fit_shared_law(specimens, shared)
    effects = [*_shared_effects(specimens, law), *_own_effects(specimens, law)]
    order = sorted(effects, key=lambda e: (e.of != SHARED, e.faint, -e.probability, -e.size))
    return SpecimensReport(
        tuple(s.name for s in specimens),
        tuple(s.rig for s in specimens),
        tuple(order),
        tuple(_base_numbers(specimens, law)),
        shared.not_compared,
    )


def _shared_effects(specimens: Sequence[SpecimenStatistics], law: SharedLaw) -> list[JointEffect]:
    out = []
    columns = law.shared.columns
    for effect in dict.fromkeys(c.effect for c in columns):
        at = [k for k, c in enumerate(columns) if c.effect == effect]
        there = np.any(law.sizes[:, at] != 0.0, axis=1)
        if np.mean(there) < EVEN_ODDS:
            continue
        form = Counter(columns[k].form for k in at for _ in range(int(np.sum(law.sizes[:, k] != 0.0))))
        best = [k for k in at if columns[k].form == form.most_common(1)[0][0]]
        size = float(np.mean(np.sqrt(np.sum(law.sizes[np.ix_(there, at)] ** 2, axis=1))))
        out.append(_effect(specimens, law, effect, "", float(np.mean(there)), size, best))
    return out


def _own_effects(specimens: Sequence[SpecimenStatistics], law: SharedLaw) -> list[JointEffect]:
    out = []
    first = len(law.shared.columns)
    groups: dict[tuple[int, str], list[int]] = {}
    for k, o in enumerate(law.own):
        groups.setdefault((o.specimen, specimens[o.specimen].columns[o.place].label), []).append(k)
    for (i, label), members in groups.items():
        sizes = law.sizes[:, [first + k for k in members]]
        there = np.any(sizes != 0.0, axis=1)
        if np.mean(there) < EVEN_ODDS:
            continue
        strongest = law.own[members[int(np.argmax(np.mean(sizes != 0.0, axis=0)))]].place
        size = float(np.mean(np.sqrt(np.sum(sizes[there] ** 2, axis=1))))
        best = _shared_like(law.shared, i, strongest)
        out.append(_effect(specimens, law, label, specimens[i].name, float(np.mean(there)), size, best, strongest))
    return out


def _shared_like(shared: SharedColumns, specimen: int, place: int) -> list[int]:
    """Return the shared columns of the form in which one column of a campaign has the largest part."""
    part = np.abs(shared.parts[specimen][place])
    if not part.size or part.max() == 0.0:
        return []
    form = shared.columns[int(part.argmax())]
    return [k for k, c in enumerate(shared.columns) if (c.label, c.form) == (form.label, form.form)]


def _effect(
    specimens: Sequence[SpecimenStatistics], law: SharedLaw, label: str, one: str, probability: float, size: float,
    best: Sequence[int], own: int = -1,
) -> JointEffect:  # fmt: skip
    """Make the entry of an effect that all specimens have, or one of them in one of its columns."""
    of = next(iter({c.effect for s in specimens for c in s.columns if c.label == label}))
    if one:
        shown = [s.columns[own].floors for s in specimens if s.name == one]
    else:
        parts = zip(specimens, law.shared.parts, strict=True)
        every = [max(float(np.abs(part[:, k]) @ [c.floors for c in s.columns]) for k in best) for s, part in parts]
        shown = [x for x in every if x > 0.0]
    floors = size * float(np.sqrt(np.mean(np.square(shown))))
    return JointEffect(
        effect=label,
        of=OWN if one else SHARED,
        specimen=one,
        probability=probability,
        size=size,
        floors=floors,
        faint=floors < _FAINT,
        alone={s.name: float(s.chance.get(label, 0.0)) for s in specimens},
        named=tuple(s.name for s in specimens if of in s.named),
        sizes=tuple(_sizes(specimens, law, best)),
    )


def _sizes(specimens: Sequence[SpecimenStatistics], law: SharedLaw, best: Sequence[int]) -> list[NumberOverSpecimens]:
    """Return the strengths of a shared form in every specimen that tells them, all else as the posterior has it."""
    if not best:
        return []
    values: list[dict[str, float]] = [{} for _ in best]
    errors: list[dict[str, float]] = [{} for _ in best]
    for i, s in enumerate(specimens):
        part = law.shared.parts[i][:, best]
        told = [k for k in range(len(best)) if np.any(part[:, k])]
        if not told:
            continue
        estimate, error = _estimate(s, law, i, part[:, told])
        for k, size, deviation in zip(told, estimate, error, strict=True):
            if deviation < 1.0 / _EXACT:
                values[k][s.name], errors[k][s.name] = float(size), float(deviation)
    out = []
    for k, mine, deviations in zip(best, values, errors, strict=True):
        column = law.shared.columns[k]
        for name, step in column.step.items():
            inside = {n: column.absent.get(name, 0.0) + x * step for n, x in mine.items()}
            off = {n: x * abs(step) for n, x in deviations.items()}
            over = combine(list(inside.values()), list(off.values())) if len(inside) > 1 else None
            key = f"{column.label}.{name}" if name else column.label
            out.append(NumberOverSpecimens(key, column.units.get(name, "1"), inside, off, over))
    return out


def _estimate(of: SpecimenStatistics, law: SharedLaw, place: int, part: Array) -> tuple[Array, Array]:
    """Return the sizes (m,) of a form in one campaign, and their standard errors [limits].

    The trifle that its own columns have beside is part of its size there, not of the error.
    """
    precision, pulled = law.precisions[place], law.pulls[place]
    within = np.any(part, axis=1)
    labels = {of.columns[k].label for k in np.flatnonzero(within)}
    rest = np.where([c.label in labels for c in of.columns], 0.0, law.sizes_of(place))  # one form at a time
    own = np.linalg.pinv(part.T @ precision @ part, hermitian=True)
    estimate = own @ (part.T @ (pulled - precision @ rest))
    inverse = np.linalg.pinv(part[within])
    variance = np.diag(own) - np.diag(inverse @ np.diag(list_own_trifles(of)[within] ** 2) @ inverse.T)
    return estimate, np.sqrt(np.maximum(variance, _EXACT**2))


def _base_numbers(specimens: Sequence[SpecimenStatistics], law: SharedLaw) -> list[NumberOverSpecimens]:
    """Return the base numbers that two specimens have, moved to where they lie beside the shared law."""
    alike = len({s.rig for s in specimens}) == 1
    values: dict[str, dict[str, float]] = {}
    errors: dict[str, dict[str, float]] = {}
    units: dict[str, str] = {}
    for i, s in enumerate(specimens):
        moved = _moved_numbers(s, law, i)
        for n, shift in zip(s.numbers, moved, strict=True):
            if not np.isfinite(n.error) or n.error <= 0.0 or not (alike or n.unit in _OF_THE_FACES):
                continue
            if not alike and n.key.startswith("rig."):
                continue
            units[n.key] = n.unit
            values.setdefault(n.key, {})[s.name] = n.value + shift * n.scale
            errors.setdefault(n.key, {})[s.name] = n.error
    return [
        NumberOverSpecimens(key, units[key], own, errors[key], combine(list(own.values()), list(errors[key].values())))
        for key, own in values.items()
        if len(own) > 1
    ]


def _moved_numbers(of: SpecimenStatistics, law: SharedLaw, place: int) -> Array:
    """Return by how much the base numbers (b,) move where the shared law stands in place of the campaign's own model.

    The effects of a campaign's own model that the shared law has too, with the sizes that it has there.
    """
    base = len(of.numbers)
    change = law.sizes_of(place) - np.array([c.fitted if is_of_model(c) else 0.0 for c in of.columns])
    regular = of.whole[:base, :base] + np.diag(of.ridge[:base])
    return np.asarray(-np.linalg.solve(regular, of.whole[:base, base:] @ change), float)
