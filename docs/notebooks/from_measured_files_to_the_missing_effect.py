# %% [markdown]
# # From measured files to the missing effect
#
# A laboratory has shaken the girder five times. The logger has left a folder of files; nothing else is known. This
# notebook takes files that come with Slipwise, made by a second simulator with one physical effect hidden in it.

# %%
import shutil
import tempfile
from importlib.resources import files
from pathlib import Path

import slipwise as sw

folder = Path(tempfile.mkdtemp()) / "march"
folder.mkdir()
for path in (files("slipwise") / "demo_data").iterdir():
    if path.name.endswith(".parquet"):
        shutil.copy(str(path), folder)
sorted(path.name for path in folder.iterdir())

# %% [markdown]
# `init_campaign` drafts what every command reads: which rig, which columns, which runs may be fitted and which are held
# out. What only a person can know is marked in it.

# %%
print(sw.init_campaign(folder).read_text())

# %% [markdown]
# The draft does not know that two runs are one motion, and how long the pads have rested. That is written by hand; here
# the file that comes with the data says it.

# %%
shutil.copy(str(files("slipwise") / "demo_data" / "campaign.toml"), folder)
session = sw.Session(folder)
session

# %% [markdown]
# The session shows the error of every balance of the rig in multiples of its noise floor: 1 is what a perfect model
# leaves. The numbers of the model are still the rated ones; a fit brings them as near as they come.

# %%
session.fit()
session

# %% [markdown]
# Friction of the pads is several floors off, and so it is in the run that no fit has seen. What is missing?

# %%
found = session.explain()
found

# %% [markdown]
# The verdict has a probability that means what it says. The suggestion is taken over, fitted, and the error falls to
# the floor:

# %%
session.take_suggestion()
session.fit()
session

# %% [markdown]
# `accept` writes the model beside the campaign; `slipwise workbench` on the same folder shows every step of this
# notebook, and can undo it.

# %%
print(session.accept().read_text())
session.close()
