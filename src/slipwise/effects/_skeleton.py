"""Effect files to begin one's own idea with: for every port a law that works, and words that say what to change."""

import textwrap
from dataclasses import replace

from slipwise.effects._hooks import DERIVED, HOOKS, LAGGING, PORTS
from slipwise.effects._python_text import WIDTH
from slipwise.effects._templates import FIRST_LAWS
from slipwise.effects._writer import WrittenEffect
from slipwise.errors import unknown_name

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
    return replace(law, name=name, hooks=(replace(first, lines=(*_guide(first.name, port), *first.lines)), *others))


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
    others = ", ".join(other for other in PORTS[port] if other != hook)
    for words in (_EFFECT, f"Other hooks of port {port!r}: {others}."):
        lines += textwrap.wrap(words, WIDTH - 8, break_on_hyphens=False)
    return [f"# {line}".rstrip() for line in lines]
