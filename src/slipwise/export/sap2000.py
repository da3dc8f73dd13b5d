"""The verb: properties of SAP2000's links for the pads and buffers of a fitted rig."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.campaign import Campaign, as_campaign
from slipwise.display import Tabular
from slipwise.errors import SettingError
from slipwise.export.buffer_links import link_buffers
from slipwise.export.friction_fit import FrictionFit, fit_rate, fit_rate_and_pressure
from slipwise.export.friction_states import FrictionStates, states_of_campaign, states_of_replay
from slipwise.export.left_out import AVERAGED, GAUGE, LOST, PartOfModel, face_curvature, list_parts
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.motion import TableMotion
from slipwise.motion.load import as_motion
from slipwise.preparation.prepare import prepare
from slipwise.record import Record
from slipwise.rig.statics import at_rest
from slipwise.short_repr import short_repr
from slipwise.simulation.replay import replay

#: Elastic slip before a link slides, over the largest slip [1]: stiffer ones need smaller steps than the program takes.
_ELASTIC_SLIP = 1e-3
#: Quantiles of pressure between which a link is fitted, weighed by what an error of friction counts there [1].
_PRESSURES = (0.05, 0.5, 0.95)
SCHEMA = 1


@short_repr
@dataclass(frozen=True)
class SliderLink:
    """A friction isolator.

    Attributes:
        pad: its name.
        load: at rest [N].
        vertical_stiffness: in compression; it opens under tension [N/m].
        vertical_damping: [N s/m].
        stiffness: before it slides [N/m].
        slow: coefficient of friction at rest [1].
        fast: at high speed [1].
        rate: how soon speed brings it from slow to fast [s/m].
        radius: of the pendulum [m]; 0 for a flat plate.
        pressures: below which 5, 50 and 95 % of what was fitted lie [Pa].
        fast_at: coefficient at high speed at these pressures, which the link does not follow [1].
        error: root mean square of what the link leaves of the law's friction, over that of friction [1].
    """

    pad: str
    load: float
    vertical_stiffness: float
    vertical_damping: float
    stiffness: float
    slow: float
    fast: float
    rate: float
    radius: float
    pressures: tuple[float, float, float]
    fast_at: tuple[float, float, float]
    error: float


@dataclass(frozen=True)
class SpringLink:
    """A buffer along one axis.

    Attributes:
        buffer: its name.
        axis: "x" or "y".
        stiffness: of the straight line that comes nearest [N/m].
        damping: [N s/m].
        gap: way to both sides before it is touched [m].
        bends: whether its force is no straight line, or a loop.
    """

    buffer: str
    axis: str
    stiffness: float
    damping: float
    gap: float
    bends: bool


@dataclass(frozen=True, repr=False)
class LinkProperties(Tabular):
    """Links for SAP2000.

    Attributes:
        model: rig and effects, in words.
        fitted_over: what the friction was fitted over, in words.
        sliders: one for each pad.
        springs: two for each buffer; none where the states come from a campaign of one slider.
        parts: what became of each effect of the model.
    """

    model: str
    fitted_over: str
    sliders: tuple[SliderLink, ...]
    springs: tuple[SpringLink, ...]
    parts: tuple[PartOfModel, ...]

    @property
    def left_out(self) -> tuple[str, ...]:
        """What the links do not hold, in words."""
        words = [f"{p.effect}: {p.words}" for p in self.parts if p.state in (AVERAGED, LOST)]
        worst = max(self.sliders, key=lambda link: link.error)
        low, _, high = worst.fast_at
        words.append(
            f"pressure: a link has one pair of coefficients. Pad {worst.pad} has {low:.3g} at its lower pressures and "
            f"{high:.3g} at its higher ones at high speed; one pair errs by {100 * worst.error:.2g} % (rms)"
        )
        if bent := [link.buffer for link in self.springs if link.bends and link.axis == "x"]:
            words.append(
                f"buffers {', '.join(bent)}: force over deflection bends or loops; the stiffness is that of the "
                "straight line that comes nearest over this slip"
            )
        return tuple(words)

    def as_json(self) -> dict[str, Any]:
        """Return all numbers, SI."""
        return {
            "schema": SCHEMA,
            "model": self.model,
            "fitted_over": self.fitted_over,
            "sliders": [{**vars(link), "pressures": list(link.pressures), "fast_at": list(link.fast_at)}
                        for link in self.sliders],
            "springs": [vars(link) for link in self.springs],
            "left_out": list(self.left_out),
        }  # fmt: skip

    def _headline(self) -> str:
        return f"{self.model}: links fitted over {self.fitted_over}"

    def _rows(self) -> list[dict[str, Any]]:
        return [{"pad": s.pad, "slow": s.slow, "fast": s.fast, "rate": s.rate, "error": s.error} for s in self.sliders]


def export_sap2000(
    model: Model | Path | str,
    campaign: Campaign | Path | str | None = None,
    motion: TableMotion | str | Path | None = None,
    *,
    progress: Callable[[str, float], None] | None = None,
) -> LinkProperties:
    """Return properties of SAP2000's links, fitted over the pressures and speeds of a campaign or of a motion.

    Args:
        model: specimen and effects; or a model.toml; or a rig, with the paper's law.
        campaign: or its folder, whose pressures and speeds count.
        motion: of the table, whose replay's pressures and speeds count instead.
        progress: called with what is being done and the fraction done.

    Raises:
        SettingError: neither a campaign nor a motion, or both.
        InputError: a campaign without slip.
        SlipwiseError: a model, campaign or motion that cannot be read.
    """
    if (campaign is None) == (motion is None):
        raise SettingError(
            "friction depends on pressure and speed, and a link has one number for it: give either a campaign "
            "(--campaign FOLDER) or a motion (--motion), over whose pressures and speeds it is fitted"
        )
    tell = progress or (lambda words, done: None)
    model = as_model(model)
    parts = list_parts(model)
    physics = model.without(*(p.effect for p in parts if p.state == GAUGE))
    specimen = physics.built_specimen()
    if campaign is not None:
        tell("reading the campaign", 0.1)
        prepared = prepare(as_campaign(campaign)).campaign
        _check_rig(physics, prepared)
        states, words = states_of_campaign(physics, prepared), f"the runs of {prepared.name}"
        records = [run.record for run in prepared.runs if "slip_x" in run.record]
    else:
        assert motion is not None
        shaking = as_motion(motion)
        tell("replaying the model", 0.1)
        answer = replay(physics, shaking)
        states, words = states_of_replay(physics, answer), f"the replay of {shaking.title}"
        records = [answer.record]
    slips = [float(np.ptp(record["slip_x"])) / 2.0 for record in records]
    springs = _springs(physics, records[int(np.argmax(slips))])
    tell("fitting links", 0.7)
    sliders = _sliders(physics, states, max(slips) or 1e-3)
    tell("done", 1.0)
    return LinkProperties(
        f"{specimen.name} with {', '.join(u.label for u in physics.uses) or 'Coulomb friction'}",
        words,
        tuple(sliders),
        tuple(springs),
        tuple(parts),
    )


def _springs(model: Model, record: Record) -> list[SpringLink]:
    """Return both directions of every buffer, for the slip of a record."""
    found, buffers = [], model.built_specimen().buffers
    for buffer, links in zip(buffers, link_buffers(model, record), strict=True):
        for axis, link, rated in zip("xy", links, (buffer.stiffness_x, buffer.stiffness_y), strict=True):
            bends = not buffer.gap and (len(link.backbone) > 0 or link.loop_force > 0.0)
            stiffness = rated if buffer.gap else link.stiffness
            found.append(SpringLink(buffer.name, axis, stiffness, link.damping, buffer.gap, bends))
    return found


def _check_rig(model: Model, campaign: Campaign) -> None:
    """Refuse a campaign of another rig, or of other pads, than the model's."""
    if campaign.specimen.name != model.specimen.name:
        raise SettingError(
            f"the model is of {model.specimen.name}, the campaign of {campaign.specimen.name}; give the model that was "
            "fitted to it, for masses and buffers are of the one and pressures of the other"
        )
    if set(campaign.specimen.pads) != set(model.specimen.pads):
        raise SettingError(
            f"the model is of {model.specimen.name} with the pads {', '.join(model.specimen.pads)}, the campaign of "
            f"{campaign.specimen.name} with {', '.join(campaign.specimen.pads)}; give the model that was fitted to it"
        )


