"""Table 1 and Fig. 3: the two bridges, the scales between them and their models, and what does not scale."""

from typing import Any

import numpy as np

from slipwise.model import Model
from slipwise.rig import LENGTH_SCALE, similarity
from slipwise.rig.readings import PROTOTYPE_STIFFNESS, SLENDERNESS
from slipwise.studies.paper.finding import HOLDS, LIMITS, Finding, Study
from slipwise.studies.paper.settings import PaperSettings, paper_model

#: Rated normal pressure. Source: paper, Frictional isolator.
RATED_PRESSURE = 16.9e6


def bridge_row(bridge: str, model: Model) -> dict[str, Any]:
    """Return one bridge, model and prototype [SI], beside the scales between them."""
    scale, specimen = similarity(LENGTH_SCALE[bridge]), model.built_specimen()
    stiffness = sum(specimen.buffer_stiffness)
    return {
        "bridge": bridge,
        "length": scale.length,
        "time": scale.time,
        "velocity": scale.velocity,
        "mass": scale.mass,
        "force": scale.force,
        "stiffness": scale.stiffness,
        "energy": scale.energy,
        "supported_mass": specimen.mass * scale.mass,
        "pad_diameter": 2.0 * specimen.pad_radius * scale.length,
        "buffer_each": specimen.buffer_stiffness[0],
        "buffers": stiffness,
        "period_model": 1.0 / specimen.frequency,
        "period_prototype": scale.time / specimen.frequency,
        "period_one_buffer": 2.0 * np.pi * float(np.sqrt(specimen.mass / specimen.buffer_stiffness[0])),
        "centre_height": specimen.centre_height,
        "slenderness": specimen.slenderness,
        "pressure": specimen.rated_pressure,
        "pressure_per_g": 2.0 * specimen.slenderness * specimen.rated_pressure,
        "uplift": 1.0 / (2.0 * specimen.slenderness),
    }


def masses_that_round_to(pressure: float, model: Model) -> tuple[float, float]:
    """Return the range of girder masses [kg] whose pressure on four full discs rounds to the stated one (0.1 MPa)."""
    specimen = model.built_specimen()
    area = len(specimen.pads) * specimen.pad_area / specimen.gravity
    return (pressure - 0.05e6) * area, (pressure + 0.05e6) * area


def unscaled(bridge: str, model: Model) -> dict[str, float]:
    """Return what the material does not scale: prototype over model, where similarity asks for 1 [1].

    Source: physics of the law: n has the unit s/m; a half-space warms as mu P V sqrt(t).
    """
    scale = LENGTH_SCALE[bridge]
    rate, speed = model["shear_rate"].values["rate"], 0.1
    model_share, bridge_share = (1.0 - np.exp(-rate * speed * factor) for factor in (1.0, scale**0.5))
    return {
        "speed_saturation": float(bridge_share / model_share),
        "heating_model_over_bridge": scale**-0.75,
        "lengths_model_over_bridge": scale,
    }


