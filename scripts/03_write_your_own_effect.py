"""Write an effect of your own in one file, and watch it work everywhere.

A laboratory finds that friction falls a little whenever the load grows *quickly*: the contact area follows the load
late. That is not in the catalogue. This script writes the law into one file, drives it with a known motion, shakes the
rig with it, shows what it does to a loop, and puts it into a model.toml. It needs no change in Slipwise.

`slipwise effects --new my_effect` writes a file that works, to begin one of your own with; for a law of friction, or of
any other port with `--port`. What follows is such a file after its author has made it his own.

    python scripts/03_write_your_own_effect.py [--out DIR] [--quick]
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

from slipwise.effects import load_effect
from slipwise.errors import SettingError
from slipwise.model import base_model, use
from slipwise.model.file import load_model, save_model
from slipwise.simulation.kernel import engine_for
from slipwise.simulation.predict import predictor
from slipwise.simulation.simulator import simulate
from slipwise.view.figures.canvas import save_figure
from slipwise.view.figures.effect_picture import effect_picture
from slipwise.view.figures.style import styled
from slipwise.view.words.effects import print_effect

# 1. The file. A docstring that a reader learns from, hooks whose arguments say what they need, and EFFECT. What hooks
# cannot say is declared: without a changing load this effect is one with the base law, so a diagnosis must not try it.
LATE_AREA = '''"""A contact area that follows the load late.

    A_r = A_r(P_late),        dP_late/dt = (P - P_late) / t_c

PTFE creeps: pressed harder, it takes a moment to fill the valleys of the steel. While the load grows the contact is
still too small, and friction too low.

Valid: t_c below the period of the vertical motion.
Source: assumed, for a tutorial.
"""

from math import exp

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def area(real_area, load, memory, time_constant, strength):
    """Scale the real area [m^2] by how far the late load is behind."""
    if memory[1] == 0.0 or load <= 0.0:
        return real_area
    return real_area * (1.0 + strength * (memory[0] / load - 1.0))


def advance(load, dt, memory, time_constant):
    """Let the late load follow; exact while the load is constant."""
    if memory[1] == 0.0:
        memory[0], memory[1] = load, 1.0
    memory[0] += (load - memory[0]) * (1.0 - exp(-dt / time_constant))


def rest(memory, seconds):
    """After a pause the contact starts anew."""
    memory[1] = 0.0


EFFECT = Effect(
    contract=1,
    port="area",
    parameters=(
        Parameter("strength", "1", 0.3, 0.0, 1.0, 0.0, "assumed", "share of the area that creeps"),
        Parameter("time_constant", "s", 0.03, 1e-3, 1.0, None, "assumed", "t_c: of creep", "ms"),
    ),
    memory=("late_load", "started"),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="A_r lags behind N by t_c",
        moves=RESPONSE,
        signature="odd in velocity, in step with the rate of the load",
        confused_with={"channel_delay": "a delay of N shows in the heave balance too"},
        needs=("changing load",),
    ),
)
'''


def main() -> None:
    """Run the tutorial."""
    parser = argparse.ArgumentParser(description="Write an effect of your own in one file.")
    parser.add_argument("--out", type=Path, default=Path("out/own_effect"))
    parser.add_argument("--quick", action="store_true", help="shake for half a second only")
    settings = parser.parse_args()
    settings.out.mkdir(parents=True, exist_ok=True)
    path = settings.out / "late_area.py"
    path.write_text(LATE_AREA, encoding="utf-8")

    # 2. Reading it checks the contract: units, bounds, a neutral value, hooks that the port can have.
    effect = load_effect(path)
    print_effect(effect)
    with tempfile.TemporaryDirectory() as folder:
        broken = Path(folder) / "no_unit.py"
        broken.write_text(LATE_AREA.replace('"time_constant", "s"', '"time_constant", ""'), encoding="utf-8")
        try:
            load_effect(broken)
        except Exception as error:  # a tutorial shows what a user would see
            print("A file that breaks the contract is told so:\n  ", error, "\n")

    # 3. Component level: the law driven by a load, a speed and a slip that we choose.
    model = base_model("bridge1").adding(use(effect))
    engine = engine_for([effect])  # "python" for a law that cannot be compiled, and a warning that says so
    time = np.arange(0.0, 1.0, 0.001)
    load = np.repeat(24.5e3 * (1.0 + 0.4 * np.sin(2 * np.pi * 5.0 * time))[:, None], 4, axis=1)
    velocity = np.zeros((len(time), 4, 2))
    velocity[:, :, 0] = 0.2
    slip = np.cumsum(velocity, axis=0) * 0.001
    forces = [
        predictor(m, engine=engine).pads(time, load, velocity, slip).force for m in (base_model("bridge1"), model)
    ]
    print(f"Component level: at most {np.abs(forces[1] - forces[0]).max():.0f} N of {forces[0].max():.0f} N differ.")

    # 4. System level: the same text in the step of the simulation, neutral to the last bit when it is off.
    shake = np.zeros((1000 if settings.quick else 8000, 3))
    step = 5e-4 * np.arange(len(shake))
    shake[:, 0] = 4.0 * np.clip(step / 1.0, 0.0, 1.0) * np.sin(2 * np.pi * 2.0 * step)
    shake[:, 2] = 3.0 * np.sin(2 * np.pi * 5.0 * step)
    off = base_model("bridge1").adding(use(effect, strength=0.0))
    records = [simulate(m, shake, engine=engine).record for m in (base_model("bridge1"), off, model)]
    if not np.array_equal(records[0]["slip_x"], records[1]["slip_x"]):
        raise SettingError("the neutral effect changed the simulation")
    change = np.abs(records[2]["slip_x"] - records[0]["slip_x"]).max()
    print(
        f"System level: slip changes by at most {change * 1e3:.3f} mm of {np.ptp(records[0]['slip_x']) * 1e3:.1f} mm."
    )

    # 5. A picture, and a model file that names it.
    with styled():
        picture = save_figure(effect_picture(effect), settings.out / "late_area.png")
    file = settings.out / "model.toml"
    save_model(base_model("bridge1").adding(use(effect, time_constant="50 ms")), file)
    print(f"{file} now holds {', '.join(u.label for u in load_model(file, trust=[path]).uses)}. Picture: {picture}")
    print(f"Use it: slipwise replay sine:2Hz,0.3g --effect {path} --out out/with_it")


if __name__ == "__main__":
    main()
