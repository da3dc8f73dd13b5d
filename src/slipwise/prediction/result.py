"""What is said of another program's model: what it is, what it lacks, which of its numbers are off, what that costs."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from slipwise.diagnosis.result import Diagnosis
from slipwise.display import Tabular
from slipwise.noise.level import is_at_floor
from slipwise.prediction.friction_families import ReadLaw
from slipwise.short_repr import short_repr

#: Number of the format of predicted.json.
SCHEMA = 1
#: Rungs of the errors: with the numbers of the program, with fitted ones, with what is missing.
RUNGS = ("as it is", "its numbers corrected", "what it lacks added")
#: How people call the numbers of a rig.
_CALLED = {
    "rig.mass": "mass of the girder",
    "rig.centre_height": "height of the centre of gravity",
    "rig.buffer_stiffness": "stiffness of all buffers",
    "rig.pitch_frequency": "pitch frequency on the pads",
    "friction": "mean coefficient of friction",
}


@dataclass(frozen=True)
class ComparedNumber:
    """A number of the model beside what the campaign says.

    Attributes:
        key: "rig.mass", "key_clearance.clearance" ... or "friction".
        theirs: read back from the prediction [SI].
        measured: fitted to the campaign [SI].
        low: lower end of the 95 % interval of the latter; None where there is none.
        high: upper end.
        unit: SI unit.
        costs: mean squared residual that their value adds in the balance in which it adds most [noise variance].
        off: whether it is wrong, and matters.
    """

    key: str
    theirs: float
    measured: float
    low: float | None
    high: float | None
    unit: str
    costs: float
    off: bool

    @property
    def name(self) -> str:
        """How people call it: "mass of the girder", "clearance of key_clearance"."""
        effect, _, parameter = self.key.partition(".")
        return _CALLED.get(self.key, f"{parameter} of {effect}" if parameter else self.key)


@short_repr
@dataclass(frozen=True)
class ComparedRun:
    """A run as it was predicted beside the measurement.

    Attributes:
        run: its name.
        peak_slip: measured, then predicted [m].
        slip_error: rms of the difference of slip over the rms of the measured slip [1]; NaN without slip.
        force_error: the same of the friction of all pads [1]; NaN without it.
        load_change: rms of what the loads of the pads change by, over their mean: measured, then predicted [1].
    """

    run: str
    peak_slip: tuple[float, float]
    slip_error: float
    force_error: float
    load_change: tuple[float, float]


@dataclass(frozen=True, repr=False)
class PredictionReport(Tabular):
    """What a campaign says of the model that predicted it.

    Attributes:
        campaign: its name.
        law: the law of friction that was calculated with.
        effects: what else the model holds, by the names of the catalogue.
        loads: how its loads vary, and whether friction follows them, in a sentence.
        lacks: what it lacks -> why, in a sentence: effects of the catalogue, "speed dependence", "pressure dependence",
            "friction that follows the load", "loads that vary".
        surplus: effects that it holds and the campaign does not show.
        numbers: of the model beside those of the campaign.
        runs: as predicted and as measured.
        errors: rung of `RUNGS` -> relation -> error in floors.
        beyond: what stays beyond its reach, a sentence each.
        notes: of the reading.
        read: the diagnosis of the prediction by itself.
        found: the diagnosis of the measured campaign.
        seconds: it took.
    """

    campaign: str
    law: ReadLaw
    effects: tuple[str, ...]
    loads: str
    lacks: Mapping[str, str]
    surplus: tuple[str, ...]
    numbers: tuple[ComparedNumber, ...]
    runs: tuple[ComparedRun, ...]
    errors: Mapping[str, Mapping[str, float]]
    beyond: tuple[str, ...]
    notes: tuple[str, ...]
    read: Diagnosis
    found: Diagnosis
    seconds: float

    @property
    def off(self) -> tuple[str, ...]:
        """Numbers that are wrong and matter, the most costly first."""
        return tuple(n.key for n in sorted(self.numbers, key=lambda n: -n.costs) if n.off)

    @property
    def worst(self) -> dict[str, float]:
        """The error of each rung in the balance in which it is largest, in floors."""
        return {rung: max(errors.values()) for rung, errors in self.errors.items() if errors}

    @property
    def sentence(self) -> str:
        """What is wrong with the model, in a sentence."""
        if not self.lacks and not self.off:
            return "The model holds all that matters in this campaign, and its numbers are right."
        parts = []
        if self.lacks:
            parts.append(f"it lacks {' and '.join(self.lacks)}")
        if self.off:
            called = [f"the {n.name}" for n in self.numbers if n.off]
            parts.append(f"{' and '.join(called)} {'is' if len(called) == 1 else 'are'} off")
        words = ", and ".join(parts)
        before, numbers, completed = (f"{self.worst[rung]:.2g}" for rung in RUNGS)
        fall = f"its error of {before} noise floors becomes {numbers} with the best numbers that it can have"
        fall += f", and {completed} with what it lacks" if self.lacks else ""
        return f"{words[0].upper()}{words[1:]}; {fall}."

    def as_json(self) -> dict[str, Any]:
        """Return what predicted.json holds."""
        return {
            "schema": SCHEMA,
            "campaign": self.campaign,
            "words": self.sentence,
            "law": {
                "family": self.law.family.name,
                "words": self.law.family.words,
                "numbers": {
                    n: {"value": v, "unit": self.law.family.numbers[n][0]} for n, v in self.law.numbers.items()
                },
                "left": self.law.left,
            },
            "effects": list(self.effects),
            "loads": self.loads,
            "lacks": dict(self.lacks),
            "surplus": list(self.surplus),
            "off": list(self.off),
            "numbers": self._rows(),
            "runs": [
                {
                    "run": run.run,
                    "peak_slip": _pair(run.peak_slip),
                    "slip_error": _number(run.slip_error),
                    "force_error": _number(run.force_error),
                    "load_change": _pair(run.load_change),
                }
                for run in self.runs
            ],
            "errors": {rung: {k: _number(v) for k, v in errors.items()} for rung, errors in self.errors.items()},
            "beyond": list(self.beyond),
            "notes": list(self.notes),
            "read_back": self.read.sentence,
            "measured": self.found.sentence,
            "at_floor": bool(self.worst) and is_at_floor(list(self.worst.values())[-1]),
            "seconds": round(self.seconds, 1),
        }

    def _headline(self) -> str:
        return f"{self.campaign}: {self.sentence}"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {
                "number": n.key,
                "model": _number(n.theirs),
                "campaign": _number(n.measured),
                "low": None if n.low is None else _number(n.low),
                "high": None if n.high is None else _number(n.high),
                "unit": n.unit,
                "costs": _number(n.costs),
                "off": n.off,
            }
            for n in self.numbers
        ]


def _pair(values: tuple[float, float]) -> dict[str, float | None]:
    return {"measured": _number(values[0]), "predicted": _number(values[1])}


def _number(value: float) -> float | None:
    return float(f"{value:.5g}") if value == value and abs(value) != float("inf") else None
