"""Verdicts of any tool on campaigns, read from one small JSON file for each, and scored against the answer keys.

    {"verdict": "named", "effects": ["run_in"], "minor": [], "leftover": "none", "probability": 0.9}

`verdict` is one of `VERDICTS`; only it is needed. `effects` is what the model lacks and what matters, `minor` what is
there and hardly matters, `leftover` "unknown" where something outside any catalogue is left, and `probability` that the
verdict and `effects` are right. Other keys are ignored, so diagnosis.json of `slipwise diagnose` is such a file.
"""

import json
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from slipwise_benchmarks.family_score import accused, missed, named, right
from slipwise_benchmarks.hidden import INSTRUMENTS, PHYSICS
from slipwise_benchmarks.hidden_rig import FRAME_EFFECTS
from slipwise_benchmarks.score import calibration

VERDICTS = ("complete", "named", "ambiguous", "instrument", "unknown", "failed")
#: What a verdict may name: what is hidden, what stands for it in single sliders, and what nobody hides.
NAMES = frozenset(
    {*PHYSICS, *INSTRUMENTS, *FRAME_EFFECTS, "restrainer", "machine_compliance", "backlash", "pad_compliance"}
    | {"table_gain", "table_cross_axis", "unknown"}
)
#: Parts into which probabilities are cut for the table of calibration.
FIFTHS = 5


class UnusableVerdict(ValueError):
    """A verdict's file, or its folder, that cannot be scored; the message says what to write."""


@dataclass(frozen=True)
class Scored:
    """One verdict beside its answer.

    Attributes:
        family: of the campaign.
        right: whether all that matters is named or listed, and nothing absent is named.
        absent: names that are not there, or far too small.
        missed: names that matter and were not given.
        listed_absent: names that were listed as minor and are not there at all.
        complete: whether nothing was named where nothing matters; None where something does.
        probability: that the tool gave [1]; None where it gave none.
    """

    family: str
    right: bool
    absent: tuple[str, ...]
    missed: tuple[str, ...]
    listed_absent: tuple[str, ...]
    complete: bool | None
    probability: float | None


def read_verdict(path: Path) -> dict[str, Any]:
    """Read one verdict.

    Raises:
        UnusableVerdict: no JSON object, a `verdict` or a name that is not known, a probability beyond 0 to 1.
    """
    try:
        said = json.loads(path.read_text(encoding="utf-8"))
    except UnicodeDecodeError as error:
        raise UnusableVerdict(f"{path}: no text in UTF-8; write JSON") from error
    except ValueError as error:
        raise UnusableVerdict(f"{path}: no JSON ({error}); write one object with the key verdict") from error
    if not isinstance(said, dict) or "verdict" not in said:
        raise UnusableVerdict(f'{path}: no object with the key verdict; write {{"verdict": ...}}')
    if said["verdict"] not in VERDICTS:
        raise UnusableVerdict(f"{path}: the verdict is {said['verdict']!r}; it can be {', '.join(VERDICTS)}")
    for key in ("effects", "minor"):
        names = said.get(key) or []
        if not isinstance(names, list):
            raise UnusableVerdict(f"{path}: {key} is {names!r}; write a list of names")
        for name in names:
            if name not in NAMES:
                near = get_close_matches(str(name), NAMES, 1)
                hint = f"did you mean {near[0]}" if near else "the README lists what can be named"
                raise UnusableVerdict(f"{path}: {key} has {name!r}, which is no name; {hint}")
    if said.get("leftover", "none") not in (None, "none", "unknown"):
        raise UnusableVerdict(f"{path}: leftover is {said['leftover']!r}; it can be none or unknown")
    chance = said.get("probability")
    if chance is not None and not (isinstance(chance, (int, float)) and 0.0 <= chance <= 1.0):
        raise UnusableVerdict(f"{path}: the probability is {chance!r}; write a number from 0 to 1, or null")
    return said


