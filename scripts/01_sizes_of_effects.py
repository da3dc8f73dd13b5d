"""How much does each effect matter on a Bridge 1 earthquake? Ours beside an independent planar simulator.

Each effect is put into the rig at one size; the free run is compared with the base run (slip, acceleration, sum of
friction, load of pad A, each as rms of the difference over rms of the base's swing), and the base law, driven with the
changed run's own load and speed, with the friction of pad A ("pad level").

The other program has rigid pads, quasi-static rocking, a stick zone of 0.2 mm/s and another realisation of the motion
(E 517 kN cm, 28.3 mm). Among twelve seeds, the one of like energy and slip is taken here. So sign and order of
magnitude are what can agree.

    python scripts/01_sizes_of_effects.py [--quick]
"""

import argparse
import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from slipwise.model import EffectUse, Model, base_model, use
from slipwise.motion import load_motion
from slipwise.record import Record, write_json
from slipwise.simulation.predict import predictor
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import Replay
from slipwise.view.words.terminal import print_table

MOTION = "quake:seed=12,peak=0.7g,f=4Hz,strong=4s,vertical=0.25g"
LEVEL = MOTION.removesuffix(",vertical=0.25g")
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Row:
    """One line of the table: what is changed, and what the other program gives.

    Attributes:
        name: of the effect, with its size.
        uses: effects that are put into the model.
        expected: E [kN cm], largest slip [mm], and in % the differences of slip, acceleration, sum of friction, load
            of pad A, and the pad level; nan where the other program says nothing.
    """

    name: str
    uses: tuple[EffectUse, ...]
    expected: tuple[float, ...]
    scaled: float = 1.0
    stiffer: float = 1.0
    motion: str = MOTION


NAN = math.nan
WARP = 0.05 * 10e3 * 9.80665 / 200e6
ROWS: tuple[Row, ...] = (
    Row("mu +5 %", (), (494, 26.8, 10, 10, 15, 7, 4.8), scaled=1.05),
    Row("heating", (use("heating"),), (603, 33.4, 53, 51, 39, 37, 24.7)),
    Row("run_in 0.3, 0.1 m", (use("run_in"),), (493, 26.7, 11, 12, 20, 9, 10.5)),
    Row("breakaway 0.05, 2 cm/s", (use("breakaway"),), (505, 28.3, 9, 11, 34, 8, 18.4)),
    Row("presliding 0.05 mm", (use("presliding", length=0.05e-3),), (534, 28.9, 5, 8, 24, 6, NAN)),
    Row("presliding 0.3 mm", (use("presliding"),), (569, 30.3, 13, 19, 38, 14, 57)),
    Row("presliding 1 mm", (use("presliding", length=1e-3),), (623, 32.8, 30, 37, 53, 27, NAN)),
    Row("buffer_damping 4 %", (use("buffer_damping"),), (348, 20.7, 38, 39, 33, 28, 0.1)),
    Row("buffer k +10 %", (), (558, 30.5, 37, 38, 46, 28, 0), stiffer=1.1),
    Row("key_clearance 0.5 mm", (use("key_clearance"),), (475, 26.1, 17, 16, 29, 12, 0)),
    Row("key_clearance 2 mm", (use("key_clearance", clearance=2e-3),), (358, 21.8, 59, 54, 62, 39, 0)),
    Row("buffer_hardening 10 %", (use("buffer_hardening"),), (522, 28.6, 13, 14, 19, 10, 0)),
    Row("buffer_softening 20 %", (use("buffer_softening"),), (535, 29.5, 10, 11, 17, 8, 0)),
    Row("slide_tilt 1/300", (use("slide_tilt"),), (517, 28.4, 1.6, 0.4, 1.6, 0.3, 3.7)),
    Row("uneven_seating .30/.20", (use("uneven_seating", warp=WARP),), (520, 28.5, 1.5, 1.9, 3, 284, 0.1)),
    Row("key_friction 0.15", (use("key_friction"),), (511, 28.0, 4, 4, 9, 43, 0.1)),
    Row("buffer_height 0.4 m", (use("buffer_height", height=0.4),), (516, 28.3, 0.3, 0.6, 0.8, 76, 0)),
    Row("table_gain -5 %", (use("table_gain"),), (447, 25.5, 13, 13, 14, 10, 0)),
    Row("no vertical motion", (), (523, 28.7, 2, 3, 8, 71, 0), motion=LEVEL),
    Row("channel_delay 5 ms", (use("channel_delay", "pad_A_Fx", delay=5e-3),), (NAN,) * 6 + (19.4,)),
    Row("load_crosstalk 1 %", (use("load_crosstalk", "pad_A_Fx"),), (NAN,) * 6 + (11.2,)),
    Row("cell_inertia 30 kg", (use("cell_inertia", "pad_A_Fx"),), (NAN,) * 6 + (2.3,)),
    Row("channel_gain 3 %", (use("channel_gain", "pad_A_Fx"),), (NAN,) * 6 + (2.9,)),
)
BASE = (517, 28.3, NAN, NAN, NAN, NAN, NAN)
COLUMNS = ("E", "max slip", "slip", "acceleration", "sum F", "N of A", "pad level")


