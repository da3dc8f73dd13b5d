"""Values of a specimen that a model does not use: whoever stated one is told."""

from collections.abc import Mapping

from slipwise.effects import Effect
from slipwise.errors import SettingError
from slipwise.rig import Specimen
from slipwise.rig.known import SPECIMEN_UNITS


def unused_values(built: Specimen, effects: Mapping[str, Effect]) -> dict[str, str]:
    """Return the values of a specimen that nothing uses, name -> why.

    Args:
        built: as the effects leave it.
        effects: of the model, by their labels.
    """
    why = {
        key.removeprefix("rig."): f"{label} stands in its place"
        for label, effect in effects.items()
        for key in effect.stands_for
        if key.startswith("rig.")
    }
    if built.bending_mass == 0.0:
        why |= dict.fromkeys(("bending_frequency", "bending_damping"), "no bending_mass is given")
    if not built.buffers:
        why |= dict.fromkeys((n for n in SPECIMEN_UNITS if n.startswith("buffer_")), "the rig has no buffers")
    return why


def refuse_stated(specimen: Specimen, unused: Mapping[str, str]) -> None:
    """Refuse a specimen with a value that a person stated and nothing uses.

    Args:
        specimen: as stated.
        unused: values that a model does not use, name -> why.

    Raises:
        SettingError: there is one; the message says what stands in its place.
    """
    for name in specimen.stated:
        if name in unused:
            of_law = "stands" in unused[name]
            other = ", or use Coulomb's law (--law coulomb, or a model.toml without it)" if of_law else ""
            raise SettingError(
                f"{specimen.sources.get(name, specimen.name)} states {name}, which this model does not use: "
                f"{unused[name]}. Leave {name} out{other}"
            )
