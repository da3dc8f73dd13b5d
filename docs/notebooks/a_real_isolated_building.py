# %% [markdown]
# # A real isolated building
#
# Five storeys on rubber bearings, shaken on a table: accelerations and displacements of six levels, and no gauge of
# force anywhere. Which effect does the linear model lack?
#
# The records are public: Orozco, Hernandez and Astroza, *physics-informed-lstm-base-isolation* (GitHub, MIT licence).
# They are not part of Slipwise; [A real isolated building](../isolated_building.md) says where to find them and which
# columns they need. `ISOLATED_BUILDING` is the folder with the three files.

# %%
import os
import shutil
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import slipwise as sw

folder = Path(tempfile.mkdtemp()) / "building"
folder.mkdir()
for path in sorted(Path(os.environ["ISOLATED_BUILDING"]).glob("*.csv")):
    shutil.copy(path, folder)
sorted(path.name for path in folder.iterdir())

# %% [markdown]
# `init_campaign` tells the columns by what they do: the table is the cause that the others answer, each storey is
# driven by the one below, a displacement is the double integral of the difference of two accelerations. In ICA50 the
# levels stand in the opposite order; that file gets columns of its own.

# %%
written = sw.init_campaign(folder)
print(written.read_text())

# %% [markdown]
# Two earthquakes are fitted. The third is held out: no fit sees it.

# %%
text = written.read_text().replace('role = "holdout"', 'role = "fit"')
before, after = text.split('file = "ICA50.csv"')
written.write_text(before + 'file = "ICA50.csv"' + after.replace('"fit"', '"holdout"', 1))
sw.audit(folder)

# %% [markdown]
# No gauge is accused. How wrong is the linear model of the layer of bearings? Its force is the sum of mass times
# acceleration of everything above it.

# %%
compared = sw.compare(folder)
compared

# %% [markdown]
# What is missing? Everything of the catalogue competes, small imperfections are always in the model, and what is
# proposed is refitted and replayed.

# %%
found = sw.diagnose(folder)
found

# %% [markdown]
# The force of all bearings over the displacement of the base, in the earthquake that no fit has seen: measured, with
# the linear model, and with what was named. It is the sum of mass times acceleration; what the balance of the base
# leaves is what the model's force is off. The masses of the six levels are drafted alike, so forces are per mass.

# %%
session = sw.Session(folder)
session.fit()
linear = session.series("ICA50", "girder")
sw.add(found, session)
named = session.series("ICA50", "girder")

record = next(run.record for run in session.campaign.runs if run.name == "ICA50")
levels = ["girder_ax", *(f"storey_{number}_ax" for number in range(1, 6))]
force = -np.mean([np.interp(named.time, record.time, record[level]) for level in levels], axis=0)
slip = 1e3 * np.interp(named.time, record.time, record["slip_x"])

figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), sharex=True, sharey=True)
for axis, series, title in zip(axes, (linear, named), ("linear layer", "with what was named"), strict=True):
    off = series.residual[:, 0] / len(levels)
    axis.plot(slip, force, color="0.6", linewidth=0.8, label="measured")
    axis.plot(slip, force + off, linewidth=0.8, label="model")
    axis.set(title=f"{title}: {100 * np.std(off) / np.std(force):.0f} % left", xlabel="base over table [mm]")
axes[0].set_ylabel("force of all bearings over mass [m/s²]")
_ = axes[0].legend()

# %% [markdown]
# The session has both fits as steps: errors in noise floors, of the fitted runs and of the one that no fit has seen.

# %%
session