def changed(base: Model, row: Row) -> Model:
    """Give the base model with what a row says."""
    model = base.adding(*row.uses)
    if row.scaled != 1.0:
        law = model["shear_rate"].values
        model = model.setting("shear_rate", strength=row.scaled * law["strength"], slow=row.scaled * law["slow"])
    stiffness = tuple(row.stiffer * k for k in model.specimen.buffer_stiffness)
    return replace(model, specimen=model.specimen.changed(buffer_stiffness=stiffness))


def energy(answer: Replay) -> float:
    """Energy dissipated by the pads [kN cm]."""
    return sum(answer.pad_energy.values()) / 10.0


def largest(answer: Replay) -> float:
    """Largest slip [mm]."""
    return 1e3 * max(-answer.slip_range[0], answer.slip_range[1])


def _different(ours: Array, base: Array, rest: float = 0.0) -> float:
    return 100.0 * float(np.sqrt(np.mean((ours - base) ** 2) / np.mean((base - rest) ** 2)))


def pad_level(base: Model, record: Record) -> float:
    """Error of the base law on pad A [%], driven by the run's own load and speed, where it slides."""
    loads = record.stacked("pad_{}_N")
    velocity, slip = (
        np.repeat(np.stack([record[f"{n}x"], record[f"{n}y"]], axis=1)[:, None], 4, axis=1) for n in ("slip_v", "slip_")
    )
    law = predictor(base).pads(record.time, loads, velocity, slip).force[:, 0, 0]
    sliding = (
        np.abs(record["slip_vx"]) > 5e-3
    )  # speed changes so much in a step: below it friction may have turned round
    return _different(law[sliding], record["pad_A_Fx"][sliding])


def sizes(rows: tuple[Row, ...] = ROWS) -> list[tuple[float, ...]]:
    """Replay every row; give the numbers in the order of `COLUMNS`, the base first."""
    model = base_model("bridge1")
    base = replay(model, load_motion(MOTION))
    rest = model.specimen.weight / 4.0
    out: list[tuple[float, ...]] = [(energy(base), largest(base), 0.0, 0.0, 0.0, 0.0, pad_level(model, base.record))]
    for row in rows:
        theirs = changed(model, row)
        answer = replay(theirs, load_motion(row.motion))
        before, after = base.record, answer.record
        friction = [sum(r[f"pad_{p}_Fx"] for p in "ABCD") for r in (after, before)]
        out.append(
            (
                energy(answer),
                largest(answer),
                _different(after["slip_x"], before["slip_x"]),
                _different(after["girder_ax"], before["girder_ax"]),
                _different(np.asarray(friction[0]), np.asarray(friction[1])),
                _different(after["pad_A_N"], before["pad_A_N"], rest),
                pad_level(replace(model, specimen=theirs.specimen), after),
            )
        )
    return out


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Sizes of effects on a Bridge 1 earthquake.")
    parser.add_argument("--quick", action="store_true", help="three rows only")
    parser.add_argument("--out", type=Path, help="folder for sizes.json")
    chosen = parser.parse_args()
    rows = ROWS[:3] if chosen.quick else ROWS
    numbers = sizes(rows)
    lines = []
    for name, ours, theirs in zip(
        ["base", *(r.name for r in rows)], numbers, [BASE, *(r.expected for r in rows)], strict=True
    ):
        cells = {
            column: f"{own:.4g}" if math.isnan(other) else f"{own:.4g} / {other:g}"
            for column, own, other in zip(COLUMNS, ours, theirs, strict=True)
        }
        lines.append({"effect": name, **cells})
    print_table("ours / the other program; E [kN cm], max slip [mm], all others [%]", lines)
    if chosen.out is not None:
        write_json(chosen.out / "sizes.json", lines)


if __name__ == "__main__":
    main()
