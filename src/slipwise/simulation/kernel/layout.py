"""Where every number of the law stands in one flat array, and what a model writes there.

Parameters, order of effects, memory and the last step's loads stand in `data.userdata`, so that many simulations with
different parameters share one model and one callback. Loops over records use the same array. What every law needs has
fixed places (see `places`); behind them stands what depends on the effects that there are.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.effects import Effect
from slipwise.errors import SettingError
from slipwise.model import EffectUse, Model
from slipwise.simulation.kernel import derived_states, places
from slipwise.simulation.kernel.places import CHAINS, MAX_BUFFERS, MAX_PADS

#: Lists of the effects that ask for derived states of pads, and of buffers.
OBSERVED: tuple[str, ...] = ("observe", "observe_buffer")


@dataclass(frozen=True)
class Layout:
    """Offsets into the flat array of what depends on the effects that there are.

    Attributes:
        effects: the effects that the kernel knows, whether a model uses them or not.
        at: offset of the list of effects of each hook of `CHAINS`, of those that ask for derived states ("observe",
            "observe_buffer"), of "pad_memory" and of "buffer_memory".
        parameters: effect name -> offset of its first parameter.
        pad_memory: effect name -> offset of its memory within one pad's block.
        buffer_memory: the same within one buffer's direction.
        derived: effect name -> offset of its derived states within that block.
        pad_block: size of one pad's memory.
        buffer_block: size of one buffer direction's memory.
        size: of the whole array.
    """

    effects: tuple[Effect, ...]
    at: dict[str, int]
    parameters: dict[str, int]
    pad_memory: dict[str, int]
    buffer_memory: dict[str, int]
    derived: dict[str, int]
    pad_block: int
    buffer_block: int
    size: int


def make_layout(effects: Sequence[Effect]) -> Layout:
    """Lay out the array for these effects."""
    instant = tuple(e for e in effects if e.instant_hooks)
    at: dict[str, int] = {}
    offset = places.END
    for chain in CHAINS:
        at[chain] = offset
        offset += sum(chain in e.hooks for e in instant)
    for observed in OBSERVED:
        at[observed] = offset
        offset += sum(observes(e) == observed for e in instant)
    parameters: dict[str, int] = {}
    for effect in instant:
        parameters[effect.name] = offset
        offset += len(effect.parameters)
    derived: dict[str, int] = {}
    pad_memory, pad_block = _memory([e for e in instant if e.port != "buffer"], derived)
    buffer_memory, buffer_block = _memory([e for e in instant if e.port == "buffer"], derived)
    at["pad_memory"] = offset
    offset += MAX_PADS * pad_block
    at["buffer_memory"] = offset
    offset += 2 * MAX_BUFFERS * buffer_block
    return Layout(instant, at, parameters, pad_memory, buffer_memory, derived, pad_block, buffer_block, offset)


def observes(effect: Effect) -> str:
    """Give which of `OBSERVED` an effect that asks for derived states belongs to; "" where it asks for none."""
    if not effect.derived:
        return ""
    return "observe_buffer" if effect.port == "buffer" else "observe"


def _memory(effects: Sequence[Effect], derived: dict[str, int]) -> tuple[dict[str, int], int]:
    """Give where each effect's memory stands in a block, and its size; fills where its derived states stand."""
    first: dict[str, int] = {}
    offset = 0
    for effect in effects:
        first[effect.name] = offset
        offset += len(effect.memory)
        if observes(effect):
            derived[effect.name] = offset
            offset += derived_states.SIZE
    return first, offset


