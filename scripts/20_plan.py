"""Hold chances of a plan, and of `--power`, against campaigns of the second simulator: eight effects at their limits.

    python scripts/20_plan.py --out out/plan                  # 40 campaigns, five of each effect
    python scripts/20_plan.py --out out/plan --each 20        # 160: enough for the power of a campaign too
    python scripts/20_plan.py --quick                         # the plan alone, of one motion

The plan sees the motions and the gauges, and the rig as rated. Each campaign has a rig of its own, several percent off,
an effect of either sign at the size that the plan calls one limit, and gauges' noise. Beside the plan's chance stands
the one that `--power` gives of a campaign in which nothing is missing. What was diagnosed before is kept in the folder
and not done again.
"""

import argparse
import json
from pathlib import Path

import numpy as np

import slipwise as sw
from slipwise.motion import TableMotion
from slipwise_benchmarks.campaign import fit_amplitude, shake
from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.gauges import USUAL, Logger, measure
from slipwise_benchmarks.motions import NATURAL, Motion, draw_quake, draw_sine
from slipwise_benchmarks.settings import GRAVITY, random_rig, rated
from slipwise_benchmarks.write import write_campaign

RIG = "bridge1"
#: Effect -> what of the simulator's settings is its size.
SETTINGS = {
    "direction_asymmetry": lambda x: {"asymmetry": x},
    "slide_tilt": lambda x: {"tilt": x},
    "buffer_mismatch": lambda x: {"mismatch": x},
    "buffer_height": lambda x: {"buffer_height": x},
    "guide_drag": lambda x: {"drag_form": 1, "drag": abs(x)},
    "mass_eccentricity": lambda x: {"centre_x": x},
    "table_pitch": lambda x: {"pitch_form": 1, "pitch_per_acceleration": x, "pitch_frequency": 15.0},
}
FAULT = ("channel_gain", "slip_x")
ONE_SIDED = ("guide_drag", "buffer_height")


def make_motions() -> dict[str, Motion]:
    """Return the three motions of the test, slips of the rated rig of 1 to 3 cm."""
    rng, base = np.random.default_rng(58), rated(RIG)
    sine = fit_amplitude(base, draw_sine(NATURAL[RIG], rng, False), 0.015, 0.18 * GRAVITY, 0.5 * GRAVITY)
    quakes = [fit_amplitude(base, draw_quake(rng, False), 0.024, 0.4 * GRAVITY, 0.95 * GRAVITY) for _ in range(2)]
    return {"sine_hv": sine, "quake_h": quakes[0].without_vertical(), "quake_hv": quakes[1]}


def as_planned(name: str, motion: Motion) -> TableMotion:
    """Return a motion of the bench as one of the library."""
    return TableMotion(motion.step, np.stack([motion.ax, motion.ay, motion.az], axis=1), name, ("x", "y", "z"))


def make_campaign(effect: str, size: float, number: int, motions: dict[str, Motion], folder: Path) -> Path:
    """Write one campaign with an effect; "" for none."""
    rng = np.random.default_rng([58, number, sum(map(ord, effect))])
    signed = size if effect in ONE_SIDED else size * float(rng.choice([-1.0, 1.0]))
    base = random_rig(RIG, rng)
    settings = base.changed(**SETTINGS[effect](signed)) if effect in SETTINGS else base
    faults = [Fault(FAULT[0], (FAULT[1],), signed)] if effect == FAULT[0] else []
    runs, logger = shake(settings, motions, 0.0), Logger()
    recorded = {name: measure(true, USUAL, logger, faults, rng, i) for i, (name, true) in enumerate(runs.items())}
    place = folder / "campaigns" / f"{effect or 'nothing'}_{number}"
    write_campaign(place, RIG, logger, recorded, [(name, "fit") for name in recorded])
    return place


def run_one(effect: str, size: float, number: int, motions: dict[str, Motion], folder: Path) -> dict:
    """Diagnose one campaign, or read what was said of it before."""
    answer = folder / f"{effect}_{number}.json"
    if answer.is_file():
        return json.loads(answer.read_text(encoding="utf-8"))
    found = sw.diagnose(sw.load_campaign(make_campaign(effect, size, number, motions, folder))).as_json()
    said = {name: found[name] for name in ("effects", "minor", "verdict")}
    answer.write_text(json.dumps(said), encoding="utf-8")
    return said


def find_power(motions: dict[str, Motion], folder: Path) -> dict[str, float]:
    """Return effect -> chance that it would be seen in a campaign like one in which nothing is missing [1]."""
    answer = folder / "power.json"
    if not answer.is_file():
        found = sw.diagnose(sw.load_campaign(make_campaign("", 0.0, 0, motions, folder))).with_power()
        chances = {name: of.seen / of.twins for name, of in (found.power or {}).items()}
        answer.write_text(json.dumps(chances), encoding="utf-8")
    return json.loads(answer.read_text(encoding="utf-8"))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/plan"))
    parser.add_argument("--each", type=int, default=5, help="campaigns of each effect")
    parser.add_argument("--quick", action="store_true", help="the plan alone, of one motion")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    motions = make_motions()
    if args.quick:
        motions = {"sine_hv": motions["sine_hv"]}
    planned = sw.plan(RIG, [as_planned(name, motion) for name, motion in motions.items()], USUAL)
    print(planned.sentence)
    chances = {c.effect: c for c in planned.planned.of_rig if c.effect in SETTINGS}
    chances |= {c.effect: c for c in planned.planned.chances if (c.effect, c.place) == FAULT}
    power = {} if args.quick else find_power(motions, args.out)
    for effect, c in chances.items():
        said = f"{effect}: {c.value:.3g} {c.unit}, by the plan seen in {c.seen:.0%} and named in {c.named:.0%}"
        if effect in power:
            said += f"; by the power of a campaign named or listed in {power[effect]:.0%}"
        print(said, flush=True)
    done: dict[str, list[dict]] = {effect: [] for effect in chances}
    for number in range(0 if args.quick else args.each):  # every effect once before any twice
        for effect, chance in chances.items():
            done[effect].append(run_one(effect, abs(chance.value), number, motions, args.out))
            said = done[effect]
            named = sum(effect in one["effects"] for one in said)
            seen = sum(bool(one["effects"] or one["minor"]) for one in said)
            there = sum(effect in (*one["effects"], *one["minor"]) for one in said)
            print(f"{effect}: seen in {seen}, named in {named}, named or listed in {there} of {len(said)}", flush=True)


if __name__ == "__main__":
    main()
