"""How long each stage of long work takes, told by what its progress says is being done."""

import time
from collections.abc import Callable


class StageClock:
    """Takes the time between one word of progress and the next, and passes the word on.

    Args:
        progress: called with what is being done and the share done, if given.
    """

    def __init__(self, progress: Callable[[str, float], None] | None = None) -> None:
        self._progress = progress
        self._times: dict[str, float] = {}
        self._words, self._since = "", time.perf_counter()

    def tell(self, words: str, share: float) -> None:
        """Begin a stage, or go on with it, and pass it on."""
        self._close()
        self._words = words
        if self._progress is not None:
            self._progress(words, share)

    def stages(self) -> dict[str, float]:
        """Return stage -> time that it took so far [s], in the order in which they began."""
        self._close()
        return {words: seconds for words, seconds in self._times.items() if words and words != "done"}

    def _close(self) -> None:
        now = time.perf_counter()
        self._times[self._words] = self._times.get(self._words, 0.0) + now - self._since
        self._since = now
