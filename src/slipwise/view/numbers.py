"""Small numbers: as people write them in a sentence, and when one counts as zero."""

_WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")

#: Less than this share of what there is beside it counts as zero and is left out [1].
NOTHING = 1e-3


def in_words(number: int) -> str:
    """Write a count in words up to twelve, in figures beyond."""
    return _WORDS[number] if 0 <= number < len(_WORDS) else str(number)


def counted(number: int, thing: str) -> str:
    """Write a count with its noun, "one run", "four runs"."""
    return f"{in_words(number)} {thing}" + ("" if number == 1 else "s")
