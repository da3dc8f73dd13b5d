"""What every effect keeps, a function for each statement; the tests of the catalogue call the same functions."""

import fnmatch
import re
from collections.abc import Callable, Mapping

import numpy as np

from slipwise.effects import Effect, moved_channels
from slipwise.errors import SettingError
from slipwise.testing.driven import TARGET, answers, arrays, base_of, motion, record, with_effect
from slipwise.units import parse_unit

#: What an effect may change at component level, by the hooks it has.
REACH: dict[str, frozenset[str]] = {
    **dict.fromkeys(("area", "shear", "coefficient", "stick", "pad", "face", "stretch"), frozenset({"pads"})),
    **dict.fromkeys(("deflection", "spring"), frozenset({"buffers", "balance heave"})),
    "lift": frozenset({"lift"}), "drag": frozenset({"drag"}),
    "rig": frozenset({"specimen"}), "table": frozenset({"table"}), "balance": frozenset({"balance *"}),
    "gauge": frozenset({"channels *"}),
}  # fmt: skip
#: A test that tells two effects apart is no single word.
_SHORTEST_TEST = 10
#: Difference of the engines that rounding explains, of what they answer [1].
_ROUNDING = 1e-12
#: Samples at the ends of a record that no inverse gives back, and how near the others come to what was there [1].
_ENDS, _GIVEN_BACK = 60, 2e-4


class ContractError(SettingError):
    """An effect that can be read, and breaks the contract."""


def check_docstring(effect: Effect) -> None:
    """Ask for a first line, an indented equation, plain words, a range and a source.

    Raises:
        ContractError: with what is missing.
    """
    title, *rest = effect.text.splitlines()
    wanted = {
        "a first line that ends with a full stop, and an empty one below it": title.endswith(".")
        and not "".join(rest[:1]),
        "an equation, indented by four spaces": any(re.match(r"    \S.*=", line) for line in rest),
        "a sentence in plain words": any(line and not line.startswith((" ", "Valid:", "Source:")) for line in rest),
        "'Valid:' and 'Source:' with a sentence each": all(
            re.search(rf"^{head} .*\.", effect.text, re.M | re.S) for head in ("Valid:", "Source:")
        ),
        "a relation in `equation` of EFFECT, with = or ~": bool(re.search("[=~]", effect.equation)),
        "`signature` in EFFECT: how it shows": bool(effect.signature),
    }
    if missing := [words for words, there in wanted.items() if not there]:
        raise _broken(effect, f"it lacks {'; '.join(missing)}")


def check_parameters(effect: Effect) -> None:
    """Ask every parameter for a unit that can be read, finite bounds about its typical value, and a source.

    Raises:
        ContractError: with the parameter.
    """
    for p in effect.parameters:
        parse_unit(p.shown_in or p.unit, p.unit, p.name)
        if not (np.isfinite([p.low, p.high]).all() and p.low <= p.typical <= p.high and p.low < p.high):
            raise _broken(effect, f"{p.name}: give finite bounds with the typical value between them")
        if not re.search(r"assumed|[A-Z][a-z]+|paper|definition|\d", p.source):
            raise _broken(effect, f"{p.name}: say where its numbers come from, or 'assumed'")


def check_rivals(effect: Effect) -> None:
    """Ask for effects that look like this one, each with the test that tells them apart.

    Raises:
        ContractError: there is none, or one without a test.
    """
    if not effect.confused_with:
        raise _broken(effect, "`confused_with` is empty: every effect looks like something else somewhere")
    for rival, test in effect.confused_with.items():
        if rival == effect.name or len(test) <= _SHORTEST_TEST:
            raise _broken(effect, f"`confused_with` of {rival!r}: say which measurement tells the two apart")


def check_finite(effect: Effect) -> None:
    """Ask for finite answers over all bounds, and in states beyond anything measured.

    Raises:
        ContractError: with the values at which an answer is not finite.
    """
    for seed, values in enumerate(_tried(effect)):
        answer = arrays(answers(with_effect(effect, values), moving=_rough(seed, (0.0005, 0.002)[seed % 2])))
        for name, array in answer.items():
            if not np.isfinite(array).all():
                raise _broken(effect, f"{name} is not finite at {values}; mend the law, or narrow the bounds")


def check_engines(effect: Effect) -> None:
    """Ask the compiled engine to answer as the plain one does.

    Raises:
        ContractError: with what differs.
    """
    compiled, python = arrays(answers(with_effect(effect))), arrays(answers(with_effect(effect), "python"))
    for name, array in compiled.items():
        room = _ROUNDING * (np.abs(python[name]) + max(float(np.abs(array).max()), 1e-30))
        if (np.abs(array - python[name]) > room).any():
            raise _broken(
                effect, f"{name} differs between the compiled engine and Python; keep to `math` and arithmetic"
            )


