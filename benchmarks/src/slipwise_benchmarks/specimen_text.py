"""A rig as a specimen.toml says it: what a laboratory knows, without what the bench hides."""

import numpy as np

from slipwise_benchmarks.settings import Settings, buffers_of, pads_of


def specimen_toml(rig: Settings, digits: int = 4) -> str:
    """Write the rig as its laboratory would, rounded to so many digits; places and radii have one more."""

    def of(value: float, more: int = 0) -> str:
        return f"{value:.{digits + more}g}"

    inertia = ", ".join(f'"{of(value)} kg m^2"' for value in (rig.inertia_roll, rig.inertia_pitch, rig.inertia_yaw))
    lines = [
        f'mass = "{of(rig.mass)} kg"',
        f"inertia = [{inertia}]",
        f'centre_height = "{of(rig.height)} m"',
        f'centre_x = "{of(rig.centre_x)} m"',
        f'centre_y = "{of(rig.centre_y)} m"',
    ]
    for pad in pads_of(rig):
        curved = f', radius_of_curvature = "{of(1.0 / pad.curvature, 2)} m"' if pad.curvature else ""
        high = f', z = "{of(1e3 * pad.height)} mm"' if pad.height else ""
        lines.append(
            f'pads.{pad.name} = {{ x = "{of(pad.x, 1)} m", y = "{of(pad.y, 1)} m", '
            f'radius = "{of(1e3 * np.sqrt(pad.area / np.pi), 1)} mm", stiffness = "{of(pad.stiffness / 1e6)} kN/mm", '
            f'damping = "{of(pad.damping / 1e3)} kN s/m"{high}{curved} }}'
        )
    for b in buffers_of(rig):
        if b.stiffness_x > 0.0:
            lines.append(
                f'buffers.{b.name} = {{ x = "{of(b.x, 1)} m", y = "{of(b.y, 1)} m", z = "{of(b.z)} m", '
                f'stiffness_x = "{of(b.stiffness_x / 1e6)} kN/mm", stiffness_y = "{of(b.stiffness_y / 1e6)} kN/mm" }}'
            )
    for floor in rig.storeys:
        lines += [
            "",
            "[[storeys]]",
            f'mass = "{of(floor.mass)} kg"',
            f'z = "{of(floor.z)} m"',
            f'stiffness = "{of(floor.stiffness / 1e6)} kN/mm"',
            f'damping = "{of(floor.damping / 1e3)} kN s/m"',
        ]
    return "\n".join(lines) + "\n"
