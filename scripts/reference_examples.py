"""Examples of the API reference, one cell a name; they follow each other, in a folder that holds `my_campaign`.

`tests/contract/test_reference.py` runs them: those that take minutes before a release.
"""

# ruff: noqa: E402, B018, F811
# pyright: reportUnusedExpression=false
# %% base_model
import slipwise as sw

model = sw.base_model("bridge1")  # the paper's law on the reference rig
# %% use
stiffer = model.adding(sw.use("buffer_hardening", gain=0.4))
# %% Model
model.without("shear_rate").setting("contact_area", saturation="0.11 1/MPa")
# %% Effect
sw.use("run_in").effect.to_pandas()  # its parameters as a table
# %% Parameter
strength = sw.use("run_in").effect.parameter("rise")
strength.low, strength.high, strength.unit
# %% quantity
sw.quantity("20 mm", "m", "gap")  # 0.02
# %% load_motion
shaking = sw.load_motion("sine:2Hz,0.3g,cycles=9")  # or files: sw.load_motion(["L.AT2", "T.AT2"])
# %% TableMotion
shaking.duration, shaking.acceleration.shape  # s, (n, 3) m/s^2
# %% pier_top
on_a_pier = sw.pier_top(sw.load_motion("quake:seed=1,peak=0.3g"), "bridge1")
# %% replay
answer = sw.replay(model, shaking)
# %% Replay
answer.record["slip_x"].max()  # m
# %% Record
answer.record.between(1.0, 2.0)["pad_A_N"]  # N
# %% write_record
from pathlib import Path

sw.write_record(answer.record, Path("record.parquet"))
# %% read_record
sw.read_record("record.parquet").time[-1]  # s
# %% SlipwiseError
try:
    sw.base_model("bridge9")
except sw.SlipwiseError as error:
    print(error)  # what was given, what is possible, what to do
# %% SimulationDiverged
try:
    sw.replay("block", sw.load_motion("sine:0.2Hz,9g,cycles=9"))
except sw.SimulationDiverged as error:
    error.replay.record.time[-1]  # s, until when it went well
# %% save_model
sw.save_model(stiffer, "model.toml")
# %% load_model
sw.load_model("model.toml")["buffer_hardening"].values
# %% load_campaign
campaign = sw.load_campaign("my_campaign")
# %% Campaign
[run.name for run in campaign.with_role("holdout")]
# %% init_campaign
import shutil

for file in Path("my_campaign").glob("*.parquet"):  # a folder with nothing but measured files
    Path("fresh").mkdir(exist_ok=True)
    shutil.copy(file, "fresh")
