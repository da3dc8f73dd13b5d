"""The whole paper re-enacted from Python, with one assumption changed at the end.

    python scripts/06_paper.py [--quick] [--out out/paper]

`slipwise paper --out DIR` does the same from the command line. Finished replays are kept in DIR: a run that was killed
goes on where it stopped.
"""

import argparse
from dataclasses import replace
from pathlib import Path

from slipwise.record import write_json
from slipwise.studies.paper import PaperSettings, as_json, change, reenact
from slipwise.studies.paper.law import mu
from slipwise.studies.paper.settings import paper_model
from slipwise.view.pages.paper_page import write_page


def main() -> None:
    """Run, print the verdicts, keep the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/paper"))
    parser.add_argument("--quick", action="store_true", help="a few motions only")
    chosen = parser.parse_args()
    settings = replace(PaperSettings(), members=6 if chosen.quick else 200)

    result = reenact(settings, chosen.out, quick=chosen.quick)
    for study in result.studies:
        print(f"\n{study.title}")
        for finding in study.findings:
            print(f"  {finding.verdict:18s} {finding.place}: {finding.gets}")
    write_json(chosen.out / "paper.json", as_json(result))
    page = write_page(result, chosen.out / "paper.html")
    print(f"\n{result.replays} replays, {result.seconds:.0f} s, {page}")

    # A sceptic's question: what if n is in s/mm?
    for unit in ("s/cm", "s/mm"):
        model = paper_model("bridge1", change(settings, [f"n_unit={unit}"]))
        speeds = ", ".join(f"{100 * v:.0f} cm/s {float(mu(model, 16.88e6, v)):.4f}" for v in (0.01, 0.05, 0.2))
        print(f"n in {unit}: mu at 16.9 MPa = {speeds}")


if __name__ == "__main__":
    main()
