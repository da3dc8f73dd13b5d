"""From a folder of measured runs to the place where the model fails: the flow of `slipwise compare`, cell by cell.

    python scripts/05_campaign.py [--quick] [--out out/campaign]

The campaign is made here by a second simulator that shares nothing with the library, with a breakaway peak hidden in
its friction. Each `# %%` is a cell in an editor that knows notebooks. --quick leaves the replay out.
"""

import argparse
from pathlib import Path

from slipwise.campaign import load_campaign
from slipwise.comparison.compare import compare
from slipwise.comparison.tables import as_json
from slipwise.instruments.checks import check_instruments
from slipwise.record import write_json, write_text
from slipwise.view.pages.compare_page import compare_page
from slipwise.view.recordings.compare_recording import write_compare_recording
from slipwise.view.words.compare_answers import one_minute
from slipwise.view.words.terminal import print_table
from slipwise_benchmarks import make_campaign


def main() -> None:
    """Walk through the flow."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="leave the replay out")
    parser.add_argument("--out", type=Path, default=Path("out/campaign"), help="folder for campaign and results")
    given = parser.parse_args()

    # %% A campaign: a folder with campaign.toml and a file for every run
    folder = given.out / "runs"
    if not (folder / "campaign.toml").exists():
        make_campaign(folder, 13, effects=["breakaway"], size="large", rig="bridge1")
    campaign = load_campaign(folder)
    print_table("Runs", [{"run": r.name, "role": r.role, "samples": len(r.record)} for r in campaign.runs])

    # %% Are the instruments telling the truth? No law of friction takes part
    checks = check_instruments(campaign)
    print(checks.words)

    # %% Fit the base parameters on the fit runs and hold the model against all runs
    found = compare(campaign, checks=checks, system=not given.quick)
    rows = [
        {"component": r, "fitted": found.error(r, held_out=False), "held out": found.error(r, held_out=True)}
        for r in found.relations
    ]
    print_table("Error in multiples of the noise floor", rows)

    # %% The four answers, and where exactly it fails
    for question, answer in one_minute(found):
        print(question, answer)
    for place in found.places:
        print(" -", place.words)

    # %% Every result is a table: found.rows(...), or found.to_pandas(...) where pandas is installed
    named = [c for c in found.rows("cells") if c["above"] and c["kind"] != "frequency"]
    worst = sorted(named, key=lambda c: -c["error"])[:5]
    keys = ("relation", "kind", "label", "low", "high", "error")
    print_table("Worst cells", [{k: c[k] for k in keys} for c in worst])

    # %% The report, the numbers and the recording
    write_text(given.out / "report.html", compare_page(found))
    write_json(given.out / "compare.json", as_json(found))
    write_compare_recording(found, given.out / "compare.rrd")
    print(f"wrote report.html, compare.json and compare.rrd to {given.out}")


if __name__ == "__main__":
    main()
