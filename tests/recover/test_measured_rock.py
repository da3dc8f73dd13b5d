"""A measured record of a slider: what is known of it is named."""

import shutil

import pytest

from shaking import needs_shared
from slipwise.campaign import load_campaign
from slipwise.diagnosis.diagnose import diagnose

pytestmark = pytest.mark.long

ROCK = """name = "rock basalt"
rig = "pad"
[specimen]
pad_radius = "28.2 mm"
[columns]
"Time(s)" = { channel = "time", unit = "s" }
"Displ(microns)" = { channel = "slip_x", unit = "um" }
"Friction" = { channel = "pad_A_Fx", unit = "1" }
"Normal_stress(MPa)" = { channel = "pad_A_P", unit = "MPa" }
[[run]]
file = "run.txt"
role = "fit"
"""


def test_rate_and_state_of_rock_is_named_with_the_constants_of_another_fit(tmp_path):
    """Ruina's slip law with a machine in series, fitted apart from the library, gave a = 0.0087 and b = 0.0090.

    Part of the direct effect goes to the base law's own growth with speed, which one step of speed cannot tell apart:
    what is left of it is positive, and no more than that.
    """
    shutil.copy(needs_shared("friction", "rock_basalt", "run.txt"), tmp_path)
    (tmp_path / "campaign.toml").write_text(ROCK)
    found = diagnose(load_campaign(tmp_path))
    assert "rate_and_state" in found.verdict.effects
    assert found.base_error > 1.5 and found.final_error < 1.3
    sizes = found.candidates[0].parameters
    assert 0.0 < sizes["rate_and_state.direct"].low and sizes["rate_and_state.direct"].value < 0.0087
    assert sizes["rate_and_state.state"].low < 0.0090 < sizes["rate_and_state.state"].high
