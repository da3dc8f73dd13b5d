"""An audit uses a user's own files as it uses the catalogue: faults of gauges, and physics that disturbs balances."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign
from slipwise.effects import Effect, load_effect
from slipwise.instruments.audit import audit
from slipwise.instruments.checks import check_instruments, corrected_campaign

#: A gauge whose output bends: even in what it measures, as no fault of the catalogue is.
BENT_GAUGE = '''"""A gauge whose output bends.

    y = x + c x^2

Valid: 2 |c x| well below 1.
Source: assumed.
"""

import numpy as np

from slipwise.effects import Effect, ForDiagnosis, GaugeFault, Gauges
from slipwise.params import Parameter


def gauge(record, target, bend):
    """Bend the channel."""
    return record.replaced(**{target: record[target] + bend * record[target] ** 2})


def undo(record, target, bend):
    """Take the bend out by iteration."""
    read = record[target]
    true = read.copy()
    for _ in range(8):
        true = read - bend * true**2
    return record.replaced(**{target: true})


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(Parameter("bend", "s^2/m", 5e-3, -0.05, 0.05, 0.0, "assumed", "c: bend"),),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="y = x + c x^2",
        moves=("girder_ax",),
        signature="even in what is measured",
        confused_with={"channel_offset": "an offset is there at rest too"},
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="bends by {size}", settled_by="a turn by 180 degrees", unit="s^2/m", least={"m/s^2": 1e-3}, step=1e-3
        ),
    ),
)
'''
#: A force on the girder along x that grows with the square of slip.
SLOPE = '''"""A force that grows with the square of slip.

    F_x += c u^2

Valid: strokes of some centimetres.
Source: assumed.
"""

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def drag(velocity_x, rise):
    """Never evaluated in an audit, which knows no law."""
    return (rise * velocity_x, 0.0)


def disturb(records):
    """Give the force up to a factor."""
    yield [{"girder_x": [record["slip_x"] ** 2 for record in records]}]


EFFECT = Effect(
    contract=1,
    port="girder",
    parameters=(Parameter("rise", "N/m^2", 1e5, -1e8, 1e8, 0.0, "assumed", "c: rise"),),
    diagnosis=ForDiagnosis(
        component="girder",
        equation="F_x += c u^2",
        moves=RESPONSE,
        signature="even in slip",
        confused_with={"guide_drag": "that follows velocity"},
    ),
)
'''


def own(folder: Path, name: str, text: str) -> Effect:
    path = folder / f"{name}.py"
    path.write_text(text, encoding="utf-8")
    return load_effect(path)


@pytest.fixture
def bent_gauge(tmp_path: Path) -> Effect:
    return own(tmp_path, "bent_gauge", BENT_GAUGE)


@pytest.fixture
def bent(sound: Campaign, bent_gauge: Effect) -> Campaign:
    """The sound campaign as a bent accelerometer would have recorded it."""
    gauge = bent_gauge.hooks["gauge"]
    return sound.with_records({r.name: gauge(r.record, "girder_ax", bend=0.02) for r in sound.runs}, "bent")


def test_a_fault_of_ones_own_is_found_and_corrected(bent: Campaign, bent_gauge: Effect, sound: Campaign) -> None:
    checks = check_instruments(bent, own=[bent_gauge])
    (finding,) = checks.report.findings
    assert finding.name == "bent_gauge:girder_ax"
    assert finding.low < 0.02 < finding.high
    assert "bends by" in finding.words and "180 degrees" in finding.settle_by
    assert "channel_offset" in finding.mistaken_for
    corrected = corrected_campaign(bent, checks, ["bent_gauge"])
    name = sound.runs[0].name
    left, was = (
        np.std(c.run(name).record["girder_ax"] - sound.run(name).record["girder_ax"]) for c in (corrected, bent)
    )
    assert left < 0.1 * was


def test_without_the_file_no_such_fault_is_looked_for(bent: Campaign) -> None:
    assert all(f.what != "bent_gauge" for f in audit(bent).findings)


def test_physics_of_ones_own_takes_the_blame_that_is_its(sound: Campaign, tmp_path: Path) -> None:
    slope = own(tmp_path, "slope", SLOPE)
    records = {
        r.name: r.record.replaced(girder_ax=r.record["girder_ax"] + 400.0 * r.record["slip_x"] ** 2) for r in sound.runs
    }
    report = audit(sound.with_records(records, "pushed"), [slope])
    assert report.findings == () and "slope" in report.physics
