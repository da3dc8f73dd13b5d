# %% [markdown]
# # Replay an earthquake
#
# A girder of 10 t lies on four PTFE pads and four rubber buffers on a shaking table, the rig of Takahashi et al.
# (2004). What does it do in an earthquake, and what in the same earthquake with vertical motion?

# %%
import slipwise as sw

motion = sw.load_motion("quake:seed=1,peak=0.7g,vertical=0.3g")
motion.plot()

# %% [markdown]
# A motion may as well be a file of a strong-motion network (`sw.load_motion("record.at2")`); `slipwise motions` lists
# what is read. The replay is one call. MuJoCo moves the girder; friction comes from the paper's law, pad by pad.

# %%
both = sw.replay("bridge1", "quake:seed=1,peak=0.7g,vertical=0.3g")
both.plot()

# %% [markdown]
# What an engineer reads off, with the vertical motion and without it:

# %%
along = sw.replay("bridge1", "quake:seed=1,peak=0.7g")
for words, found in (("with vertical motion", both), ("without", along)):
    slip, energy = 1e3 * found.largest_slip, sum(found.pad_energy.values())
    load = 1e-3 * max(high for _, high in found.load_range.values())
    print(f"{words:22s} peak slip {slip:5.1f} mm   energy {energy:6.0f} J   load {load:5.1f} kN")

# %% [markdown]
# An effect is added to the model by its name. New pads have more friction than pads that have slid for a while:

# %%
model = sw.base_model("bridge1").adding(sw.use("run_in", rise=0.3))
sw.replay(model, "quake:seed=1,peak=0.7g,vertical=0.3g")

# %% [markdown]
# `sw.effects.catalogue()` lists the others, and any of them shows itself:

# %%
sw.effects.catalogue()["run_in"].plot()
