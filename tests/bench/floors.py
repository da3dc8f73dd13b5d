"""Size of a hidden effect in floors: what it moves in each balance, over what sensor noise moves there.

Residuals are those of a model with the TRUE base parameters, from noise-free recorded channels:
pads F - F_base(N, v); girder m a_x + sum F + K x; heave sum N - m (g + a_z); pitch, roll and warp of the loads;
kinematics: girder less table acceleration, in x and in z, against the true one.
"raw" is their rms over the floor; "after_fit" what is left of it when the base parameters are fitted to it (linearly).
"""

import numpy as np
from numpy.typing import NDArray

from bench.gauges import Logger
from bench.settings import GRAVITY, PAD_SIGN_X, PAD_SIGN_Y, PADS, Settings

Array = NDArray[np.float64]
Balance = tuple[Array, Array]  # residual (n,), what base parameters can do to it (n, parameters)


def _stack(run: dict[str, Array], part: str) -> Array:
    return np.stack([run[f"pad_{pad}_{part}"] for pad in PADS])


def _pad_balance(
    p: Settings, true: dict[str, Array], clean: dict[str, Array], logger: Logger, stride: int, axis: str
) -> Balance:
    rate = 1.0 / (true["time"][1] - true["time"][0])
    residual, columns = [], []
    speed = np.hypot(true["slip_vx"], true["slip_vy"])[::stride]
    phi = 1.0 - np.exp(-p.n * speed)
    for pad in PADS:
        base = true[f"pad_{pad}_F{axis}_base"]
        load = true[f"pad_{pad}_N"][::stride]
        filled = 1.0 - np.exp(-p.k * load / p.pad_area)
        bound = p.s1 * p.pad_area * phi * filled + p.alpha * load
        along = base[::stride] / np.maximum(bound, 1.0)
        residual.append(clean[f"pad_{pad}_F{axis}"] - logger.filtered(base, rate)[::stride])
        columns.append(
            np.stack(
                [
                    along * p.s1 * p.pad_area * phi * filled,
                    along * p.s1 * p.pad_area * (1.0 - phi) * filled * p.n * speed,
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

    load, force = _stack(clean, "N"), _stack(clean, "Fx").sum(axis=0)
    ax, az, slip = clean["girder_ax"], clean["girder_az"], clean["slip_x"]
    buffer = p.buffer_stiffness * slip
    arm_x = 0.5 * p.spacing_x * np.array(PAD_SIGN_X)[:, None] - slip
    arm_y = 0.5 * p.spacing_y * np.array(PAD_SIGN_Y)[:, None] - smooth(true["slip_y"])
    turn, tilt = smooth(true["pitch_acceleration"]), smooth(true["roll_acceleration"])
    nothing = np.zeros((slip.size, 0))
    across = smooth(_stack(true, "Fy").sum(axis=0)) + p.buffer_stiffness * smooth(true["slip_y"])
    pitch = p.height * (force + buffer) - (arm_x * load).sum(axis=0)
    roll = (arm_y * load).sum(axis=0) - p.height * across
    return {
        "girder": (p.mass * ax + force + buffer, np.stack([ax, slip], axis=1)),
        "heave": (load.sum(axis=0) - p.mass * (GRAVITY + az), (GRAVITY + az)[:, None]),
        "pitch": (pitch - p.inertia_pitch * turn, np.stack([force + buffer, turn], axis=1)),
        "roll": (roll - p.inertia_roll * tilt, np.stack([across, tilt], axis=1)),
        "warp": (load[0] - load[1] - load[2] + load[3], nothing),
        "kinematics": (ax - clean["table_ax"] - smooth(true["girder_ax"] - true["table_ax"]), nothing),
        "kinematics_z": (az - clean["table_az"] - smooth(true["girder_az"] - true["table_az"]), nothing),
    }


def noise_floors(p: Settings, noise: dict[str, float]) -> dict[str, float]:
    """Give the standard deviation that sensor noise alone gives each balance, in its unit [N, N m or m/s^2]."""
    buffer = p.buffer_stiffness * noise["slip"]
    force = 2.0 * noise["force"]
    return {
        "pads": noise["force"],
        "girder": float(np.sqrt((p.mass * noise["girder"]) ** 2 + force**2 + buffer**2)),
        "heave": float(np.hypot(2.0 * noise["load"], p.mass * noise["girder"])),
        "pitch": float(
            np.sqrt((p.spacing_x * noise["load"]) ** 2 + (p.height * force) ** 2 + (p.height * buffer) ** 2)
        ),
        "roll": p.spacing_y * noise["load"],
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
        for axis in "xy" if "pad_A_Fy" in shown else "x":
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