def score_verdict(answer: Mapping[str, Any], said: Mapping[str, Any]) -> Scored:
    """Hold one verdict against the answer key of its campaign."""
    chance = said.get("probability")
    return Scored(
        answer["family"],
        right(answer, said),
        tuple(sorted(accused(answer, said))),
        tuple(sorted(missed(answer, said))),
        tuple(sorted({*(said.get("minor") or [])} - answer["effects"].keys() - answer.get("details", {}).keys())),
        None if answer["missing"] else said["verdict"] == "complete" and not named(said),
        None if chance is None else float(chance),
    )


def score_folder(answers: Mapping[str, Mapping[str, Any]], verdicts: Path) -> dict[str, Scored]:
    """Score every verdict of a folder: campaign -> score.

    Args:
        answers: campaign -> answer key.
        verdicts: folder of NAME.json, or of NAME/diagnosis.json.

    Raises:
        UnusableVerdict: the folder has no verdict on any of these campaigns, or one cannot be read.
    """
    if not verdicts.is_dir():
        raise UnusableVerdict(f"there is no folder {verdicts}; write NAME.json for each campaign there")
    scored: dict[str, Scored] = {}
    for name, answer in answers.items():
        for path in (verdicts / f"{name}.json", verdicts / name / "diagnosis.json"):
            if path.is_file():
                scored[name] = score_verdict(answer, read_verdict(path))
                break
    if not scored:
        raise UnusableVerdict(f"{verdicts} has no verdict on {len(answers)} campaigns; write NAME.json for each there")
    return scored


def find_strays(answers: Mapping[str, Mapping[str, Any]], verdicts: Path) -> list[str]:
    """Return the names of files in a folder of verdicts that belong to no campaign."""
    return sorted(path.name for path in verdicts.glob("*.json") if path.stem not in answers)


def brier(scored: Iterable[Scored]) -> float | None:
    """Give the mean square of probability less outcome [1], 0 at best; None where no probability was given."""
    parts = [(one.probability - one.right) ** 2 for one in scored if one.probability is not None]
    return sum(parts) / len(parts) if parts else None


def table(scored: Sequence[Scored], campaigns: int) -> list[str]:
    """Give the lines that are printed: by family and for all, then probabilities by fifths."""
    groups: dict[str, list[Scored]] = defaultdict(list)
    for one in scored:
        groups[one.family].append(one)
    lines = [f"verdicts on {len(scored)} of {campaigns} campaigns", ""]
    heads = {"right": 9, "absent named": 13, "missed": 9, "listed absent": 14, "complete": 9, "Brier": 6}
    lines.append(" ".join([f"{'family':26s}", *(f"{name:>{width}s}" for name, width in heads.items())]))
    lines += [_line(family, here) for family, here in sorted(groups.items())]
    lines.append(_line("all", list(scored)))
    rated: list[dict[str, Any]] = [
        {"truth": {"right": one.right}, "said": {"probability": one.probability}}
        for one in scored
        if one.probability is not None
    ]
    rows = calibration(rated, FIFTHS, lambda truth, _: truth["right"])
    lines += ["", "probability     said  right  verdicts"] if rows else ["", "no probability was given"]
    lines += [
        f"{row['low']:.1f} to {row['high']:.1f}      {row['said']:.2f}   {row['right']:.2f}  {row['count']:8d}"
        for row in rows
    ]
    return lines


def _line(family: str, here: Sequence[Scored]) -> str:
    judged = [one.complete for one in here if one.complete is not None]
    square = brier(here)
    right = sum(one.right for one in here)
    absent, missing, listed = (
        sum(bool(names) for names in each)
        for each in zip(*((one.absent, one.missed, one.listed_absent) for one in here), strict=True)
    )
    return (
        f"{family:26s} {_of(right, len(here))}     {_of(absent, len(here))} {_of(missing, len(here))} "
        f"     {_of(listed, len(here))} "
        f"{_of(sum(judged), len(judged))} {'-' if square is None else f'{square:.3f}':>6s}"
    )


def _of(count: int, of: int) -> str:
    return f"{f'{count} of {of}' if of else '-':>9s}"