def study(settings: PaperSettings) -> Study:
    """Compare similarity and prototypes with what the paper gives."""
    models = {bridge: paper_model(bridge, settings) for bridge in LENGTH_SCALE}
    rows = [bridge_row(bridge, model) for bridge, model in models.items()]
    lost = {bridge: unscaled(bridge, model) for bridge, model in models.items()}
    low, high = masses_that_round_to(RATED_PRESSURE, models["bridge1"])
    one, two = rows
    findings = (
        Finding(
            "Table 1",
            "Length scales 10.69 and 12.17; acceleration, pressure and h/b scale by 1.",
            "exact but for n, heat and pre-sliding",
            f"Time and speed scale by {one['time']:.3f} and {two['time']:.3f}, mass and force by {one['mass']:.1f} and "
            f"{two['mass']:.1f}, energy by {one['energy']:.0f} and {two['energy']:.0f}. What the material keeps does "
            "not "
            f"scale: at 10 cm/s in the model eq. (5) has {1 / lost['bridge1']['speed_saturation']:.0%} of the bridge's "
            f"speed term, the model warms {lost['bridge1']['heating_model_over_bridge']:.2f} of the bridge, and "
            f"pre-sliding and run-in lengths are {lost['bridge1']['lengths_model_over_bridge']:.0f} times too long.",
            LIMITS,
            "Exact for rigid-body mechanics and buffers; broken for n (s/m), heating, pre-sliding and run-in. The "
            "table "
            "itself is not in the text: these are the scales that its two statements imply.",
            (),
            {"bridges": rows, "unscaled": lost},
        ),
        Finding(
            "Specimen",
            "Four 43 mm discs under a 10 t girder give 16.9 MPa.",
            f"{one['pressure'] / 1e6:.2f} MPa",
            f"{one['pressure'] / 1e6:.2f} MPa; any mass from {low / 1e3:.2f} to {high / 1e3:.2f} t rounds to 16.9: "
            "the pads "
            "carry everything, the buffers nothing.",
            HOLDS if low <= models["bridge1"].specimen.mass <= high else LIMITS,
            "For full discs and four pads.",
            (),
            {"mass_low": low, "mass_high": high},
        ),
        Finding(
            "Buffers",
            "18.5 and 13.7 kN/mm in the prototype.",
            f"{one['buffer_each'] / 1e6:.3f} and {two['buffer_each'] / 1e6:.3f} kN/mm in the model",
            f"Divided by the scale: {one['buffer_each'] / 1e6:.4f} and {two['buffer_each'] / 1e6:.4f} kN/mm each; "
            "periods "
            f"{one['period_model']:.4f} and {two['period_model']:.4f} s in the model, {one['period_prototype']:.3f} "
            "and "
            f"{two['period_prototype']:.3f} s in the prototype.",
            HOLDS,
            "Two buffers to a specimen, each with the stated stiffness.",
            ("stiffness_means", "stiffness_of"),
            {"stated": dict(PROTOTYPE_STIFFNESS)},
        ),
        Finding(
            "Prototypes",
            "h/b is 0.122 and 0.244.",
            f"h = {one['centre_height']:.3f} and {two['centre_height']:.3f} m",
            f"h = {one['centre_height']:.3f} and {two['centre_height']:.3f} m; rocking moves the pressure by "
            f"{one['pressure_per_g'] / 1e6:.2f} and {two['pressure_per_g'] / 1e6:.2f} MPa per g and lifts a pad at "
            f"{one['uplift']:.2f} and {two['uplift']:.2f} g.",
            HOLDS,
            "Only h/b enters; h itself depends on what b is.",
            ("b_means", "shake_axis", "pad_spacing_x"),
            {"slenderness": dict(SLENDERNESS)},
        ),
    )
    tables = {"Scales, prototype over model, and what follows": [_shown(row) for row in rows]}
    return Study("scaling", "Similarity and prototypes (Table 1, Fig. 3)", findings, tables)


def _shown(row: dict[str, Any]) -> dict[str, Any]:
    return {
        "bridge": row["bridge"],
        "length": f"{row['length']:.2f}",
        "time, speed": f"{row['time']:.4f}",
        "mass, force": f"{row['mass']:.2f}",
        "energy": f"{row['energy']:.1f}",
        "supported mass [t]": f"{row['supported_mass'] / 1e3:.0f}",
        "pad [mm]": f"{row['pad_diameter'] * 1e3:.0f}",
        "model buffers [kN/mm]": f"{row['buffers'] / 1e6:.4f}",
        "period, model [s]": f"{row['period_model']:.4f}",
        "period, bridge [s]": f"{row['period_prototype']:.3f}",
        "h [m]": f"{row['centre_height']:.3f}",
        "swing [MPa/g]": f"{row['pressure_per_g'] / 1e6:.2f}",
        "uplift [g]": f"{row['uplift']:.2f}",
    }
