"""An effect's file is held to the whole contract, and its author told of everything that breaks it."""

from pathlib import Path

from slipwise.effects import Effect, find_effect
from slipwise.testing.checks import CHECKS, ContractError


def check_effect(effect: Effect | Path | str) -> tuple[str, ...]:
    """Hold an effect to what every effect of the catalogue keeps; a test of one's own package calls it.

    It reads the file, and then lets the effect answer at component level over all its bounds, on Bridge 1: answers are
    finite, the compiled engine answers as the plain one, nothing changes at the neutral value,
    and at the typical size only what its hooks and `moves` say. It takes a few seconds.

        from slipwise.testing import check_effect

        def test_my_effect_keeps_the_contract():
            assert not check_effect("src/my_package/my_effect.py")

    Args:
        effect: the path of its file, the name of an installed one, or the effect itself.

    Returns:
        What to change although the effect works as it is, a sentence each; nothing where there is nothing to change.

    Raises:
        InputError: no such file, or Python cannot import it.
        UnknownNameError: no installed effect has this name, or the file names something that does not exist.
        SettingError: the file cannot be read as an effect.
        ContractError: it can be read and breaks the contract; every breach has a line.
    """
    found = effect if isinstance(effect, Effect) else find_effect(str(effect))
    broken: list[str] = []
    for check in CHECKS:
        try:
            check(found)
        except ContractError as error:
            broken.append(str(error))
    if broken:
        raise ContractError("\n".join(broken))
    return found.advice
