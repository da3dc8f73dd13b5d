"""Families of campaigns, each with its own seeds, made by either maker: what a judge is trained on, and tested on.

A campaign is (family, maker, seed): `build_family(family, maker, seed)` makes it in memory with its answer key.
Families marked `held_out_family` take no part in any training, nor in any choice of rules: they are reported apart, and
tell how a judge does on dirt that it has never met.

No seed below 700 000 is used here: those have been looked at.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from slipwise_benchmarks import family_plans as plans
from slipwise_benchmarks.bearing import write_bearing
from slipwise_benchmarks.code_hash import code_hash
from slipwise_benchmarks.dirty import build_dirty, write_dirty
from slipwise_benchmarks.family_answer import Facts
from slipwise_benchmarks.family_dirt import NOISE, Soiled
from slipwise_benchmarks.rig_answer import answer_of_rig
from slipwise_benchmarks.slider_answer import answer_of_slider
from slipwise_benchmarks.sliders import build_slider

#: Who makes campaigns: the second simulator, or the library.
MAKERS: tuple[str, ...] = ("ode", "replay")
#: What makes campaigns of rigs, and of single sliders.
_OF_RIGS = ("slipwise_benchmarks.family_plans", "slipwise_benchmarks.dirty", "slipwise_benchmarks.rig_answer")
_OF_SLIDERS = ("slipwise_benchmarks.sliders", "slipwise_benchmarks.bearing", "slipwise_benchmarks.slider_answer")
#: What the library adds, loaded where it is asked for: the second simulator needs no library.
_RIGS_OF_LIBRARY = ("slipwise_benchmarks.library_replay",)
_SLIDERS_OF_LIBRARY = ("slipwise_benchmarks.slider_library",)
#: Seeds of a family.
COUNT = 1000


@dataclass(frozen=True)
class Family:
    """One family.

    Attributes:
        name: word of letters and underscores.
        seeds: its own, shared with no other.
        words: what it is.
        plan: of a rig, (seed, maker) -> plan and chain; None for single sliders.
        slider: a key of `slipwise_benchmarks.sliders.KINDS_OF_SLIDER`; "" for rigs.
        dirt: whether it is a family of dirt.
        held_out_family: whether it is left out of all training.
    """

    name: str
    seeds: range
    words: str
    plan: Callable[[int, str], Soiled] | None = None
    slider: str = ""
    dirt: bool = False
    held_out_family: bool = False

    def depends_on(self, maker: str) -> str:
        """Give a hash of the code that makes its campaigns: the bench's own, and the library's where it shakes."""
        modules = _OF_SLIDERS if self.plan is None else _OF_RIGS
        if maker == "ode":
            return code_hash(modules, ("slipwise_benchmarks",))
        library = _SLIDERS_OF_LIBRARY if self.plan is None else _RIGS_OF_LIBRARY
        return code_hash((*modules, *library), ("slipwise_benchmarks", "slipwise"))

    def campaign(self, maker: str, seed: int) -> str:
        """Give the name of a campaign's folder."""
        return f"{self.name}-{maker}-{seed}"


@dataclass(frozen=True)
class FamilyCampaign:
    """A campaign in memory.

    Attributes:
        answer: the answer key as plain data; see `slipwise_benchmarks.family_answer`.
        write: writes campaign.toml, the runs, and a specimen.toml where the rig has one, into a folder.
    """

    answer: dict[str, Any]
    write: Callable[[Path], None]


#: name -> words, and whether it is held out.
_DIRT: dict[str, tuple[str, bool]] = {
    "gains": ("every gauge is calibrated badly", False),
    "offsets": ("gauges have zeros that are off", False),
    "drifts": ("gauges walk away", False),
    "filters_and_delays": ("cards are slower or later than others", False),
    "coupled_gauges": ("friction cells feel load, accelerometers the other axis", False),
    "failed_channels": ("a channel is dead, clipped or late", False),
    NOISE: ("hum of 50 or 60 Hz and coloured noise", False),
    "second_logger": ("load cells are late and have a clock of their own", True),
    "uneven_seating": ("pads stand out of one plane", False),
    "temperature": ("friction differs from run to run", True),
    "wrong_mass": ("the mass that is said is wrong", False),
    "small_effects": ("a dozen small effects of the catalogue", False),
}


def _table() -> dict[str, Family]:
    """Give the families; a new one stands last, so that the seeds of others stay."""
    rigs: list[tuple[str, str, Callable[[int, str], Soiled], bool, bool]] = [
        ("clean", "effects of the catalogue, or nothing, in a clean laboratory", plans.clean, False, False),
        ("usual_dirt", "all imperfections that are usual, at once", plans.usual, True, False),
        *((name, words, partial(plans.soiled, name), True, out) for name, (words, out) in _DIRT.items()),
        ("unknown_laws", "a law that is in no catalogue", plans.unknown, False, False),
        ("drawn_rigs", "rigs of 1 to 100 t on three to eight pads, flat or curved", plans.drawn, False, False),
        ("storeys", "a frame of one to four floors on the girder", plans.storeys, False, False),
    ]
    sliders = {
        "sliders": ("slider", "single sliders under a load that is held"),
        "tribometers": ("tribometer", "pins under some newtons that go to and fro by millimetres"),
        "pendulums_constant_load": ("pendulum", "single pendulums under a load that is held"),
        "pendulums_varying_load": ("swung_pendulum", "single pendulums under a load that swings"),
        "springs_and_walls": ("spring_or_wall", "springs and walls without friction"),
    }
    found: dict[str, Family] = {}
    for name, words, plan, dirt, out in rigs:
        found[name] = Family(name, _seeds(len(found)), words, plan=plan, dirt=dirt, held_out_family=out)
    for name, (slider, words) in sliders.items():
        found[name] = Family(name, _seeds(len(found)), words, slider=slider)
    return found


def _seeds(place: int) -> range:
    first = 700_000 + COUNT * place
    return range(first, first + COUNT)


FAMILIES: dict[str, Family] = _table()


def build_family(family: Family, maker: str, seed: int) -> FamilyCampaign:
    """Make a campaign in memory.

    Args:
        family: one of `FAMILIES`.
        maker: one of `MAKERS`.
        seed: of everything random, one of the family's.
    """
    facts = Facts(family.campaign(maker, seed), family.name, maker, seed, family.held_out_family)
    if family.plan is None:
        slider = build_slider(family.slider, seed, maker)
        answer = answer_of_slider(facts, slider)
        return FamilyCampaign(answer, lambda folder: write_bearing(folder, slider.bearing, slider.roles, slider.tables))
    chosen = family.plan(seed, maker)
    made = build_dirty(seed, name=facts.name, plan=chosen.plan, logger=chosen.chain)
    return FamilyCampaign(answer_of_rig(facts, made), lambda folder: write_dirty(folder, made))