def _sliders(model: Model, states: Sequence[FrictionStates], largest: float) -> list[SliderLink]:
    specimen, found = model.built_specimen(), []
    loads: Mapping[str, float] = dict(zip(specimen.pads, _loads_at_rest(model), strict=True))
    for place in specimen.places:
        own = [s for s in states if s.pad == place.name]
        if not own:
            continue
        fit, by_pressure = fit_rate(own), fit_rate_and_pressure(own)
        pressures = _quantiles(own)
        curvature = face_curvature(place.curvature, model, place.name)
        found.append(
            SliderLink(
                pad=place.name,
                load=loads[place.name],
                vertical_stiffness=place.stiffness,
                vertical_damping=place.damping,
                stiffness=max(fit.slow, fit.fast) * loads[place.name] / (_ELASTIC_SLIP * largest),
                slow=fit.slow,
                fast=fit.fast,
                rate=fit.rate,
                radius=1.0 / curvature if curvature > 0.0 else 0.0,
                pressures=pressures,
                fast_at=_fast_at(by_pressure, pressures),
                error=fit.error,
            )
        )
    return found


def _loads_at_rest(model: Model) -> Sequence[float]:
    return [float(load) for load in at_rest(model.built_specimen()).load]


def _quantiles(states: Sequence[FrictionStates]) -> tuple[float, float, float]:
    pressure = np.concatenate([s.pressure for s in states])
    weight = np.concatenate([s.weight for s in states])
    order = np.argsort(pressure)
    summed = np.cumsum(weight[order])
    low, middle, high = (float(pressure[order][np.searchsorted(summed, q * summed[-1])]) for q in _PRESSURES)
    return low, middle, high


def _fast_at(fit: FrictionFit, pressures: tuple[float, float, float]) -> tuple[float, float, float]:
    low, middle, high = (fit.fast - fit.drop * math.tanh(fit.per_pressure * p) for p in pressures)
    return low, middle, high