def check_neutral(effect: Effect) -> None:
    """Ask that nothing changes at the neutral value, nor by the constants that alone switch nothing on.

    Raises:
        ContractError: with what changes.
    """
    if effect.replaces:
        return
    base = answers(base_of(effect))
    constants = {p.name: p.high for p in effect.parameters if p.neutral is None}
    for values in (effect.neutral(), effect.neutral() | constants):
        changed = _changed(base, answers(with_effect(effect, values)))
        if values != effect.neutral():  # a constant may stand in the specimen, where nothing asks for it
            changed -= {"specimen"}
        if changed:
            raise _broken(effect, f"at its neutral values, {values}, it changes {', '.join(sorted(changed))}")


def check_reach(effect: Effect) -> None:
    """Ask that it changes something at its typical size, and only what its hooks and `moves` say.

    Raises:
        ContractError: with what it changes.
    """
    typical = {p.name: 1.1 * p.typical for p in effect.parameters} if effect.replaces else effect.typical()
    base = answers(with_effect(effect) if effect.replaces else base_of(effect))
    changed = _changed(base, answers(with_effect(effect, typical)))
    allowed = frozenset[str]().union(*(REACH.get(hook, frozenset()) for hook in effect.hooks))
    allowed |= {"channels pad_*_F?"} if "pads" in allowed else set()  # forces of the pads are channels too
    if not changed:
        raise _broken(effect, "at its typical size it changes nothing")
    if far := {n for n in changed if not any(fnmatch.fnmatchcase(n, pattern) for pattern in allowed)}:
        raise _broken(effect, f"it changes {', '.join(sorted(far))}, which its hooks should not reach")
    channels = {name.removeprefix("channels ") for name in changed if name.startswith("channels ")}
    if effect.target and (len(channels) < len(changed) or not all(c.startswith(TARGET[:5]) for c in channels)):
        raise _broken(effect, f"told to sit on {TARGET}, it changes {', '.join(sorted(changed))}")
    if "*" not in effect.moves and (more := channels - moved_channels(effect)):
        raise _broken(effect, f"it changes {', '.join(sorted(more))}: add these to `moves`")


def check_undo(effect: Effect) -> None:
    """Ask that the hook `undo`, where there is one, takes back what `gauge` did.

    Raises:
        ContractError: with the channel that does not come back.
    """
    if "undo" not in effect.hooks:
        return
    pads = arrays(answers(base_of(effect)))["pads"][: motion()["time"].size * 8].reshape(-1, 4, 2)
    true = record(motion(), pads)
    target = TARGET if not moved_channels(effect, ("slip_x",)) else "slip_x"
    back = effect.hooks["undo"](effect.hooks["gauge"](true, target, **effect.typical()), target, **effect.typical())
    inside = slice(_ENDS, -_ENDS)
    for name, values in true.channels.items():
        if (
            np.abs(back[name] - values)[inside] > _GIVEN_BACK * np.abs(values).max() + 1e-7 * np.abs(values[inside])
        ).any():
            raise _broken(effect, f"undo does not give {name} back after gauge")


#: Every statement of the contract, the cheap ones first.
CHECKS: tuple[Callable[[Effect], None], ...] = (
    check_docstring, check_parameters, check_rivals, check_finite, check_engines,
    check_neutral, check_reach, check_undo,
)  # fmt: skip


def _broken(effect: Effect, words: str) -> ContractError:
    return ContractError(f"{effect.path.name}: {words}")


def _changed(base: Mapping[str, object], ours: Mapping[str, object]) -> set[str]:
    """Return the names of the answers that differ by a bit."""
    before, after = arrays(dict(base)), arrays(dict(ours))
    changed = {name for name, array in before.items() if not np.array_equal(array, after[name])}
    return changed | ({"specimen"} if ours["specimen"] != base["specimen"] else set())


def _tried(effect: Effect, count: int = 24) -> list[dict[str, float]]:
    """Return all corners of one parameter at a time and random points of the whole box."""
    rng = np.random.default_rng(sum(map(ord, effect.name)))
    found = [{**effect.typical(), p.name: bound} for p in effect.parameters for bound in (p.low, p.high)]
    found += [{p.name: p.low for p in effect.parameters}, {p.name: p.high for p in effect.parameters}]
    found += [{p.name: float(rng.uniform(p.low, p.high)) for p in effect.parameters} for _ in range(count)]
    return found


def _rough(seed: int, dt: float) -> dict[str, np.ndarray]:
    """Return states beyond anything measured: jumps, standstill, lifted pads, eight times the rated load."""
    rng = np.random.default_rng(seed)
    n = 120
    speed = rng.choice([0.0, 1e-12, 1e-6, 1e-3, 0.1, 3.0], n) * rng.choice([-1.0, 1.0], n)
    slip = np.cumsum(speed) * dt
    both = np.stack([slip, 0.3 * np.roll(slip, 3)], axis=1)
    rate = np.stack([speed, 0.3 * np.roll(speed, 3)], axis=1)
    return {
        "time": dt * np.arange(n, dtype=np.float64),
        "slip": np.repeat(both[:, None], 4, axis=1),
        "velocity": np.repeat(rate[:, None], 4, axis=1),
        "load": rng.choice([0.0, 1e-9, 1.0, 5e3, 24.5e3, 200e3], (n, 4)),
        "girder": rng.normal(0.0, 20.0, (n, 3)),
        "table": rng.normal(0.0, 20.0, (n, 3)),
    }
