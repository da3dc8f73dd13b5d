"""The verb: write a fitted rig as an OpenSeesPy script, and say what that costs."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.display import Tabular
from slipwise.errors import SettingError, SimulationError
from slipwise.export.buffer_links import link_buffers
from slipwise.export.friction_fit import FrictionFit, fit_pads
from slipwise.export.friction_states import states_of_replay
from slipwise.export.left_out import AVERAGED, GAUGE, LOST, PartOfModel, face_curvature, list_parts
from slipwise.export.opensees_run import is_installed, run_script
from slipwise.export.opensees_script import ELASTIC_SLIP, OpenSeesModel, script_text
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.motion import TableMotion
from slipwise.motion.load import as_motion
from slipwise.record import write_text
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import DT, Replay

SCHEMA = 1
#: A friction model that errs by less is the law itself, but for rounding [1].
_EXACT = 1e-6


@dataclass(frozen=True)
class RunResponse:
    """One number of the run in both programs.

    Attributes:
        name: in words.
        unit: SI unit.
        ours: of our replay.
        theirs: of OpenSees; NaN where the script was not run.
        scale: that an error counts against: our number itself, of slip at the end the peak slip.
    """

    name: str
    unit: str
    ours: float
    theirs: float
    scale: float

    @property
    def error(self) -> float:
        """Their number less ours, over the scale [1]; NaN where there is none."""
        return (self.theirs - self.ours) / self.scale if self.scale else math.nan


@dataclass(frozen=True, repr=False)
class OpenSeesExport(Tabular):
    """What was written, and what it costs.

    Attributes:
        script: that runs alone.
        data: the table's motion, beside it.
        motion: its title.
        frictions: pad -> friction model.
        parts: what became of each effect of the model.
        remarks: where else the script differs from the model, in words.
        peak_slip: of our replay of the whole model along x [m].
        responses: of the run, in our replay and in OpenSees.
        difference: root mean square of slip x in OpenSees less ours, over that of ours [1]; NaN where it was not run.
        not_run: why the script was not run here; "" where it was.
    """

    script: Path
    data: Path
    motion: str
    frictions: Mapping[str, FrictionFit]
    parts: tuple[PartOfModel, ...]
    remarks: tuple[str, ...]
    peak_slip: float
    responses: tuple[RunResponse, ...]
    difference: float
    not_run: str

    def as_json(self) -> dict[str, Any]:
        """Return the contents of the JSON file beside the script."""
        return {
            "schema": SCHEMA,
            "script": self.script.name,
            "data": self.data.name,
            "motion": self.motion,
            "friction": {
                pad: {"model": f.kind, "slow": f.slow, "fast": f.fast, "rate": f.rate, "drop": f.drop,
                      "per_pressure": f.per_pressure, "error": f.error}
                for pad, f in self.frictions.items()
            },
            "effects": [
                {"effect": p.effect, "state": p.state, "words": p.words, "peak_slip_without": p.peak_slip}
                for p in self.parts
            ],
            "remarks": list(self.remarks),
            "responses": [
                {"name": r.name, "unit": r.unit, "replay": r.ours, "opensees": _known(r.theirs),
                 "error": _known(r.error)}
                for r in self.responses
            ],
            "slip_difference": _known(self.difference),
            "not_run": self.not_run,
        }  # fmt: skip

    @property
    def sentence(self) -> str:
        """What was written and how near it comes, in one sentence."""
        kinds = " and ".join(dict.fromkeys(f.kind for f in self.frictions.values()))
        if self.not_run:
            ours = f"peak slip x {1e3 * self.peak_slip:.4g} mm in our replay"
            return f"{self.script.name}: sliders with {kinds} friction; {ours}; the script was not run: {self.not_run}"
        first = self.responses[0]
        return (
            f"{self.script.name}: sliders with {kinds} friction; peak slip x {1e3 * first.theirs:.4g} mm in OpenSees, "
            f"{1e3 * first.ours:.4g} mm in our replay ({100 * first.error:+.2g} %)"
        )

    def _headline(self) -> str:
        return self.sentence

    def _rows(self) -> list[dict[str, Any]]:
        return [{"response": r.name, "unit": r.unit, "replay": r.ours, "opensees": r.theirs} for r in self.responses]


def export_opensees(
    model: Model | Path | str,
    motion: TableMotion | str | Path,
    out: Path | str,
    *,
    run: bool = True,
    progress: Callable[[str, float], None] | None = None,
) -> OpenSeesExport:
    """Write a fitted rig as an OpenSeesPy script, with the motion in a file beside it.

    Laws are not translated by name: sliders get the friction model that is nearest over the states of our replay,
    buffers the backbone, dashpot and loop that the model's laws show.

    Args:
        model: specimen and effects; or a model.toml; or a rig, with the paper's law.
        motion: of the table.
        out: the script; the motion is written beside it, with _motion.txt in place of .py.
        run: run the script too, where OpenSeesPy is installed.
        progress: called with what is being done and the fraction done.

    Raises:
        SettingError: the rig's slip is prescribed, or it has storeys.
        SimulationDiverged: the replay left every bound.
        SlipwiseError: a model or motion that cannot be read, or a file that cannot be written.
    """
    tell = progress or (lambda words, done: None)
    model, shaking, path = as_model(model), as_motion(motion), Path(out)
    if path.suffix != ".py":
        raise SettingError(f"--out {str(out)!r}: the script is Python; give a name that ends in .py")
    _check(model)
    parts = list_parts(model)
    physics = model.without(*(p.effect for p in parts if p.state == GAUGE))
    tell("replaying the model", 0.05)
    answer = replay(physics, shaking, output_dt=DT)
    tell("fitting friction and buffers", 0.3)
    written, remarks = _translated(physics, answer, shaking.title, path, parts)
    tell("what is left out", 0.4)
    parts = [_with_cost(part, physics, shaking) for part in parts]
    script, data = path, path.with_name(written.data)
    table = np.stack([answer.record[f"table_a{axis}"] for axis in "xyz"], axis=1)
    write_text(data, _motion_text(table, shaking.title))
    write_text(script, script_text(written))
    tell("running the script in OpenSees", 0.6)
    not_run = "" if run else "not asked for"
    history: Mapping[str, Array] = {}
    if run and not is_installed():
        not_run = "OpenSeesPy is not installed (pip install openseespy)"
    elif run:
        history, not_run = run_script(script)
    tell("done", 1.0)
    return OpenSeesExport(
        script=script,
        data=data,
        motion=shaking.title,
        frictions=written.frictions,
        parts=tuple(parts),
        remarks=tuple(remarks),
        peak_slip=max(abs(end) for end in answer.slip_range),
        responses=_responses(answer, physics, history),
        difference=_difference(answer, history),
        not_run=not_run,
    )


def _check(model: Model) -> None:
    specimen = model.built_specimen()
    if not specimen.free:
        raise SettingError(
            f"{specimen.name}: its slip is prescribed, so that there is nothing to shake; give a rig with a free girder"
        )
    if specimen.storeys:
        raise SettingError(
            f"{specimen.name}: it has storeys, which `slipwise export` does not write; give a rig without, or add the "
            "frame to the script of one"
        )


def _translated(
    model: Model, answer: Replay, title: str, path: Path, parts: list[PartOfModel]
) -> tuple[OpenSeesModel, list[str]]:
    """Return all that the script says, and what it does not."""
    specimen = model.built_specimen()
    frictions = fit_pads(states_of_replay(model, answer))
    largest = answer.largest_slip or 1e-3
    bound = max(answer.largest_friction.values())
    curvatures = {p.name: face_curvature(p.curvature, model, p.name) for p in specimen.places}
    buffers = link_buffers(model, answer.record)
    remarks = _errors(frictions, buffers, specimen.buffers)
    remarks += [
        f"a pad sticks on an elastic line: it slides after {1e6 * ELASTIC_SLIP * largest:.2g} um",
        "turning of the girder is small: arms of forces stay those of the undeformed rig",
    ]
    if any(c < 0.0 for c in curvatures.values()):
        remarks.append("pads on a crown are written as flat ones")
    if any(c > 0.0 for c in curvatures.values()):
        remarks.append("a pendulum is N x/R + mu N: the girder does not rise on the bowl, and its slope is small")
    if specimen.stick_capacity == "full":
        remarks.append("a pad that stands bears its friction at rest, not that at high speed (stick_capacity)")
    if answer.uplift > 0.0:
        remarks.append(f"pads lift off in this motion, for {answer.uplift:.2g} s: how they come down again may differ")
    table = [answer.record[f"table_a{axis}"] for axis in "xyz"]
    axes = "".join(axis for axis, values in zip("xyz", table, strict=True) if np.any(values)) or "x"
    written = OpenSeesModel(
        specimen=specimen,
        frictions=frictions,
        curvatures=curvatures,
        buffers=buffers,
        drag=_drag(model, answer),
        stick_stiffness=bound / (ELASTIC_SLIP * largest),
        elastic_slip=ELASTIC_SLIP * largest,
        dt=DT,
        axes=axes,
        data=f"{path.stem}_motion.txt",
        title=title,
        rig=f"{specimen.name} with {', '.join(u.label for u in model.uses) or 'Coulomb friction'}",
        remarks=[*(f"{p.effect}: {p.words} ({p.state})" for p in parts if p.state in (AVERAGED, LOST)), *remarks],
    )
    return written, remarks


def _errors(frictions: Mapping[str, FrictionFit], buffers: list[Any], named: Any) -> list[str]:
    """Say how far the nearest friction models and buffers are from the laws."""
    words = []
    worst = max(frictions.values(), key=lambda fit: fit.error)
    if worst.error > _EXACT:
        words.append(
            f"friction is {worst.kind}, which errs by {100 * worst.error:.2g} % (rms) of the law over this motion"
        )
    errors = {b.name: max(link.error for link in links) for b, links in zip(named, buffers, strict=True)}
    if errors and max(errors.values()) > 1e-3:
        name = max(errors, key=lambda one: errors[one])
        words.append(f"buffer {name} errs by {100 * errors[name]:.2g} % (rms) of its force over this motion")
    return words


def _drag(model: Model, answer: Replay) -> tuple[float, float]:
    """Return dashpots that do the same work in this motion as all drag on the girder [N s/m]."""
    record = answer.record
    velocity = np.stack([record["slip_vx"], record["slip_vy"]])
    found = np.zeros(2)
    for use in model.with_hook("drag"):
        hook = use.effect.hooks["drag"]
        names = hook.__code__.co_varnames[: hook.__code__.co_argcount]
        places = {
            "velocity_x": velocity[0],
            "velocity_y": velocity[1],
            "slip_x": record["slip_x"],
            "slip_y": record["slip_y"],
        }
        known = {n: places[n] if n in places else np.zeros(velocity.shape[1]) for n in names if n not in use.values}
        each = zip(*known.values(), strict=True)
        force = np.array([hook(**dict(zip(known, values, strict=True)), **use.values) for values in each]).T
        work = np.sum(velocity**2, axis=1)
        found += np.divide(np.sum(force * velocity, axis=1), work, out=np.zeros(2), where=work > 0.0)
    return float(found[0]), float(found[1])


def _with_cost(part: PartOfModel, model: Model, shaking: TableMotion) -> PartOfModel:
    """Return a part that is not wholly there with the peak slip of our replay without it."""
    if part.state not in (AVERAGED, LOST):
        return part
    try:
        without = replay(model.without(part.effect), shaking)
    except SimulationError:
        return replace(part, words=f"{part.words}; without it our replay diverges")
    return replace(part, peak_slip=max(abs(end) for end in without.slip_range))


def _motion_text(table: Array, title: str) -> str:
    lines = [f"# {line}" for line in title.splitlines()] + ["# acceleration of the table: x y z [m/s^2]"]
    lines += [" ".join(f"{value:.9g}" for value in row) for row in table]
    return "\n".join(lines) + "\n"


def _responses(answer: Replay, model: Model, history: Mapping[str, Array]) -> tuple[RunResponse, ...]:
    """Return what both runs say, by our channels' names [SI]."""
    specimen, ours = model.specimen, {name: answer.record[name] for name in answer.record.channels}

    def of(found: Mapping[str, Array], names: list[str], what: Callable[[Array], float]) -> float:
        return max(what(found[name]) for name in names) if all(n in found for n in names) and names else math.nan

    def largest(values: Array) -> float:
        return float(np.abs(values).max())

    def last(values: Array) -> float:
        return abs(float(values[-1]))

    loads = [f"pad_{pad}_N" for pad in specimen.pads]
    buffers = [f"buffer_{b.name}_Fx" for b in specimen.buffers]
    asked = [
        ("peak slip x", "m", ["slip_x"], largest),
        ("slip x at the end", "m", ["slip_x"], last),
        ("largest load of a pad", "N", loads, largest),
        *([("largest force of a buffer along x", "N", buffers, largest)] if buffers else []),
    ]
    found = []
    for name, unit, names, what in asked:
        own = of(ours, names, what)
        scale = largest(ours["slip_x"]) if what is last else own
        found.append(RunResponse(name, unit, own, of(history, names, what), scale))
    return tuple(found)


def _difference(answer: Replay, history: Mapping[str, Array]) -> float:
    if "slip_x" not in history:
        return math.nan
    theirs = np.interp(answer.record.time, history["time"], history["slip_x"])
    ours = answer.record["slip_x"]
    size = float(np.sqrt(np.mean(ours**2)))
    return float(np.sqrt(np.mean((theirs - ours) ** 2))) / size if size > 0.0 else math.nan


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
