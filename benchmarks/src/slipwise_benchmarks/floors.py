"""Size of a hidden effect in floors: what it moves in each balance, over what sensor noise moves there.

Residuals are those of a model with the TRUE base parameters, from noise-free recorded channels:
pads F - F_base(N, v); girder m a_x + sum F + K x; heave sum N - m (g + a_z); pitch, roll and warp of the loads;
kinematics: girder less table acceleration, in x and in z, against the true one.
"raw" is their rms over the floor; "after_fit" what is left of it when the base parameters are fitted to it (linearly).
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space

from slipwise_benchmarks.gauges import Logger
from slipwise_benchmarks.rig_ode import carried_mass
from slipwise_benchmarks.settings import GRAVITY, Settings, buffers_of, pad_names, pads_of

Array = NDArray[np.float64]
Balance = tuple[Array, Array]  # residual (n,), what base parameters can do to it (n, parameters)


def _stack(p: Settings, run: dict[str, Array], part: str) -> Array:
    return np.stack([run[f"pad_{pad}_{part}"] for pad in pad_names(p)])


def _places(p: Settings) -> tuple[Array, Array]:
    """Give how far the pads stand from the centre of gravity along x and y, (n,) each [m]."""
    pads = pads_of(p)
    return np.array([pad.x for pad in pads]) - p.centre_x, np.array([pad.y for pad in pads]) - p.centre_y


def _springs(p: Settings) -> tuple[float, float, float]:
    """Give the stiffness of the buffers along x [N/m], and their moment about the girder per slip along x and y [N]."""
    buffers = buffers_of(p)
    turn_x = sum(b.stiffness_x * (p.height - b.z) for b in buffers)
    turn_y = sum(b.stiffness_y * (p.height - b.z) for b in buffers)
    return sum(b.stiffness_x for b in buffers), turn_x, turn_y


def _frame(p: Settings, run: dict[str, Array], felt: Array, axis: str) -> tuple[Array, Array]:
    """Give what the storeys push the girder along an axis [N], and their moment about its centre of gravity [N m].

    The moment is that of this push and of the floors' weight, which stands beside the girder by what the columns carry
    over their stiffness; damping left out.
    """
    push, moment, beside = np.zeros(felt.size), np.zeros(felt.size), np.zeros(felt.size)
    names = [f"storey_{number}_a{axis}" for number in range(1, len(p.storeys) + 1)]
    inertia = [floor.mass * run[name] for floor, name in zip(p.storeys, names, strict=True)]
    for place, floor in enumerate(p.storeys):
        beside = beside - np.sum(inertia[place:], axis=0) / floor.stiffness
        push = push - inertia[place]
        moment += -(floor.z - p.height) * inertia[place] + floor.mass * felt * beside
    return push, moment


def _warps(p: Settings) -> Array:
    """Give the patterns (n - 3, n) that the loads of pads in one plane, under a rigid girder, do not have."""
    pads = pads_of(p)
    rigid = np.array([(pad.stiffness, pad.stiffness * pad.x, pad.stiffness * pad.y) for pad in pads])
    return 2.0 * null_space((rigid / np.abs(rigid).max(axis=0)).T).T


def _pad_balance(
    p: Settings, true: dict[str, Array], clean: dict[str, Array], logger: Logger, stride: int, axis: str
) -> Balance:
    rate = 1.0 / (true["time"][1] - true["time"][0])
    residual, columns = [], []
    speed = np.hypot(true["slip_vx"], true["slip_vy"])[::stride]
    phi = 1.0 - np.exp(-p.n * speed)
    slip = true[f"slip_{axis}"][::stride]
    for pad in pads_of(p):
        base = true[f"pad_{pad.name}_F{axis}_base"]
        load = true[f"pad_{pad.name}_N"][::stride]
        filled = 1.0 - np.exp(-p.k * load / pad.area)
        bound = p.s1 * pad.area * phi * filled + p.alpha * load
        along = (base[::stride] - pad.curvature * load * slip) / np.maximum(bound, 1.0)
        residual.append(clean[f"pad_{pad.name}_F{axis}"] - logger.filtered(base, rate)[::stride])
        columns.append(
            np.stack(
                [
                    along * p.s1 * pad.area * phi * filled,
                    along * p.s1 * pad.area * (1.0 - phi) * filled * p.n * speed,
                    along * p.s1 * phi * (1.0 - filled) * load * p.k,
                    along * p.alpha * load,
                ],
                axis=1,
            )
        )
    return np.concatenate(residual), np.concatenate(columns)


def _rigid_balances(
    p: Settings, true: dict[str, Array], clean: dict[str, Array], logger: Logger, stride: int
) -> dict[str, Balance]:
    rate = 1.0 / (true["time"][1] - true["time"][0])

    def smooth(signal: Array) -> Array:
        return logger.filtered(signal, rate)[::stride]

    load, force = _stack(p, clean, "N"), _stack(p, clean, "Fx").sum(axis=0)
    ax, az, slip = clean["girder_ax"], clean["girder_az"], clean["slip_x"]
    (x, y), (along, turn_x, turn_y), warps = _places(p), _springs(p), _warps(p)
    buffer = along * slip
    arm_x = x[:, None] - slip
    arm_y = y[:, None] - smooth(true["slip_y"])
    turn, tilt = smooth(true["pitch_acceleration"]), smooth(true["roll_acceleration"])
    nothing = np.zeros((slip.size, 0))
    floors_y = {n: smooth(true[n]) for n in true if n.startswith("storey_") and n.endswith("_ay")}
    push, frame_x = _frame(p, clean, GRAVITY + az, "x")
    _, frame_y = _frame(p, floors_y, GRAVITY + az, "y")
    carried = carried_mass(p)
    along_x = p.height * force + turn_x * slip
    along_y = p.height * smooth(_stack(p, true, "Fy").sum(axis=0)) + turn_y * smooth(true["slip_y"])
    pitch = along_x + frame_x - (arm_x * load).sum(axis=0)
    roll = (arm_y * load).sum(axis=0) - along_y - frame_y
    known = np.array([pad.stiffness * pad.height for pad in pads_of(p)])
    warp = (warps @ (load - known[:, None])).ravel()
    return {
        "girder": (p.mass * ax + force + buffer - push, np.stack([ax, slip], axis=1)),
        "heave": (load.sum(axis=0) - carried * (GRAVITY + az), (GRAVITY + az)[:, None]),
        "pitch": (pitch - p.inertia_pitch * turn, np.stack([along_x, turn], axis=1)),
        "roll": (roll - p.inertia_roll * tilt, np.stack([along_y, tilt], axis=1)),
        **({"warp": (warp, np.repeat(warps @ known, slip.size)[:, None])} if warp.size else {}),
        "kinematics": (ax - clean["table_ax"] - smooth(true["girder_ax"] - true["table_ax"]), nothing),
        "kinematics_z": (az - clean["table_az"] - smooth(true["girder_az"] - true["table_az"]), nothing),
    }


def noise_floors(p: Settings, noise: dict[str, float]) -> dict[str, float]:
    """Give the standard deviation that sensor noise alone gives each balance, in its unit [N, N m or m/s^2]."""
    (x, y), (along, moment, _) = _places(p), _springs(p)
    root = np.sqrt(len(x))
    force = root * noise["force"]
    arms = float(np.sqrt((x**2).sum())), float(np.sqrt((y**2).sum()))
    return {
        "pads": noise["force"],
        "girder": float(np.sqrt((p.mass * noise["girder"]) ** 2 + force**2 + (along * noise["slip"]) ** 2)),
        "heave": float(np.hypot(root * noise["load"], p.mass * noise["girder"])),
        "pitch": float(
            np.sqrt((arms[0] * noise["load"]) ** 2 + (p.height * force) ** 2 + (moment * noise["slip"]) ** 2)
        ),
        "roll": arms[1] * noise["load"],
        "warp": 2.0 * noise["load"],
        "kinematics": float(np.hypot(noise["girder"], noise["table"])),
        "kinematics_z": float(np.hypot(noise["girder"], noise["table"])),
    }


def sizes_in_floors(
    p: Settings, true: list[dict[str, Array]], clean: list[dict[str, Array]], logger: Logger
) -> dict[str, dict[str, float]]:
    """Give {"raw": {balance: floors}, "after_fit": {balance: floors}}, rms over all runs.

    Args:
        p: the specimen's true base parameters.
        true: channels of `simulate`, one for each run.
        clean: what perfect sensors behind the same logger, faults included, show of them.
        logger: the chain.
    """
    balances: dict[str, list[Balance]] = {}
    for of_run, shown in zip(true, clean, strict=True):
        stride = int(round((shown["time"][1] - shown["time"][0]) / (of_run["time"][1] - of_run["time"][0])))
        for axis in "xy" if f"pad_{pad_names(p)[0]}_Fy" in shown else "x":
            balances.setdefault("pads", []).append(_pad_balance(p, of_run, shown, logger, stride, axis))
        for name, balance in _rigid_balances(p, of_run, shown, logger, stride).items():
            balances.setdefault(name, []).append(balance)
    floors = noise_floors(p, logger.noise)
    raw, left = {}, {}
    for name, parts in balances.items():
        residual = np.concatenate([part[0] for part in parts])
        columns = np.concatenate([part[1] for part in parts])
        scale = np.sqrt((columns**2).mean(axis=0))
        columns = columns[:, scale > 0.0] / scale[scale > 0.0]
        fit = columns @ np.linalg.lstsq(columns, residual, rcond=None)[0] if columns.shape[1] else 0.0
        raw[name] = float(np.sqrt((residual**2).mean()) / floors[name])
        left[name] = float(np.sqrt(((residual - fit) ** 2).mean()) / floors[name])
    return {"raw": raw, "after_fit": left}
