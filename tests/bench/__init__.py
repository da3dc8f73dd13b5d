"""A blind bench: a second simulator of the rig that shares nothing with the library, and campaigns made with it.

`bench.families` has campaigns that the library's own replay makes too, from the same plans.
"""

from bench.bearing import bearing_plan, is_right, make_bearing, radius_error
from bench.campaign import Campaign, build_campaign, make_campaign, with_faults
from bench.dirty import DirtyCampaign, build_dirty, make_dirty
from bench.drawn_rigs import DRAWN
from bench.faults import GROUPS, Fault
from bench.hidden import INSTRUMENTS, PHYSICS, SIZES, Case, draw, plan
from bench.law_campaign import LawCampaign, build_law_campaign, make_law_campaign
from bench.motions import Motion
from bench.rig_ode import Memory, simulate
from bench.settings import Settings, random_rig, rated
from bench.truth import Truth
from bench.write import write_truth

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