sw.init_campaign("fresh")  # writes fresh/campaign.toml; read it, and decide what is marked in it
# %% audit
checks = sw.audit(campaign)
# %% Checks
checks.words, checks.rows
# %% AuditReport
checks.as_json()["findings"]
# %% corrected_campaign
sw.corrected_campaign(campaign, checks, [])  # names of findings, as the audit prints them
# %% Limits
table = sw.Limits(stroke=0.15, speed=0.8, acceleration=9.81)  # m, m/s, m/s^2
# %% channels
sw.channels.channel("pad_A_Fx").unit  # "N"
# %% motion
[each.name for each in sw.motion.synthetic_motions()]
# %% rig
sw.rig.load_specimen("bridge1").rated_pressure  # Pa
# %% effects
sorted(sw.effects.catalogue())[:3]
# %% campaigns
with_answers = [folder for folder in Path().iterdir() if (folder / "truth.json").is_file()]
# %% ensemble
sw.ensemble.read_scales("0.5:3:0.5")  # (0.5, 1.0, ... 3.0)
# %% paper
sw.paper.PaperSettings().members
# %% executors
one_process_at_a_time = sw.executors.ONE_AT_A_TIME
# %% workbench
open_page = sw.workbench.serve  # open_page("my_campaign") serves a local page until Ctrl-C
# %% plan
planned = sw.plan("bridge1", gauges=["slip_x", "girder_ax", "pad_*_N", "pad_*_Fx"])  # no motions: balances alone
# %% PlannedTest
planned.sentence, planned.as_json()["sets"][0]
# %% export_sap2000
links = sw.export_sap2000("bridge1", motion=shaking)
# %% LinkProperties
links.as_json()["sliders"][0]
# %% export_opensees
script = sw.export_opensees("bridge1", shaking, "rig.py", run=False)  # run=True where OpenSeesPy is installed
# %% OpenSeesExport
script.sentence
# %% watch, News
day = sw.watch("my_campaign", "watch.json")  # `for news in day:` goes on until it is interrupted
# %% consequence (minutes)
meant = sw.consequence(stiffer, ["quake:seed=1", "quake:seed=2"], "meant", without=["buffer_hardening"], workers=1)
# %% Consequence (minutes)
meant.sentence
# %% judge_prediction, PredictionReport (minutes)
shutil.copytree("my_campaign", "of_the_office")  # stands for the same runs as a program predicted them
judged = sw.judge_prediction(campaign, "of_the_office")
judged.sentence
# %% compare (minutes)
comparison = sw.compare(campaign, system=False)
# %% Comparison (minutes)
comparison.worst, comparison.to_pandas("cells")
# %% bearing (minutes)
report = sw.bearing(campaign)
# %% BearingReport (minutes)
report.of("run", report.total)
# %% diagnose (minutes)
found = sw.diagnose(campaign, system=False)
# %% Diagnosis (minutes)
found.sentence, found.verdict.effects, found.verdict.probability
# %% specimens, judge_specimens, SpecimensReport (minutes)
# stands for the diagnoses of two specimens: each has a campaign of its own
together = sw.judge_specimens([sw.specimens.make_specimen(found, name) for name in ("first", "second")])
together.sentence, together.to_pandas()
# %% add_law (minutes)
found = sw.add_law(found)  # leaves a diagnosis as it is that names everything
# %% ladder (minutes)
steps = sw.ladder(campaign, add=["run_in"])
# %% Ladder (minutes)
[step.effects for step in steps.steps]
# %% next_test (minutes)
ranked = sw.next_test(found, table, library=["sine:2Hz,0.3g,cycles=9"])
# %% NextTest (minutes)
[proposal.motion for proposal in ranked.proposals]
# %% add (minutes)
change = sw.add("run_in", campaign)
# %% ModelChange (minutes)
change.rows()  # errors before and after, in noise floors
# %% remove (minutes)
sw.remove("run_in", campaign, change.model)
# %% Session (minutes)
with_steps = sw.Session("my_campaign", resume=False)
with_steps.toggle("run_in")
with_steps.fit()
with_steps.undo()
with_steps.close()
# %% discover (minutes)
law = sw.discover(campaign)
# %% Discovery (minutes)
law.sentence
# %% list_laws, LawList
laws = sw.list_laws(".")
# %% hold_laws_against, LawTests, LawTest (minutes)
tests = sw.hold_laws_against(found, [])  # effects of your files
# %% effects.catalogue
from slipwise import effects

heating = effects.catalogue()["heating"]
# %% effects.find_effect, effects.Effect
heating = effects.find_effect("heating")
# %% effects.skeleton
begun = effects.skeleton("my_effect", "shear")
# %% effects.effect_text, effects.WrittenEffect, effects.WrittenHook
print(effects.effect_text(begun))
# %% effects.write_effect
file = effects.write_effect(begun, Path("my_effects"))
# %% effects.load_effect
mine = effects.load_effect(file)
# %% effects.read_effect
import types

module = types.ModuleType("my_effect")
exec(compile(file.read_text(), str(file), "exec"), vars(module))
effects.read_effect(module, file).name
# %% effects.base_effects
[effect.name for effect in effects.base_effects("law")]
# %% effects.check_name
effects.check_name("my_other_effect")  # raises SettingError for a name that cannot be
# %% effects.check_trusted, effects.Trust
effects.check_trusted(file, Path("model.toml"), trust=[file])
# %% effects.moved_channels
effects.moved_channels(heating, ["pad_A_Fx", "table_ax"])
# %% effects.for_pads
effects.for_pads(effects.find_effect("pad_spread"), ["A", "B"], corners=True).parameter_names
# %% effects.scaled
effects.scaled(heating, lambda unit: 1.0, room=2.0)
# %% effects.scaled_to_gauge
effects.scaled_to_gauge(effects.find_effect("channel_offset"), "slip_x", lambda unit: 1.0)
# %% effects.holding
effects.holding(heating, heating.typical())
# %% effects.GaugeFault, effects.Gauges
effects.find_effect("channel_gain").fault, effects.find_effect("channel_gain").gauges
# %% effects.ForDiagnosis, effects.Rare
heating.diagnosis.signature, heating.rare.exact
# %% effects.Limit
effects.Limit("length", "high", "slide_curvature")
# %% effects.BalanceStates
effects.HOOKS["balance"].inputs["states"]  # a hook `balance` is given one