def fill(layout: Layout, model: Model, dt: float) -> NDArray[np.float64]:
    """Write a model's law into a fresh array; memory at zero, what a simulation needs besides is left at zero.

    Args:
        layout: of a kernel that knows the model's effects.
        model: its effects and values.
        dt: step [s].

    Returns:
        (layout.size,) array.

    Raises:
        SettingError: the kernel does not know one of the model's effects.
    """
    array = np.zeros(layout.size)
    specimen = model.built_specimen()
    n_pads, n_buffers = len(specimen.pads), len(specimen.buffer_stiffness)
    array[places.DT] = dt
    array[places.N_PADS] = n_pads
    array[places.N_BUFFERS] = n_buffers
    array[places.APPARENT_AREA] = specimen.pad_area
    array[places.PLASTIC_PRESSURE] = specimen.plastic_pressure
    array[places.SHEAR_STRENGTH] = specimen.shear_strength
    array[places.FULL_STICK] = specimen.stick_capacity == "full"
    array[places.BUFFER_STIFFNESS : places.BUFFER_STIFFNESS + n_buffers] = specimen.buffer_stiffness
    sides = [
        s for place in specimen.pad_places for s in (1.0 if place[0] >= 0 else -1.0, 1.0 if place[1] >= 0 else -1.0)
    ]
    array[places.SIDE : places.SIDE + 2 * n_pads] = sides
    index = {effect.name: i for i, effect in enumerate(layout.effects)}
    for chain in CHAINS:
        uses = model.with_hook(chain)
        unknown = [u.label for u in uses if u.effect.name not in index]
        if unknown:
            raise SettingError(f"this kernel was not compiled for {', '.join(unknown)}")
        array[places.EFFECT_COUNT + CHAINS.index(chain)] = len(uses)
        array[layout.at[chain] : layout.at[chain] + len(uses)] = [index[u.effect.name] for u in uses]
    for place, observed in zip((places.N_OBSERVE, places.N_OBSERVE_BUFFER), OBSERVED, strict=True):
        watching = [index[u.effect.name] for u in model.uses if observes(u.effect) == observed]
        array[place] = len(watching)
        array[layout.at[observed] : layout.at[observed] + len(watching)] = watching
    set_values(layout, array, model)
    return array


def set_values(layout: Layout, array: NDArray[np.float64], model: Model) -> None:
    """Write the parameter values of a model's effects into an array in place.

    An effect on how a pad sticks, and a loading train, take the place of the rigid stick: at its neutral value such an
    effect must not be called at all.
    """
    for place, hook in ((places.N_STICK, "stick"), (places.N_TRAIN, "stretch")):
        array[place] = sum(hook in u.effect.hooks and not u.is_neutral for u in model.uses)
    for entry in model.uses:
        start = layout.parameters.get(entry.effect.name)
        if start is not None:
            names = entry.effect.parameter_names
            array[start : start + len(names)] = [entry.values[n] for n in names]


def pad_memories(layout: Layout, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View the pads' memory as (MAX_PADS, pad_block)."""
    start = layout.at["pad_memory"]
    return array[start : start + MAX_PADS * layout.pad_block].reshape(MAX_PADS, layout.pad_block)


def buffer_memories(layout: Layout, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View the buffers' memory as (MAX_BUFFERS, 2 directions, buffer_block)."""
    start = layout.at["buffer_memory"]
    block = array[start : start + 2 * MAX_BUFFERS * layout.buffer_block]
    return block.reshape(MAX_BUFFERS, 2, layout.buffer_block)


def apply_rest(layout: Layout, array: NDArray[np.float64], model: Model, seconds: float) -> None:
    """Let a pause between two runs act on what the pads and buffers remember, in place.

    Memory of an effect without a `rest` hook survives unchanged.
    """
    for entry in model.with_hook("rest"):
        name, size = entry.effect.name, len(entry.effect.memory)
        if name in layout.pad_memory:
            blocks, start = pad_memories(layout, array), layout.pad_memory[name]
        else:
            blocks, start = buffer_memories(layout, array).reshape(-1, layout.buffer_block), layout.buffer_memory[name]
        for block in blocks:
            entry.effect.hooks["rest"](block[start : start + size], seconds, **entry.values)
    for entry in (u for u in model.uses if observes(u.effect) == "observe" and "time_constant" in u.values):
        start = layout.derived[entry.effect.name]
        for block in pad_memories(layout, array):
            derived_states.cool(block[start : start + derived_states.SIZE], seconds, entry.values["time_constant"])


def begin_memory(
    layout: Layout, array: NDArray[np.float64], entries: Sequence[EffectUse], force: NDArray, bound: NDArray
) -> None:
    """Let what pads remember agree with the force (p, 2) [N] that each bears, of the bound (p,) [N], in place."""
    shares = force / np.maximum(bound, 1e-12)[:, None]
    shares /= np.maximum(np.hypot(*shares.T), 1.0)[:, None]
    for entry in entries:
        start, size = layout.pad_memory[entry.effect.name], len(entry.effect.memory)
        for block, share, most in zip(pad_memories(layout, array), shares, bound, strict=False):
            entry.effect.hooks["begin"](block[start : start + size], *share, most, **entry.values)
