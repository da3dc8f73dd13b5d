"""Plant wild samples and wrong units in recorded campaigns: are they found, and does anything else change?

    python scripts/14_wild_samples.py [--wild 200] [--units 40] [--seed 1] [--out out/wild] [--quick]

Campaigns of the second simulator of `benchmarks` are audited as they are, and again with one burst of 1 to 20 samples
in one channel, 3 to 10^9 times its range. A planting counts as right where exactly these samples are marked, the
findings are those of the sound campaign, the noise of every gauge stays within 5 % and what the balances leave within
10 %. Then single columns are multiplied by powers of ten, 9.81, 4.448, 25.4 or their inverses: right is a finding that
names channel and factor, and accuses nobody else.
"""

import argparse
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, as_campaign
from slipwise.errors import SlipwiseWarning
from slipwise.instruments.audit import audit
from slipwise.instruments.report import AuditReport
from slipwise.record import write_json
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign as in_memory

#: Seeds of the campaigns, and what is hidden in each; None: drawn.
CAMPAIGNS: dict[int, tuple[str, ...] | None] = {
    201: (), 202: (), 205: None, 207: ("buffer_hardening",), 208: ("girder_bending",), 210: None,
}  # fmt: skip
FACTORS = (1e-6, 1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3, 1e6, 9.80665, 1 / 9.80665, 4.448222, 1 / 4.448222, 25.4, 1 / 25.4)
#: Runs of each: audits of more take longer and show the same.
RUNS = 2
#: The noise of a gauge, and what a balance leaves, may change by these shares [1].
NOISE, LEFT = 0.05, 0.1


@dataclass(frozen=True)
class Sound:
    """A campaign without wild samples, and its audit."""

    campaign: Campaign
    report: AuditReport


def made(quick: bool) -> list[Sound]:
    """Make the campaigns and audit them."""
    seeds = list(CAMPAIGNS)[: 1 if quick else None]
    campaigns = [in_memory(build_campaign(seed, effects=CAMPAIGNS[seed])) for seed in seeds]
    campaigns = [replace(campaign, runs=campaign.runs[:RUNS]) for campaign in campaigns]
    return [Sound(campaign, audit(campaign)) for campaign in campaigns]


def burst(rng: np.random.Generator, count: int) -> np.ndarray:
    """Draw a burst (count,) over the range of its channel: of one value, of random signs, or of random sizes."""
    size, sign = 10.0 ** rng.uniform(np.log10(3.0), 9.0), rng.choice([-1.0, 1.0], count)
    kinds = (np.full(count, size) * sign[0], size * sign, 10.0 ** rng.uniform(np.log10(3.0), 9.0, count) * sign)
    return kinds[int(rng.integers(len(kinds)))]


def with_channel(campaign: Campaign, run: str, name: str, values: np.ndarray) -> Campaign:
    """Give a campaign with another channel in one run."""
    return replace(
        campaign,
        runs=tuple(
            replace(r, record=r.record.replaced(**{name: values})) if r.name == run else r for r in campaign.runs
        ),
    )


def findings(report: AuditReport) -> list[str]:
    """Give the names of an audit's findings."""
    return sorted(finding.name for finding in report.findings)


def changed(sound: Sound, campaign: Campaign, now: AuditReport) -> tuple[float, float]:
    """Give the largest change of a gauge's noise, and of what a balance that may accuse leaves [1]."""
    after = {b.relation: b.floor * b.left for b in now.balances}
    telling = [b for b in sound.report.balances if not b.relation.startswith(("rest_", "pair_"))]
    gauges = campaign.gauges
    noise = [abs(np.log(gauges[n].level / g.level)) for n, g in sound.campaign.gauges.items() if g.level > 0.0]
    return float(max(noise)), float(max(abs(np.log(after[b.relation] / (b.floor * b.left))) for b in telling))


def wild(campaigns: list[Sound], count: int, rng: np.random.Generator) -> Iterator[tuple[bool, str]]:
    """Plant bursts, and say of each whether all is right, and what was planted."""
    for i in range(count):
        sound = campaigns[i % len(campaigns)]
        run = sound.campaign.runs[int(rng.integers(len(sound.campaign.runs)))]
        name = str(rng.choice(list(run.record.channels)))
        length = int(rng.integers(1, 21))
        at = slice(start := int(rng.integers(0, len(run.record) - length + 1)), start + length)
        values = run.record[name].copy()
        values[at] += burst(rng, length) * np.ptp(values)
        planted = with_channel(sound.campaign, run.name, name, values)
        marked = as_campaign(planted)
        marks = {(r.name, w.channel): np.flatnonzero(w.bad) for r in marked.runs for w in r.wild}
        found = list(marks) == [(run.name, name)] and np.array_equal(marks[run.name, name], np.r_[at])
        report = audit(marked)
        same, (noise, left) = findings(report) == findings(sound.report), changed(sound, marked, report)
        words = f"{length} samples of {name} from {start} of {len(values)}: found {found}, accused {findings(report)}, "
        good = bool(found and same and noise < NOISE and left < LEFT)
        yield good, f"{words}noise changed by {noise:.3f}, balances by {left:.3f}"


def units(campaigns: list[Sound], count: int, rng: np.random.Generator) -> Iterator[tuple[bool, str]]:
    """Multiply columns, and say of each whether it is named alone, and what was done."""
    for i in range(count):
        sound = campaigns[i % len(campaigns)]
        name, factor = str(rng.choice(list(sound.campaign.runs[0].record.channels))), float(rng.choice(FACTORS))
        planted = sound.campaign
        for run in planted.runs:
            planted = with_channel(planted, run.name, name, factor * run.record[name])
        report = audit(planted)
        own = [f for f in report.findings if f.of_samples and f.of_samples.kind == "scaled" and f.channel == name]
        right = len(own) == 1 and abs((1.0 + own[0].size) / factor - 1.0) < 2e-3
        others = {f.name for f in report.findings if f not in own} - set(findings(sound.report))
        yield right and not others, f"{name} times {factor:.4g}: {[f.words for f in report.findings]}"


def main() -> None:
    """Plant, count and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wild", type=int, default=200)
    parser.add_argument("--units", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("out/wild"))
    parser.add_argument("--quick", action="store_true")
    given = parser.parse_args()
    warnings.simplefilter("ignore", SlipwiseWarning)
    campaigns, rng = made(given.quick), np.random.default_rng(given.seed)
    told: dict[str, dict[str, object]] = {}
    for what, results, count in (("wild samples", wild, given.wild), ("units", units, given.units)):
        count = 2 if given.quick else count
        wrong = [words for good, words in results(campaigns, count, rng) if not good]
        for words in wrong:
            print(f"wrong: {words}")
        print(f"{what}: {count - len(wrong)} of {count} right", flush=True)
        told[what] = {"planted": count, "right": count - len(wrong), "wrong": wrong}
    given.out.mkdir(parents=True, exist_ok=True)
    write_json(given.out / "wild_samples.json", {"seed": given.seed, **told})


if __name__ == "__main__":
    main()
