"""Results of the last few sets of numbers: a difference quotient comes back to its base again and again."""

from collections.abc import Callable
from typing import Any, TypeVar

#: Results kept of each kind.
_KEPT = 4
Key = tuple[str | float, ...]
Made = TypeVar("Made")


class Recent:
    """What was made lately, by kind and by the numbers it depends on."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self._made: dict[str, dict[Key, Any]] = {}

    def get(self, kind: str, key: Key, make: Callable[[], Made]) -> Made:
        """Give what was made for this key before, or make it; the oldest of its kind is forgotten."""
        kept = self._made.setdefault(kind, {})
        if key in kept:
            kept[key] = kept.pop(key)
        else:
            if len(kept) >= _KEPT:
                del kept[next(iter(kept))]
            kept[key] = make()
        return kept[key]

    def forget(self) -> None:
        """Begin anew."""
        self._made.clear()
