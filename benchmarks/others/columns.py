"""What the regression tools of this folder are given: measured forces, the base law, and one column an effect.

Every tool sees the same rows and the same columns; what differs is how it chooses among them. Only the fitted runs are
read. A column is the force that a textbook form of the effect would add, from measured slips and loads, with lengths
and times set to usual values. An effect is named where what was chosen for it does `MATERIAL` of the rms of its
force beyond what the base law and all else that was chosen can do.
"""

import json
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import savgol_filter

MATERIAL = 0.02  # the share of a channel that campaigns call material [1]
ROWS = 1200  # of a run that are kept: what is sampled faster is correlated
SLOW = 2.0e-3  # speed below which a pad is about to stick [m/s]
UNITS = {"s": 1.0, "ms": 1e-3, "mm": 1e-3, "m": 1.0, "kN": 1e3, "N": 1.0, "mrad": 1e-3, "m/s^2": 1.0, "g": 9.80665}
UNITS |= {"cm": 1e-2, "MN": 1e6, "rad": 1.0, "degC": 1.0, "K": 1.0, "mm/s": 1e-3, "m/s": 1.0}


@dataclass(frozen=True)
class Problem:
    """Rows of one campaign, each force over its own rms.

    Attributes:
        force: (n,) [1].
        base: (n, m) derivatives of the base law by its parameters at their fit, and the fit itself as the first.
        columns: (n, k) of the candidates, each of rms 1.
        names: of the effects, one a column; two columns may have one name.
    """

    force: np.ndarray
    base: np.ndarray
    columns: np.ndarray
    names: list[str]


def read_runs(folder: Path) -> tuple[list[dict[str, np.ndarray]], float]:
    """Give the fitted runs in SI units, and the mass that is said (0 for a slider)."""
    said = tomllib.loads((folder / "campaign.toml").read_text(encoding="utf-8"))
    built = folder / "specimen.toml"
    rig = tomllib.loads(built.read_text(encoding="utf-8")) if built.exists() else {}
    mass, _, unit = str((rig | said.get("specimen", {})).get("mass", "0 kg")).partition(" ")
    runs = []
    for run in said["run"]:
        if run["role"] == "holdout":
            continue
        head, *lines = (folder / run["file"]).read_text(encoding="utf-8").splitlines()
        table = np.array([[float(cell or "nan") for cell in line.split(",")] for line in lines])
        columns = {}
        for name, values in zip(head.split(","), table.T, strict=True):
            word, _, rest = name.strip().partition(" [")
            columns[word] = values * UNITS.get(rest.rstrip("]"), 1.0)
        runs.append(columns)
    if not float(mass) and "girder_ax" in runs[0]:  # nobody says it: what its pads carry
        loads = [values for name, values in runs[0].items() if name.startswith("pad_") and name.endswith("_N")]
        return runs, float(np.nanmean(loads, axis=1).sum()) / 9.80665
    return runs, float(mass) * (1e3 if unit == "t" else 1.0)


def problem_of(folder: Path) -> Problem:
    """Read a campaign, fit the base law, and give rows and columns."""
    runs, mass = read_runs(folder)
    parts = [_run(run, mass) for run in runs]
    blocks, names = [], []
    for key in parts[0]:  # one force: a pad, or what is left for the buffers
        force, law, added = (np.concatenate([part[key][i] for part in parts], axis=-1) for i in (0, 1, 2))
        keep = np.isfinite(force) & np.isfinite(law).all(axis=0) & np.isfinite(added).all(axis=0)
        force, law, added = force[keep], law[:, keep], added[:, keep]
        size = float(np.sqrt(np.mean(force**2))) or 1.0
        blocks.append((force / size, _base(force / size, law / size), added / size))
        names.append(parts[0][key][3])
    rows = sum(block[0].size for block in blocks)
    kinds = list(dict.fromkeys(name for own in names for name in own))
    base = np.zeros((rows, sum(block[1].shape[1] for block in blocks)))
    columns, start, left = np.zeros((rows, len(kinds))), 0, 0
    for (force, law, added), own in zip(blocks, names, strict=True):
        here = slice(start, start + force.size)
        base[here, left : left + law.shape[1]] = law
        for name, column in zip(own, added, strict=True):
            columns[here, kinds.index(name)] = column
        start, left = here.stop, left + law.shape[1]
    scale = np.sqrt(np.mean(columns**2, axis=0))
    seen = scale > 0.0
    kinds = [name.split(":")[0] for name, is_seen in zip(kinds, seen, strict=True) if is_seen]
    force = np.concatenate([block[0] for block in blocks])
    return Problem(force, base, columns[:, seen] / scale[seen], kinds)


def _base(force: np.ndarray, law: np.ndarray) -> np.ndarray:
    """Fit a + b (1 - exp(-n |v|)) + c p of `law` (friction), or its rows alone (buffers); give derivatives."""
    if law.shape[0] < 4:
        return law.T
    friction, more, speed, extra = law[0], law[1], law[2] / np.abs(law[2]).max(), law[3:]

    def model(x: np.ndarray) -> np.ndarray:
        return friction * (x[0] + x[1] * (1.0 - np.exp(-x[2] * speed))) + x[3] * more + x[4:] @ extra

    start = np.array([0.05, 0.05, 5.0, 0.0, *np.zeros(len(extra))])
    fit = least_squares(lambda x: model(x) - force, start)
    return np.column_stack([model(fit.x), fit.jac])


