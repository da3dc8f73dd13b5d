"""Numbers as people write them: counts in a sentence, units in which a size is read, and when one counts as zero."""

_WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")

#: SI unit -> unit in which sizes of bearings are read.
_USUAL = {"m": "mm", "m/s": "mm/s", "N": "kN", "N/s": "kN/s", "N/m": "kN/mm", "Pa": "MPa"}

#: Less than this share of what there is beside it counts as zero and is left out [1].
NOTHING = 1e-3


def in_words(number: int) -> str:
    """Write a count in words up to twelve, in figures beyond."""
    return _WORDS[number] if 0 <= number < len(_WORDS) else str(number)


def counted(number: int, thing: str) -> str:
    """Write a count with its noun, "one run", "four runs"."""
    return f"{in_words(number)} {thing}" + ("" if number == 1 else "s")


def usual_unit(unit: str) -> str:
    """Return the unit in which a quantity of this SI unit is read: mm, kN, MPa; the same where there is no other."""
    return _USUAL.get(unit, unit)


def unit_of_size(unit: str, size: float) -> str:
    """Return the unit in which a quantity of this SI unit and size is read: ms below a second, N below a kilonewton."""
    if unit == "s":
        return "ms" if abs(size) < 1.0 else "s"
    return unit if unit == "N" and abs(size) < 1e3 else usual_unit(unit)
