# %% [markdown]
# # A real isolated building
#
# Five storeys on rubber bearings, on a shaking table: accelerations and displacements of six levels, and no gauge
# of force. What does the linear model lack? The records are those of Orozco, Hernandez and Astroza (*physics-
# informed-lstm-base-isolation* on GitHub, commit 202a405, MIT licence; their paper is in Earthquake Engineering &
# Structural Dynamics), three earthquakes at 200 Hz. They do not come with Slipwise: put each record's thirteen
# columns into a table of its own (`CNP100.csv`, `ICA50.csv`, `SP100.csv` with `u`, `a1` to `a6` in m/s^2 and `du`,
# `d1` to `d6` in m), and say where they are.

# %%
import os
import shutil
from pathlib import Path

import slipwise as sw

folder = Path("building")
folder.mkdir()
for name in ("CNP100.csv", "ICA50.csv", "SP100.csv"):
    shutil.copy(Path(os.environ["ISOLATED_BUILDING"]) / name, folder)

# %% [markdown]
# `init_campaign` tells the columns by what they do. The table is the cause that all others answer; a storey's drift
# follows the inertia above it; a displacement is the double integral of one acceleration minus another. In ICA50
# the levels stand in the opposite order, and nobody had written that down.

# %%
draft = sw.init_campaign(folder)
print("\n".join(line[:118] for line in draft.read_text().splitlines()))

# %% [markdown]
# The draft holds ICA50 out: no fit sees it. Masses cannot be told from motions; all levels are drafted as heavy,
# and every force below is known relative to the mass only. Are the gauges right?

# %%
checks = sw.audit(folder)
for line in (*checks.report.notes, *checks.report.contradictions):
    print(line)
checks

# %% [markdown]
# How wrong is the linear layer, fitted to the two other earthquakes?

# %%
sw.compare(folder)

# %% [markdown]
# What is missing?

# %%
found = sw.diagnose(folder)
found

# %% [markdown]
# The error of the girder's balance in the held-out earthquake, with the linear model and with what was named, in
# noise floors:

# %%
found.relations

# %%
found.plot()

# %% [markdown]
# And what a replay from the table's motion alone misses, which no gauge of the building corrects on the way:

# %%
found.system

# %% [markdown]
# What such a campaign cannot tell is said too.

# %%
for line in found.cannot_tell:
    print("-", line)
