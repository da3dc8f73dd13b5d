"""`slipwise bench`: how right the verdicts are on campaigns whose answer is known."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.batch import Wanted, end, run_campaigns, write_together
from slipwise.cli.console import out_folder, print_json, say, say_next
from slipwise.cli.workers import Cluster, Workers


def bench(
    folder: Annotated[
        list[Path],
        typer.Argument(help='Folders of campaigns with their answers: truth.json, {"missing": ["run_in"]}.'),
    ],
    out: Annotated[Path, typer.Option(help="Folder for bench.json and the results of each campaign.")] = Path(
        "out/bench"
    ),
    workers: Workers = None,
    cluster: Cluster = None,
    json: Annotated[bool, typer.Option("--json", help="Print bench.json for a program to read.")] = False,
) -> None:
    """Diagnose campaigns whose answer is known, without looking at it, and score the verdicts.

    Killed and called again with the same `--out`, it goes on where it stopped. A wrong verdict is no error: the exit
    code is 0 when all campaigns were diagnosed.

    Example: `slipwise bench practice --out out/practice`
    """
    from slipwise.view.files import save_json
    from slipwise.view.words.campaign_tables import failure_sentences, rate_rows, score_rows, title
    from slipwise.view.words.terminal import print_table

    campaigns = sw.campaigns.with_truth(folder)
    truths = [sw.campaigns.read_truth(campaign) for campaign in campaigns]
    place = out_folder(out)
    outcomes = run_campaigns(campaigns, place, Wanted(system=False, recording=False), workers, cluster)
    scored = sw.campaigns.score_outcomes(outcomes, truths)
    write_together(outcomes, sw.campaigns.compare_outcomes(outcomes), place)
    content = {
        "schema": 1,
        "rates": {what: list(counts) for what, counts in sw.campaigns.rates(scored).items()},
        "campaigns": [
            {"name": s.outcome.name, "missing": list(s.missing), "right": s.right, **s.outcome.numbers} for s in scored
        ],
    }
    save_json(content, place / "bench.json")
    if json:
        print_json(content)
    else:
        print_table(title(len(scored)), score_rows(scored))
        for words in failure_sentences(outcomes):
            say(words)
        print_table("Score", rate_rows(scored))
        say_next(f"open {place / 'index.html'}, which leads to the page of every campaign")
    end(outcomes)
