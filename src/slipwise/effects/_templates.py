"""What an effect of one's own begins with, port by port: a small law that works, of one strength, neutral at zero."""

from collections.abc import Sequence
from typing import Any

from slipwise.effects._writer import WrittenEffect
from slipwise.effects._written_hook import WrittenHook
from slipwise.params import Parameter

_ABOUT = (
    "This file works as it is: begin with it and change it bit by bit. Say here what happens physically, and in which "
    "test it shows.",
)
#: Port -> what its first law looks like, and the test that tells them apart: of a law of one's own say which of its.
_RIVALS: dict[str, dict[str, str]] = {
    "rig": {"uneven_seating": "that moves the loads at rest along one diagonal only, this one along the girder"},
    "table": {"channel_gain": "a gain of the table's gauge also breaks slip = girder - table"},
    "area": {"pressure_law": "sines of equal speed at several pressures"},
    "shear": {"rate_and_state": "constant speeds: a straight line over log V is rate_and_state"},
    "stick": {"channel_delay": "reversals of different acceleration: constant distance is this, constant time a delay"},
    "pad": {"channel_delay": "sines of two frequencies: a delay grows with frequency, damping with speed"},
    "train": {"presliding": "two loads: the machine's slope is the same at both, a contact's length is"},
    "buffer": {"key_clearance": "a clearance is flat at the middle, hardening bends at the ends"},
    "girder": {
        "buffer_damping": "only yaw and pitch tell: the drag acts at the centre of gravity, damping at the keys"
    },
    "gauge": {"pad_spread": "the girder balance stays clean with a spread of friction"},
}


def _law(
    port: str, component: str, words: Sequence[str], parameters: Sequence[Parameter], *hooks: WrittenHook, **more: Any
) -> WrittenEffect:
    title, equation, signature = words
    return WrittenEffect(
        "", title, equation, _ABOUT, "say in which range of speed, load or size it holds.", "assumed.", port,
        component, hooks, tuple(parameters), signature, _RIVALS[port], **more,
    )  # fmt: skip


def _strength(typical: float, low: float, high: float, meaning: str, unit: str = "1", shown: str = "") -> Parameter:
    return Parameter("strength", unit, typical, low, high, 0.0, "assumed", f"c: {meaning}", shown)


def _hook(name: str, arguments: str, words: str, *lines: str) -> WrittenHook:
    return WrittenHook(name, tuple(arguments.split()), words, lines)


