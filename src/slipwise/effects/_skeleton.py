"""Effect files to begin one's own idea with: for every port a law that works, and words that say what to change."""

from dataclasses import replace

from slipwise.effects._hooks import DERIVED, HOOKS, LAGGING, PORTS
from slipwise.effects._python_text import block
from slipwise.effects._templates import FIRST_LAWS
from slipwise.effects._writer import WrittenEffect
from slipwise.errors import unknown_name

_ABOUT = (
    "This file works as it is: begin with it and change it bit by bit. Say here what happens physically, and in which "
    "test it shows.",
)
_EFFECT = (
    "Every other argument is a number of the law: a Parameter of the same name in EFFECT below, with its SI unit, "
    "typical, lowest and highest value, the value at which it changes nothing (None for a constant that alone switches "
    "nothing), its source, 'symbol: meaning', and the unit in which people read it."
)


def skeleton(name: str, port: str = "shear") -> WrittenEffect:
    """Return an effect that works, for a port, with the words that lead on to one's own.

    Args:
        name: of the effect.
        port: where it acts.

    Raises:
        UnknownNameError: no such port.
    """
    if port not in PORTS:
        raise unknown_name("port", port, PORTS)
    law = FIRST_LAWS[port]
    first, *others = law.hooks
    guided = replace(first, lines=(*_guide(first.name, port), *first.lines))
    return WrittenEffect(
        name=name,
        title=law.title,
        equation=law.equation,
        about=_ABOUT,
        valid="say in which range of speed, load or size it holds.",
        source="assumed.",
        port=port,
        component=law.component,
        hooks=(guided, *others),
        parameters=law.parameters,
        signature=law.signature,
        confused_with={},
        memory=law.memory,
        moves=law.moves,
        target=law.target,
    )


def _guide(hook: str, port: str) -> list[str]:
    """Return the comment that says what a hook can ask for, and where numbers are declared."""
    can = HOOKS[hook].inputs
    lines = ["A hook asks for what it needs by the names of its arguments. This one can have:"]
    lines += [f"  {name:<24} {words}" for name, words in can.items() if name not in DERIVED]
    derived = {name: words for name, words in can.items() if name in DERIVED}
    if derived:
        lines += ["and states that are made from these:"]
        lines += [f"  {name + ('*' if name in LAGGING else ''):<24} {words}" for name, words in derived.items()]
    if derived.keys() & LAGGING:
        lines += [
            'For what has a * EFFECT needs a Parameter("time_constant", "s", ...) [s]; the hook need not ask for it.'
        ]
    if HOOKS[hook].memory:
        lines += [
            "  memory                   numbers that it remembers, memory[0] and so on: EFFECT names them, as in",
            "                           memory=('largest',); they begin at zero",
        ]
    lines += _comment(_EFFECT)
    lines += _comment(f"Other hooks of port {port!r}: {', '.join(h for h in PORTS[port] if h != hook)}.")
    return [f"# {line}".rstrip() for line in lines]


def _comment(words: str) -> list[str]:
    return block(words, " " * 8).replace(" " * 8, "").splitlines()
