# %% [markdown]
# # Write an effect
#
# What is not in the catalogue is one file of Python. It is driven, compared, fitted and diagnosed like every other, and
# nothing in Slipwise changes.

# %%
import shutil
import tempfile
from importlib.resources import files
from pathlib import Path

import slipwise as sw

folder = Path(tempfile.mkdtemp()) / "march"
shutil.copytree(str(files("slipwise") / "demo_data"), folder)
own = folder / "fresh_film.py"
own.write_text('''"""A film that is laid down as a pad slides: friction is larger until it is there.

    mu *= 1 + r exp(-s / s_0)

Valid: pads that were cleaned before the first run.
Source: assumed, for a tutorial.
"""

from math import exp

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def shear(shear, memory, extra, distance):
    """Scale the shear strength [Pa] by what the slid path leaves."""
    return shear * (1.0 + extra * exp(-memory[0] / distance))


def advance(speed, dt, memory):
    """Add to the slid path [m]."""
    memory[0] += speed * dt


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("extra", "1", 0.2, -0.5, 2.0, 0.0, "assumed", "r: of a clean pad over one with its film"),
        Parameter("distance", "m", 0.5, 0.01, 10.0, None, "assumed", "s_0: in which the film is laid down"),
    ),
    memory=("slid",),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + r exp(-s/s_0)",
        moves=RESPONSE,
        signature="odd; fades with the path slid; a repeated run shows none of it",
        confused_with={},
    ),
)
''')
effect = sw.effects.find_effect(str(own))
effect.plot()

# %% [markdown]
# The file is checked when it is read: arguments and units, what it may ask for, and that at its neutral value it does
# nothing. In a session it is one more switch.

# %%
session = sw.Session(folder)
session.fit()
session.toggle(str(own))
session.fit()
session

# %%
session.compare_with("bridge1")

# %% [markdown]
# What a fit knows of its numbers, with 95 % intervals:

# %%
{key: (session.state.values[key], known.low, known.high) for key, known in session.state.known.items() if "film" in key}

# %% [markdown]
# Where nobody knows the law, `session.discover()` looks for one in what the model leaves, and writes such a file;
# [the theory](../theory.md) says how.

# %%
session.close()
