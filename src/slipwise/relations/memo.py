"""Results of the last few sets of numbers: a difference quotient comes back to its base again and again."""

from collections.abc import Callable
from typing import Any, TypeVar

#: Results kept of each kind; fewer of runs that have more samples than this together: each is as long as they are.
_KEPT, _KEPT_OF_LONG, LONG = 4, 2, 60_000
Key = tuple[str | float, ...]
Made = TypeVar("Made")


class Recent:
    """What was made lately, by kind and by the numbers it depends on."""

    def __init__(self, samples: int = 0) -> None:
        """Begin with nothing; results are as long as so many samples."""
        self._samples = samples
        self._most = _KEPT if samples <= LONG else _KEPT_OF_LONG
        self._made: dict[str, dict[Key, Any]] = {}

    def get(self, kind: str, key: Key, make: Callable[[], Made]) -> Made:
        """Return what was made for this key before, or make it; the oldest of its kind is forgotten."""
        kept = self._made.setdefault(kind, {})
        if key in kept:
            kept[key] = kept.pop(key)
        else:
            if len(kept) >= self._most:
                del kept[next(iter(kept))]
            kept[key] = make()
        return kept[key]

    def another(self) -> "Recent":
        """Return an empty one for results as long as these."""
        return Recent(self._samples)

    def begun_anew(self) -> "Recent":
        """Forget what was made here, and give an empty one for results as long as these."""
        self.forget()
        return self.another()

    def forget(self) -> None:
        """Begin anew."""
        self._made.clear()
