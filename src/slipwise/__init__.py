"""Slipwise: which physical effect does the model of a structure on sliding bearings lack?

Everything that the command line does is here too:

    import slipwise as sw

    measured = sw.load_campaign("campaigns/march")
    sw.audit(measured)                  # do the instruments tell the truth?
    sw.compare(measured)                # where does the model fail?
    found = sw.diagnose(measured)       # which effect does it lack?
    found.plot()
    sw.replay("bridge1", "quake:seed=1,peak=0.7g,vertical=0.3g").to_pandas()

Names are loaded when they are first used, so that the import itself costs nothing.
"""

from importlib import import_module

#: As type checkers know it. `typing` is not imported here: it takes `re` and others, which may be those of the current
#: folder until `python -m slipwise` has left that out.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any

    from slipwise import channels, effects, motion, rig, specimens, workbench
    from slipwise.bearings.judge import judge_bearing as bearing
    from slipwise.bearings.result import BearingReport
    from slipwise.campaign import Campaign, load_campaign
    from slipwise.campaign.draft import init_campaign
    from slipwise.comparison.compare import compare
    from slipwise.comparison.result import Comparison
    from slipwise.design.motions import Limits
    from slipwise.design.next_test import NextTest, next_test
    from slipwise.diagnosis.ladder import Ladder, ladder
    from slipwise.diagnosis.result import Diagnosis
    from slipwise.discovery.discover import add_law, discover
    from slipwise.discovery.discover import diagnose_with_law as diagnose
    from slipwise.discovery.law_list import LawList, list_laws
    from slipwise.discovery.law_test import LawTest, LawTests, hold_laws_against
    from slipwise.discovery.result import Discovery
    from slipwise.effects import Effect
    from slipwise.errors import SlipwiseError
    from slipwise.export.opensees import OpenSeesExport, export_opensees
    from slipwise.export.sap2000 import LinkProperties, export_sap2000
    from slipwise.instruments.checks import Checks, corrected_campaign
    from slipwise.instruments.checks import check_instruments as audit
    from slipwise.instruments.report import AuditReport
    from slipwise.jobs import executors
    from slipwise.model import Model, base_model, use
    from slipwise.model.file import load_model, save_model
    from slipwise.monitoring.watch import News, watch
    from slipwise.motion import TableMotion, load_motion
    from slipwise.params import Parameter
    from slipwise.planning.plan import plan
    from slipwise.planning.result import PlannedTest
    from slipwise.prediction.judge import judge_prediction
    from slipwise.prediction.result import PredictionReport
    from slipwise.record import Record, read_record, write_record
    from slipwise.session.model_change import ModelChange, add, remove
    from slipwise.session.session import Session
    from slipwise.simulation.pier import pier_top
    from slipwise.simulation.replay import replay
    from slipwise.simulation.simulator import Replay, SimulationDiverged
    from slipwise.specimens.judge import judge_specimens
    from slipwise.specimens.result import SpecimensReport
    from slipwise.studies import campaigns, ensemble, paper
    from slipwise.studies.consequence.judge import judge_consequence as consequence
    from slipwise.studies.consequence.result import Consequence
    from slipwise.units import quantity

    __version__: str

