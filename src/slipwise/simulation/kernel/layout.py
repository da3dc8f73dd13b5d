"""Where every number of the law stands in one flat array, and what a model writes there.

Parameters, order of effects, memory and the last step's loads stand in `data.userdata`, so that many simulations with
different parameters share one model and one callback. Loops over records use the same array. What every law needs has
fixed places (see `places`); behind them stands what depends on the effects that there are.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.effects import PAD_HOOKS, Effect
from slipwise.errors import SettingError
from slipwise.model import EffectUse, Model
from slipwise.rig import Specimen
from slipwise.rig.load_basis import basis_of, buffer_sides
from slipwise.simulation.kernel import derived_states, places
from slipwise.simulation.kernel.places import CHAINS

#: Lists of the effects that ask for derived states of pads, and of buffers.
OBSERVED: tuple[str, ...] = ("observe", "observe_buffer")


@dataclass(frozen=True)
class Layout:
    """Offsets into the flat array of what depends on the effects that there are.

    Attributes:
        effects: the effects that the kernel knows, whether a model uses them or not.
        at: offset of the list of effects of each hook of `CHAINS`, and of those that ask for derived states ("observe",
            "observe_buffer").
        parameters: effect name -> offset of its first parameter; of an effect `of_each_pad`, within a pad's block.
        pad_memory: effect name -> offset of its memory within one pad's memory.
        buffer_memory: the same within one buffer's direction.
        derived: effect name -> offset of its derived states within that memory.
        first_pad: where the first pad's block begins.
        pad_block: size of one pad's block: its numbers, its memory, its parameters.
        pad_memory_size: of one pad's memory.
        buffer_block: size of one buffer's block: its numbers, its memory along x and along y.
        buffer_memory_size: of the memory of one buffer and direction.
    """

    effects: tuple[Effect, ...]
    at: dict[str, int]
    parameters: dict[str, int]
    pad_memory: dict[str, int]
    buffer_memory: dict[str, int]
    derived: dict[str, int]
    first_pad: int
    pad_block: int
    pad_memory_size: int
    buffer_block: int
    buffer_memory_size: int

    def size(self, specimen: Specimen) -> int:
        """Return how many numbers the array of a specimen has."""
        return self.responses(specimen) + math.prod(response_shape(specimen))

    def responses(self, specimen: Specimen) -> int:
        """Return where the responses of a specimen's rig to its pads' friction begin."""
        return self.buffers(len(specimen.pads)) + max(len(specimen.buffers), 1) * self.buffer_block

    def buffers(self, n_pads: int) -> int:
        """Return where the first buffer's block begins; there is always one, what the shear keys remember is in it."""
        return self.first_pad + n_pads * self.pad_block


def response_shape(specimen: Specimen) -> tuple[int, int]:
    """Return the rows of the pads' dry friction, and what answers to each: degrees of freedom, rows, accelerations.

    The table has four degrees of freedom and the girder six, a bending mode one, a storey two; three accelerations are
    read at the girder's middle, its two edges and each storey, and three of its turning.
    """
    if not specimen.free:
        return 0, 0
    rows, storeys = 2 * len(specimen.pads), len(specimen.storeys)
    dofs = 10 + (specimen.bending_mass > 0.0) + 2 * storeys
    return rows, dofs + rows + 3 * (4 + storeys)


def of_each_pad(effect: Effect) -> bool:
    """Return whether each pad has its own parameters of an effect."""
    return effect.instant_hooks.keys() <= PAD_HOOKS


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
    derived: dict[str, int] = {}
    pad_memory, pad_size = _memory([e for e in instant if e.port != "buffer"], derived)
    buffer_memory, buffer_size = _memory([e for e in instant if e.port == "buffer"], derived)
    parameters: dict[str, int] = {}
    pad_block = places.PAD_MEMORY + pad_size
    for effect in instant:
        count = len(effect.parameters)
        if of_each_pad(effect):
            parameters[effect.name], pad_block = pad_block, pad_block + count
        else:
            parameters[effect.name], offset = offset, offset + count
    return Layout(
        instant,
        at,
        parameters,
        pad_memory,
        buffer_memory,
        derived,
        first_pad=offset,
        pad_block=pad_block,
        pad_memory_size=pad_size,
        buffer_block=places.BUFFER_MEMORY + 2 * buffer_size,
        buffer_memory_size=buffer_size,
    )


def observes(effect: Effect) -> str:
    """Return which of `OBSERVED` an effect that asks for derived states belongs to; "" where it asks for none."""
    if not effect.derived:
        return ""
    return "observe_buffer" if effect.port == "buffer" else "observe"