_LAWS = (
    _law(
        "rig", "pad load", (
            "The centre of gravity is off the middle, along the girder",
            "N_i += m (g + a_z) c side_x/(4 b_x)",
            "pitch of the loads at rest and in step with a_z",
        ),
        [_strength(0.02, -0.3, 0.3, "towards +x", "m", "mm")],
        _hook(
            "rig", "specimen strength", "Give the specimen with its centre of gravity moved",
            "return replace(specimen, centre_x=specimen.centre_x + strength)",
        ),
        _hook(
            "balance", "states strength", "Give what the nearer pads carry more (n,) [N], for fits",
            "weight = states.specimen.carried_mass * (states.specimen.gravity + states.girder_acceleration[:, 2])",
            'return {"pitch": weight * strength / states.specimen.half_spacing[0]}',
        ),
    ),
    _law(
        "table", "table", (
            "The table moves more along x than it was told",
            "a_x *= 1 + c",
            "everything along x grows, pads and balances stay clean",
        ),
        [_strength(0.05, -0.5, 0.5, "of the table over its command", shown="%")],
        _hook(
            "table", "acceleration strength", "Scale the motion along x",
            "moved = acceleration.copy()",
            "moved[:, 0] *= 1.0 + strength",
            "return moved",
        ),
        moves=("table_*", "pad_*", "buffer_*", "girder_*", "slip_*", "yaw", "pitch", "roll", "heave"),
    ),
    _law(
        "area", "pad friction", (
            "The real area of contact grows with another power of pressure",
            "A_r *= (P/10 MPa)^c",
            "odd in velocity, a function of pressure only",
        ),
        [_strength(0.1, -0.5, 0.5, "power")],
        _hook(
            "area", "real_area pressure strength", "Scale the real area of contact [m^2]",
            "counted_at = 10e6  # [Pa] a number of its own could not be told from the strength of friction",
            "return real_area * (pressure / counted_at) ** strength",
        ),
    ),
    _law(
        "shear", "pad friction", (
            "Friction grows with the speed of slip, and levels off",
            "mu *= 1 + c [1 - exp(-V/v_0)]",
            "odd in velocity, none at slow speeds",
        ),
        [
            _strength(0.1, -0.5, 1.0, "share added at high speeds", shown="%"),
            Parameter("decay", "m/s", 0.05, 1e-3, 1.0, None, "assumed", "v_0: speed by which it grows", "mm/s"),
        ],
        _hook(
            "coefficient", "coefficient speed strength decay", "Scale the coefficient of friction [1]",
            "return coefficient * (1.0 + strength * (1.0 - exp(-speed / decay)))",
        ),
    ),
    _law(
        "stick", "pad friction", (
            "Before it slips a contact gives way like a spring",
            "F = F_b z/c,  dz/dt = v,  |z| <= c",
            "after each reversal force needs a certain distance to turn round",
        ),
        [_strength(0.3e-3, 0.0, 5e-3, "distance over which it bends", "m", "mm")],
        _hook(
            "stick", "bound slip_x slip_y memory strength", "Bend by the slip since the instant before",
            "x, y = memory[2] + slip_x - memory[0], memory[3] + slip_y - memory[1]",
            "size = max(sqrt(x * x + y * y), strength, 1e-12)",
            "memory[0], memory[1], memory[2], memory[3] = slip_x, slip_y, x * strength / size, y * strength / size",
            "return bound * x / size, bound * y / size",
        ),
        memory=("last_x", "last_y", "bent_x", "bent_y"),
    ),
    _law(
        "pad", "pad friction",
        ("A pad is damped by something viscous", "F += c N v", "odd and linear in velocity, beside friction"),
        [_strength(0.05, 0.0, 0.5, "share of the load at 1 m/s", "s/m")],
        _hook(
            "pad", "load velocity_x velocity_y strength", "Give a further force of the girder on the pad",
            "return strength * load * velocity_x, strength * load * velocity_y",
        ),
    ),
    _law(
        "train", "pad friction", (
            "The machine that drives a slider gives way between its gauge and the contact",
            "x_c = x - c F",
            "after each reversal force rises along one straight line, at any load",
        ),
        [_strength(20e-9, 0.0, 5e-6, "compliance of the machine", "m/N", "um/kN")],
        _hook("stretch", "force strength", "Stretch as a spring [m]", "return strength * force"),
    ),
    _law(
        "buffer", "buffer", (
            "Rubber stiffens with its deflection",
            "F_b *= 1 + c (|x|/30 mm)^p",
            "odd in slip in the girder balance, at the ends of the stroke",
        ),
        [
            _strength(0.1, -0.3, 2.0, "share of force added at 30 mm", shown="%"),
            Parameter("power", "1", 2.0, 0.5, 8.0, None, "assumed", "p: 2 for a cubic spring"),
        ],
        _hook(
            "spring", "force deflection strength power", "Stiffen the force [N]",
            "return force * (1.0 + strength * (abs(deflection) / 0.03) ** power)",
        ),
    ),
    _law(
        "girder", "girder", (
            "Something that is neither pad nor buffer drags on the girder",
            "m a_x + sum F + F_b + c v = 0",
            "odd and linear in v in the girder balance; pads and buffers clean",
        ),
        [_strength(500.0, 0.0, 50e3, "damping", "N*s/m", "kN*s/m")],
        _hook(
            "drag", "velocity_x velocity_y strength", "Give the force against the girder's motion",
            "return strength * velocity_x, strength * velocity_y",
        ),
        _hook(
            "balance", "states strength", "Give the same over a record (n,) [N], for fits",
            'return {"girder": strength * states.velocity[:, 0]}',
        ),
    ),
    _law(
        "gauge", "instrument",
        ("A gauge reads too much", "y = (1 + c) x", "odd and flat in one channel, which disagrees with the others"),
        [_strength(0.03, -0.5, 1.0, "error of the gain", shown="%")],
        _hook(
            "gauge", "record target strength", "Scale the channel",
            "return record.replaced(**{target: record[target] * (1.0 + strength)})",
        ),
        _hook(
            "undo", "record target strength", "Scale it back",
            "return record.replaced(**{target: record[target] / (1.0 + strength)})",
        ),
        moves=("pad_*_Fx",),
        target="channel",
    ),
)  # fmt: skip
#: Port -> its law, still without a name.
FIRST_LAWS: dict[str, WrittenEffect] = {law.port: law for law in _LAWS}