#: Name -> the module that holds it, and its name there; a name without one is that module.
_PLACES: dict[str, tuple[str, str]] = {
    "Model": ("model", "Model"),
    "base_model": ("model", "base_model"),
    "use": ("model", "use"),
    "load_model": ("model.file", "load_model"),
    "save_model": ("model.file", "save_model"),
    "load_motion": ("motion", "load_motion"),
    "pier_top": ("simulation.pier", "pier_top"),
    "replay": ("simulation.replay", "replay"),
    "init_campaign": ("campaign.draft", "init_campaign"),
    "load_campaign": ("campaign", "load_campaign"),
    "audit": ("instruments.checks", "check_instruments"),
    "consequence": ("studies.consequence.judge", "judge_consequence"),
    "corrected_campaign": ("instruments.checks", "corrected_campaign"),
    "bearing": ("bearings.judge", "judge_bearing"),
    "compare": ("comparison.compare", "compare"),
    "add_law": ("discovery.discover", "add_law"),
    "diagnose": ("discovery.discover", "diagnose_with_law"),
    "discover": ("discovery.discover", "discover"),
    "hold_laws_against": ("discovery.law_test", "hold_laws_against"),
    "list_laws": ("discovery.law_list", "list_laws"),
    "LawList": ("discovery.law_list", "LawList"),
    "LawTest": ("discovery.law_test", "LawTest"),
    "LawTests": ("discovery.law_test", "LawTests"),
    "export_opensees": ("export.opensees", "export_opensees"),
    "export_sap2000": ("export.sap2000", "export_sap2000"),
    "ladder": ("diagnosis.ladder", "ladder"),
    "add": ("session.model_change", "add"),
    "remove": ("session.model_change", "remove"),
    "next_test": ("design.next_test", "next_test"),
    "plan": ("planning.plan", "plan"),
    "watch": ("monitoring.watch", "watch"),
    "judge_specimens": ("specimens.judge", "judge_specimens"),
    "judge_prediction": ("prediction.judge", "judge_prediction"),
    "read_record": ("record", "read_record"),
    "write_record": ("record", "write_record"),
    "quantity": ("units", "quantity"),
    "AuditReport": ("instruments.report", "AuditReport"),
    "BearingReport": ("bearings.result", "BearingReport"),
    "Campaign": ("campaign", "Campaign"),
    "Checks": ("instruments.checks", "Checks"),
    "Comparison": ("comparison.result", "Comparison"),
    "Consequence": ("studies.consequence.result", "Consequence"),
    "Diagnosis": ("diagnosis.result", "Diagnosis"),
    "Discovery": ("discovery.result", "Discovery"),
    "Effect": ("effects", "Effect"),
    "Ladder": ("diagnosis.ladder", "Ladder"),
    "Limits": ("design.motions", "Limits"),
    "LinkProperties": ("export.sap2000", "LinkProperties"),
    "ModelChange": ("session.model_change", "ModelChange"),
    "News": ("monitoring.watch", "News"),
    "NextTest": ("design.next_test", "NextTest"),
    "OpenSeesExport": ("export.opensees", "OpenSeesExport"),
    "Parameter": ("params", "Parameter"),
    "PlannedTest": ("planning.result", "PlannedTest"),
    "PredictionReport": ("prediction.result", "PredictionReport"),
    "Record": ("record", "Record"),
    "Replay": ("simulation.simulator", "Replay"),
    "Session": ("session.session", "Session"),
    "SimulationDiverged": ("simulation.simulator", "SimulationDiverged"),
    "SlipwiseError": ("errors", "SlipwiseError"),
    "SpecimensReport": ("specimens.result", "SpecimensReport"),
    "TableMotion": ("motion", "TableMotion"),
    "campaigns": ("studies.campaigns", ""),
    "channels": ("channels", ""),
    "effects": ("effects", ""),
    "ensemble": ("studies.ensemble", ""),
    "executors": ("jobs.executors", ""),
    "motion": ("motion", ""),
    "paper": ("studies.paper", ""),
    "rig": ("rig", ""),
    "specimens": ("specimens", ""),
    "workbench": ("workbench", ""),
}

__all__ = [
    "AuditReport",
    "BearingReport",
    "Campaign",
    "Checks",
    "Comparison",
    "Consequence",
    "Diagnosis",
    "Discovery",
    "Effect",
    "Ladder",
    "LawList",
    "LawTest",
    "LawTests",
    "Limits",
    "LinkProperties",
    "Model",
    "ModelChange",
    "News",
    "NextTest",
    "OpenSeesExport",
    "Parameter",
    "PlannedTest",
    "PredictionReport",
    "Record",
    "Replay",
    "Session",
    "SimulationDiverged",
    "SlipwiseError",
    "SpecimensReport",
    "TableMotion",
    "__version__",
    "add",
    "add_law",
    "audit",
    "base_model",
    "bearing",
    "campaigns",
    "channels",
    "compare",
    "consequence",
    "corrected_campaign",
    "diagnose",
    "discover",
    "effects",
    "ensemble",
    "executors",
    "export_opensees",
    "export_sap2000",
    "hold_laws_against",
    "init_campaign",
    "judge_prediction",
    "judge_specimens",
    "ladder",
    "list_laws",
    "load_campaign",
    "load_model",
    "load_motion",
    "motion",
    "next_test",
    "paper",
    "pier_top",
    "plan",
    "quantity",
    "read_record",
    "remove",
    "replay",
    "rig",
    "save_model",
    "specimens",
    "use",
    "watch",
    "workbench",
    "write_record",
]


def __getattr__(name: str) -> "Any":
    """Load a name where it lives (PEP 562); nothing is kept here, so that a patch at its home is seen here too."""
    if name == "__version__":
        from importlib.metadata import version

        return version("slipwise")
    if name not in _PLACES:
        raise AttributeError(f"module 'slipwise' has no attribute {name!r}; it has: {', '.join(__all__)}")
    place, inside = _PLACES[name]
    module = import_module(f"slipwise.{place}")
    return getattr(module, inside) if inside else module


def __dir__() -> list[str]:
    """Return the names, for completion in a notebook."""
    return sorted(__all__)