def _memory(effects: Sequence[Effect], derived: dict[str, int]) -> tuple[dict[str, int], int]:
    """Return where each effect's memory stands in a block, and its size; fills where its derived states stand."""
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
        (layout.size(specimen),) array.

    Raises:
        SettingError: the kernel does not know one of the model's effects.
    """
    specimen = model.built_specimen()
    array = np.zeros(layout.size(specimen))
    array[places.DT] = dt
    array[places.N_PADS] = len(specimen.pads)
    array[places.N_BUFFERS] = len(specimen.buffers)
    array[places.BUFFERS] = layout.buffers(len(specimen.pads))
    array[places.PLASTIC_PRESSURE] = specimen.plastic_pressure
    array[places.SHEAR_STRENGTH] = specimen.shear_strength if specimen.slides else 0.0
    array[places.FULL_STICK] = specimen.stick_capacity == "full"
    pads, buffers = pad_blocks(layout, array), buffer_blocks(layout, array)
    pads[:, places.APPARENT_AREA] = specimen.pad_areas
    pads[:, places.PAD_STIFFNESS] = specimen.springs
    pads[:, places.PAD_DAMPING] = [place.damping for place in specimen.places]
    pads[:, places.CURVATURE] = [place.curvature for place in specimen.places]
    array[places.RISES_OVER_PADS] = specimen.pads_on == "table"
    pads[:, places.SIDE : places.SIDE + 2] = basis_of(specimen).sides
    for block, buffer, side in zip(buffers, specimen.buffers, buffer_sides(specimen), strict=False):
        block[places.BUFFER_STIFFNESS : places.BUFFER_STIFFNESS + 2] = buffer.stiffness_x, buffer.stiffness_y
        block[places.BUFFER_GAP], block[places.BUFFER_SIDE] = buffer.gap, side
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
    blocks, pads = pad_blocks(layout, array), model.specimen.pads
    bent = any("face" in u.effect.hooks and not u.is_neutral for u in model.uses)
    array[places.CURVED] = bent or bool(np.any(blocks[:, places.CURVATURE]))
    for entry in model.uses:
        start = layout.parameters.get(entry.effect.name)
        if start is None:
            continue
        names = entry.effect.parameter_names
        if of_each_pad(entry.effect):
            blocks[:, start : start + len(names)] = [[entry.of_pad(pad)[n] for n in names] for pad in pads]
        else:
            array[start : start + len(names)] = [entry.values[n] for n in names]


def pad_blocks(layout: Layout, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View the pads' blocks as (n_pads, pad_block)."""
    count = int(array[places.N_PADS])
    return array[layout.first_pad : layout.buffers(count)].reshape(count, layout.pad_block)


def buffer_blocks(layout: Layout, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View the buffers' blocks as (n_buffers or 1, buffer_block)."""
    first, count = layout.buffers(int(array[places.N_PADS])), max(int(array[places.N_BUFFERS]), 1)
    return array[first : first + count * layout.buffer_block].reshape(count, layout.buffer_block)


def pad_memories(layout: Layout, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View the pads' memory as (n_pads, pad_memory_size)."""
    return pad_blocks(layout, array)[:, places.PAD_MEMORY : places.PAD_MEMORY + layout.pad_memory_size]


def buffer_memories(layout: Layout, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View the buffers' memory as (n_buffers or 1, 2 directions, buffer_memory_size)."""
    memory = buffer_blocks(layout, array)[:, places.BUFFER_MEMORY :]
    return np.lib.stride_tricks.as_strided(
        memory,
        (len(memory), 2, layout.buffer_memory_size),
        (memory.strides[0], layout.buffer_memory_size * memory.strides[1], memory.strides[1]),
    )


def apply_rest(layout: Layout, array: NDArray[np.float64], model: Model, seconds: float) -> None:
    """Let a pause between two runs act on what the pads and buffers remember, in place.

    Memory of an effect without a `rest` hook survives unchanged.
    """
    pads = model.specimen.pads
    for entry in model.with_hook("rest"):
        name, size = entry.effect.name, len(entry.effect.memory)
        if name in layout.pad_memory:
            blocks, start = pad_memories(layout, array), layout.pad_memory[name]
            values = [entry.of_pad(pad) for pad in pads]
        else:
            memories, start = buffer_memories(layout, array), layout.buffer_memory[name]
            blocks = [direction for buffer in memories for direction in buffer]
            values = [entry.values] * len(blocks)
        for block, here in zip(blocks, values, strict=True):
            entry.effect.hooks["rest"](block[start : start + size], seconds, **here)
    for entry in (u for u in model.uses if observes(u.effect) == "observe" and "time_constant" in u.values):
        start = layout.derived[entry.effect.name]
        for block, pad in zip(pad_memories(layout, array), pads, strict=True):
            lag = entry.of_pad(pad)["time_constant"]
            derived_states.cool(block[start : start + derived_states.SIZE], seconds, lag)


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
