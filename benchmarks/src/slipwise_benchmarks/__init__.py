"""A blind bench: a second simulator of the rig that shares nothing with the library, and campaigns made with it.

`slipwise_benchmarks.families` has campaigns that the library's own replay makes too, from the same plans.
"""

from slipwise_benchmarks.bearing import bearing_plan, is_right, make_bearing, radius_error
from slipwise_benchmarks.campaign import Campaign, build_campaign, make_campaign, with_faults
from slipwise_benchmarks.dirty import DirtyCampaign, build_dirty, make_dirty
from slipwise_benchmarks.drawn_rigs import DRAWN
from slipwise_benchmarks.faults import GROUPS, Fault
from slipwise_benchmarks.hidden import INSTRUMENTS, PHYSICS, SIZES, Case, draw, plan
from slipwise_benchmarks.law_campaign import LawCampaign, build_law_campaign, make_law_campaign
from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.rig_ode import Memory, simulate
from slipwise_benchmarks.settings import Settings, random_rig, rated
from slipwise_benchmarks.truth import Truth
from slipwise_benchmarks.write import write_truth

__all__ = [
    "DRAWN",
    "GROUPS",
    "INSTRUMENTS",
    "PHYSICS",
    "SIZES",
    "Campaign",
    "Case",
    "DirtyCampaign",
    "Fault",
    "LawCampaign",
    "Memory",
    "Motion",
    "Settings",
    "Truth",
    "bearing_plan",
    "build_campaign",
    "build_dirty",
    "build_law_campaign",
    "draw",
    "is_right",
    "make_bearing",
    "make_campaign",
    "make_dirty",
    "make_law_campaign",
    "plan",
    "radius_error",
    "random_rig",
    "rated",
    "simulate",
    "with_faults",
    "write_truth",
]