def _run(run: dict[str, np.ndarray], mass: float) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray, list[str]]]:
    """Give force, rows of the base law, candidates and their names, of each pad and of the buffers together."""
    time, slip = run["time"], run["slip_x"]
    step = float(np.median(np.diff(time)))
    window = max(5, 2 * int(0.01 / step) + 1)
    speed = savgol_filter(np.nan_to_num(slip), window, 2, deriv=1, delta=step)
    way = np.tanh(speed / SLOW)
    moved = np.abs(np.gradient(slip))
    turned = np.concatenate([[0], np.cumsum(np.diff(np.sign(speed)) != 0)])
    passed = np.cumsum(moved)
    since = passed - np.array([passed[np.argmax(turned == k)] for k in range(turned[-1] + 1)])[turned]
    stroke = float(np.nanmax(np.abs(slip))) or 1.0
    bristle, spring = _lagged(slip, 1e-3), _lagged(slip, 1e-2)
    thin = slice(None, None, max(1, time.size // ROWS))
    pads = [name[:-3] for name in run if name.startswith("pad_") and name.endswith("_Fx")]
    out = {}
    for pad in pads:
        load, force = run[f"{pad}_N"], run[f"{pad}_Fx"]
        mean = float(np.nanmean(load))
        warm = np.cumsum(np.abs(speed) * load) * step
        late = np.abs(savgol_filter(np.abs(speed), 4 * window + 1, 1))
        candidates = {
            "breakaway": load * way * np.exp(-since / 5e-3),
            "presliding": load * (bristle - way),
            "heating": load * way * warm / (warm.max() or 1.0),
            "run_in": load * way * np.exp(-5.0 * passed / passed[-1]),
            "rate_and_state": load * way * np.log((late + SLOW) / (np.abs(speed) + SLOW)),
            "direction_asymmetry": load,
            "position_patch": load * way * np.exp(-((slip / (0.3 * stroke)) ** 2)),
            "slide_curvature": load * slip,
            "restrainer": np.sign(slip) * np.maximum(np.abs(slip) - 0.8 * stroke, 0.0),
            f"channel_offset:{pad}": np.ones_like(load),
            f"channel_drift:{pad}": time - time[0],
            f"channel_delay:{pad}": np.gradient(force, time),
        }
        if len(pads) > 1:
            candidates[f"pad_spread:{pad}"] = load * way
        law = np.array([load * way, load * way * (load / mean - 1.0), np.abs(speed), 0.0 * load])
        out[pad] = (force[thin], law[:, thin], np.array([*candidates.values()])[:, thin], list(candidates))
    if mass and "girder_ax" in run:  # what no pad carries
        rest = -mass * run["girder_ax"] - sum(run[f"{pad}_Fx"] for pad in pads)
        held = {
            "guide_drag": way,
            "buffer_damping": speed,
            "buffer_hardening": slip**3,
            "buffer_softening": slip * np.abs(slip),
            "buffer_hysteresis": spring,
        }
        law = np.array([slip, np.ones_like(slip)])
        out["rest"] = (rest[thin], law[:, thin], np.array([*held.values()])[:, thin], list(held))
    return out


def _lagged(slip: np.ndarray, length: float) -> np.ndarray:
    """Give the state of a spring of `length` in series with a slider, from -1 to 1."""
    state, out = 0.0, np.zeros_like(slip)
    for i, moved in enumerate(np.diff(slip, prepend=slip[0])):
        state = min(1.0, max(-1.0, state + moved / length)) if np.isfinite(moved) else state
        out[i] = state
    return out


def without_base(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Give force (n,) and columns (n, k) without what changes of the base law can do."""
    q = np.linalg.qr(problem.base)[0]
    return problem.force - q @ (q.T @ problem.force), problem.columns - q @ (q.T @ problem.columns)


def named(problem: Problem, sizes: np.ndarray) -> list[str]:
    """Give the effects whose chosen columns are material, the largest first.

    What counts is what neither the base law nor the other chosen columns can do: two columns that are nearly one have
    large sizes of opposite signs.
    """
    chosen = np.flatnonzero(sizes)
    columns = without_base(problem)[1][:, chosen]
    alone = {}
    for place, i in enumerate(chosen):
        others = np.delete(columns, place, axis=1)
        own = columns[:, place] - others @ np.linalg.lstsq(others, columns[:, place], rcond=None)[0]
        alone[i] = abs(sizes[i]) * float(np.sqrt(np.mean(own**2)))
    order = sorted(alone, key=lambda i: -alone[i])
    return list(dict.fromkeys(problem.names[i] for i in order if alone[i] >= MATERIAL))


def answer_all(folder: Path, tool: str, choose: Callable[[Problem], tuple[list[str], float | None]]) -> None:
    """Write verdicts of a tool that chooses among the columns on every campaign of a folder."""
    answer_folders(folder, tool, lambda campaign: choose(problem_of(campaign)))


def answer_folders(folder: Path, tool: str, choose: Callable[[Path], tuple[list[str], float | None]]) -> None:
    """Write verdicts of one tool on the campaigns that have none: FOLDER/verdicts_TOOL/NAME.json."""
    out = folder / f"verdicts_{tool}"
    out.mkdir(exist_ok=True)
    found = [path for path in (folder / "campaigns").iterdir() if path.is_dir()]
    for campaign in sorted(found, key=lambda path: path.name.split("-")[::-1]):  # one of every family, then again
        path = out / f"{campaign.name}.json"
        if path.exists():
            continue
        try:
            effects, chance = choose(campaign)
            said = {"verdict": "named" if effects else "complete", "effects": effects, "probability": chance}
        except Exception as error:  # a tool that stops has given no verdict, which is counted as wrong
            said = {"verdict": "failed", "effects": [], "words": f"{type(error).__name__}: {error}"}
        path.write_text(json.dumps(said) + "\n", encoding="utf-8")
        print(campaign.name, said, flush=True)
