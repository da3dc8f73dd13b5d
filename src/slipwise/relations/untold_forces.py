"""What accelerations alone do not tell of the bearings' forces, in words."""

from slipwise.relations.setting import Measurements


def list_untold_forces(measurements: Measurements) -> list[tuple[str, str]]:
    """Return what cannot be told where the pads' friction or loads were not measured, each with the reason.

    Args:
        measurements: the runs, and the specimen with its rated masses.
    """
    specimen = measurements.specimen
    found: list[tuple[str, str]] = []
    if not specimen.free or measurements.forces_measured:
        return found
    if specimen.slides:
        reason = "no pad's friction was measured, and inertia tells only what all of them carry together"
        found.append(("friction of single pads", reason))
    elif len(specimen.buffers) > 1:
        found.append(("force of single buffers", "inertia tells only what all of them carry together"))
    if not measurements.loads_measured:
        mass = specimen.carried_mass / 1e3
        reason = f"they are known relative to the mass only, which is taken as rated, {mass:.4g} t with all storeys"
        found.append(("forces, stiffness and energy", reason))
    return found
