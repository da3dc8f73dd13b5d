"""What `discover` answers: laws and what they explain, as an object, as JSON and in no more words than that bears."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path
from typing import Any

from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.curve_shape import CurveShape, describe_curve
from slipwise.discovery.effect_file import can_be_written, write_law
from slipwise.discovery.law import Law, Origin
from slipwise.discovery.law_test import LawTest
from slipwise.display import Drawn, Tabular
from slipwise.estimation.base_fit import BaseFit
from slipwise.preparation.data_corrections import DataCorrection
from slipwise.residual_map.states import UNITS

#: A law's form in a sentence.
_HOW = {
    "adds to mu": "adds to the coefficient of friction",
    "multiplies mu": "scales friction as a whole",
    "adds to friction": "adds to friction whatever the load",
    "even force on pads": "pushes each pad by a share of its load, whichever way it slides",
    "girder": "holds the girder back, and no pad carries it",
    "girder by place": "pushes the girder whichever way it moves, and no pad carries it",
    "load": "lifts the girder off its pads",
    "multiplies buffers": "scales the buffers' force",
}


@dataclass(frozen=True, repr=False)
class Discovery(Drawn, Tabular):
    """The answer.

    Attributes:
        campaign: its name.
        evidence: what may be said: "law", "state", "organised", "unknown" or "nothing".
        laws: in the order in which they were found; empty where nothing may be called one.
        organised: what explains most, whether or not it may be called a law; None where nothing does.
        looked_at: what explains most in the first screen, one of each state and port, best first.
        share: of the error above noise that all laws, or that, explain [1].
        relations: relation -> held-out error in floors before and after; of the fitted runs where none is held out.
        worst: relation that the laws act on.
        cannot_judge: states that could not be judged, and why.
        base: the fit from which the search began, with its slopes.
        files: of the effects that were written.
        seconds: it took.
        beside: effects that the diagnosis had added to the user's model before the search for a law began.
        corrections: what was done about the data before any fit.
        campaigns: how its first law does in every campaign whose data it was given; empty where it was one.
    """

    campaign: str
    evidence: str
    laws: tuple[Law, ...]
    organised: CurveCandidate | None
    looked_at: tuple[CurveCandidate, ...]
    share: float
    relations: Mapping[str, tuple[float, float]]
    worst: str
    cannot_judge: tuple[str, ...]
    base: BaseFit
    files: tuple[Path, ...]
    seconds: float
    beside: tuple[str, ...] = ()
    corrections: tuple[DataCorrection, ...] = ()
    campaigns: tuple[LawTest, ...] = ()

    @property
    def sentence(self) -> str:
        """The answer in words."""
        return _sentence(self)

    @property
    def explains_something(self) -> bool:
        """Whether it explains a whole per cent of what the model leaves."""
        return self.share >= 0.005

    @property
    def shape(self) -> CurveShape | None:
        """What explains most, described without a form; None where nothing does, or over two states."""
        if self.laws:
            return self.laws[0].shape
        return None if self.organised is None else describe_curve(self.organised.curve, self.organised.states[0])

    @property
    def origin(self) -> Origin:
        """Where its laws come from."""
        before, after = self.relations.get(self.worst, (float("nan"),) * 2)
        return Origin(self.campaign, self.beside, self.worst, before, after)

    def written(self, folder: Path, name: str, date: str) -> "Discovery":
        """Write the effect files of its laws, over those of an earlier one; where no law is claimed, none.

        Args:
            folder: is made where it is not there.
            name: of the first law's effect; further ones get a number.
            date: of the discovery, as text.

        Returns:
            The discovery with the files.

        Raises:
            SettingError: the name cannot be that of an effect.
        """
        if self.evidence not in ("law", "state"):
            return self
        files = []
        for number, law in enumerate((law for law in self.laws if can_be_written(law)), start=1):
            own = name if number == 1 else f"{name}_{number}"
            files.append(write_law(law, self.origin, folder, own, date, replace=True))
        return replace(self, files=tuple(files))

    @property
    def proposal(self) -> dict[str, Any] | None:
        """The first law in short, for a diagnosis whose verdict is unknown; None where no law and no state is told."""
        if self.evidence not in ("law", "state"):
            return None
        law = self.laws[0]
        return {
            "state": list(law.states),
            "port": law.acts_on,
            "form": law.form,
            "file": str(self.files[0]) if self.files else None,
            "share": self.share,
            "beside": list(self.beside),
            "words": self.sentence,
        }

    def as_json(self) -> dict[str, Any]:
        """Return the answer for a program to read."""
        before, after = self.origin.before, self.origin.after
        return {
            "schema": 1,
            "campaign": self.campaign,
            "evidence": self.evidence,
            "words": self.sentence,
            "laws": [
                {
                    "name": law.name,
                    "states": list(law.states),
                    "port": law.acts_on,
                    "enters": law.port,
                    "where": law.where,
                    "parity": law.parity,
                    "form": law.form,
                    "equation": law.equation,
                    "tied": list(law.tied),
                    "rivals": list(law.rivals),
                    "constants": {
                        c.name: {"value": c.value, "low": _known(c.low), "high": _known(c.high), "unit": c.unit}
                        for c in law.constants
                        if not c.bound
                    },
                    "undetermined": law.undetermined,
                    "shape": None if law.shape is None else law.shape.as_json(),
                    "curve": law.band(),
                    "alike": dict(law.alike),
                    "share": law.share,
                    "valid": {state: list(ends) for state, ends in law.valid.items()},
                }
                for law in self.laws
            ],
            "beside": list(self.beside),
            "campaigns": [test.as_json() for test in self.campaigns],
            "corrections": [one.as_json() for one in self.corrections],
            "organised": None if self.organised is None else self.organised.label,
            "shape": None if self.shape is None else self.shape.as_json(),
            "share": self.share,
            "held_out": {"before": _known(before), "after": _known(after)},
            "relations": {name: [_known(error) for error in errors] for name, errors in self.relations.items()},
            "cannot_judge": list(self.cannot_judge),
            "file": str(self.files[0]) if self.files else None,
            "files": [str(path) for path in self.files],
            "seconds": self.seconds,
        }

    def _headline(self) -> str:
        return f"{self.campaign}: {self.sentence}"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"law": law.name, "form": law.form, "constant": c.name, "value": c.value, "low": c.low, "high": c.high,
             "unit": c.unit}
            for law in self.laws
            for c in law.constants
        ]  # fmt: skip


def _known(value: float) -> float | None:
    """Return a number for JSON, which has none that is not known."""
    return value if isfinite(value) else None


def _sentence(found: Discovery) -> str:
    """Say what was found, how sure that is, and within which range of the data."""
    before, after = found.relations.get(found.worst, (0.0, 0.0))
    errors = f"error of {found.worst} {before:.2f} to {after:.2f} floors on what no fit has seen"
    if found.evidence == "nothing":
        return "Nothing is left that a law could explain: what the model leaves is at its noise."
    if found.evidence == "unknown" or not found.laws:
        return f"Unknown: {_not_confirmed(found)}. No law is claimed."
    told = "; and ".join(_told(law) for law in found.laws)
    if found.evidence == "organised":
        share = f"{100 * found.share:.0f} %"
        return f"Organised by {told}: {share} explained, the driver was not found. No law is claimed; {errors}."
    start = "A law" if found.evidence == "law" else "The state is known, the form open"
    beside = f" Found beside {', '.join(found.beside)}." if found.beside else ""
    return f"{start}: {told}; {errors}. {_range(found)}{beside} No mechanism is claimed."


def _not_confirmed(found: Discovery) -> str:
    best = found.organised
    if best is None:
        return "no state and form explain half of what the model leaves"
    if not found.explains_something:
        return (
            "no state and form explain half of what the model leaves; with the likeliest state and place, "
            f"{best.label}, each motion asks for another curve than the others"
        )
    share = f"{100 * found.share:.0f} %"
    if found.share < 0.5:
        return f"no state and form explain half of what the model leaves; most, {share}, goes with {best.label}"
    left = f"what the model leaves in {best.port.relation}"
    return f"{share} of {left} goes with {best.label}, but no fit of the whole model with such a law confirms it"


def _told(law: Law) -> str:
    where = "" if law.where == "all" else f" ({law.where})"
    forms = f"{law.form}" + (f"; {', '.join(law.tied)} cannot be told apart from it" if law.tied else "")
    return f"what depends on {law.driver}{where} {_HOW[law.port]}, {law.equation} [{forms}]"


def _range(found: Discovery) -> str:
    ends = {s: e for law in found.laws for s, e in law.valid.items()}
    return "Known for " + ", ".join(f"{s} {a:.3g} to {b:.3g} {UNITS.get(s, 'm')}" for s, (a, b) in ends.items()) + "."
