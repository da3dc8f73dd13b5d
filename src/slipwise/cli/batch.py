"""`slipwise diagnose A B C ...`: each campaign as by itself, a table of all, what is common and what differs."""

import sys
import traceback
import warnings
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import typer

import slipwise as sw
from slipwise.cli.console import ERR, counting, out_folder, print_json, say, say_next
from slipwise.cli.diagnosis_files import write_diagnosis
from slipwise.cli.options import own_effects, start_model
from slipwise.cli.workers import chosen_executor
from slipwise.errors import InputError, SettingError, SlipwiseError, SlipwiseWarning, visible


@dataclass(frozen=True)
class Wanted:
    """What is asked of every campaign.

    Attributes:
        model: a model.toml to start from; the one beside campaign.toml if there is one.
        effects: own effects that compete too, by their files.
        trust: run the effect files that model.toml names.
        system: replay the models as well.
        recording: write it.
    """

    model: Path | None = None
    effects: tuple[str, ...] = ()
    trust: bool = False
    system: bool = True
    recording: bool = True


@dataclass(frozen=True)
class Job:
    """One campaign, and the folder for its results; paths are absolute, for a worker stands elsewhere."""

    campaign: Path
    out: Path
    wanted: Wanted


def diagnose_folder(job: Job) -> dict[str, Any]:
    """Diagnose one campaign and write its results; one that fails is a result too, "failed" says why."""
    with sw.executors.ONE_AT_A_TIME, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", SlipwiseWarning)
        try:
            numbers = _diagnosed(job)
        except SlipwiseError as error:
            numbers = {"failed": str(error)}
        except Exception as error:  # of one campaign out of a hundred the others must not hear
            numbers = {"failed": f"{type(error).__name__}: {error}", "traceback": traceback.format_exc()}
        told = [str(w.message) for w in caught if issubclass(w.category, SlipwiseWarning)]
    return {**numbers, "folder": job.out.name, "warnings": told}


def _diagnosed(job: Job) -> dict[str, Any]:
    wanted, effects = job.wanted, list(job.wanted.effects)
    measured = sw.load_campaign(job.campaign)
    start = start_model(job.campaign, wanted.model, wanted.trust, effects)
    found = sw.diagnose(measured, start, own=own_effects(effects, start), system=wanted.system)
    write_diagnosis(found, out_folder(job.out), wanted.recording and measured.specimen.free)
    weighed = found.search.weighed is not None
    if weighed:
        sw.specimens.write_specimen(sw.specimens.make_specimen(found, job.out.name), job.out / "specimen.npz")
    return {**sw.campaigns.numbers_of(found), "weighed": weighed}


def run_campaigns(
    campaigns: Sequence[Path], folder: Path, wanted: Wanted, workers: int | None, cluster: str | None
) -> "list[sw.campaigns.Outcome]":
    """Diagnose those campaigns that have not been diagnosed yet, and write what they are together.

    Raises:
        SettingError: a campaign is given twice.
    """
    home = folder.resolve()
    names = _names(campaigns)
    jobs = [Job(campaign.resolve(), home / name, wanted) for campaign, name in zip(campaigns, names, strict=True)]
    settings = [*wanted.effects, wanted.trust, wanted.system, wanted.recording]
    own = [Path(name) for name in wanted.effects]
    keys = [sw.campaigns.campaign_key(j.campaign, wanted.model, own, [j.out.name, *settings]) for j in jobs]

    def lasting(numbers: dict[str, Any]) -> bool:
        if "failed" in numbers:
            return False
        names = ("diagnosis.json", "report.html", *(["specimen.npz"] if numbers["weighed"] else []))
        return all((home / numbers["folder"] / name).is_file() for name in names)

    with chosen_executor(cluster) as executor, counting("campaigns") as tell:
        finished = sw.executors.run_all(
            diagnose_folder, keys, jobs.__getitem__, home / "campaigns.jsonl",
            executor=executor, workers=workers, progress=tell, lasting=lasting,
        )  # fmt: skip
    pairs = zip(names, finished.numbers(keys), strict=True)
    outcomes = [sw.campaigns.Outcome(name, numbers) for name, numbers in pairs]
    for outcome in outcomes:
        for words in outcome.numbers["warnings"]:
            print(f"warning: {visible(f'{outcome.name}: {words}')}", file=sys.stderr)
    return outcomes


def diagnose_many(
    campaigns: Sequence[Path], out: Path, wanted: Wanted, workers: int | None, cluster: str | None, json: bool
) -> None:
    """Diagnose several campaigns; exits with 2 if one cannot be used, with 1 if one met a fault of Slipwise."""
    from slipwise.view.words.campaign_tables import (
        campaign_rows,
        compared_sentences,
        failure_sentences,
        summary_json,
        title,
    )
    from slipwise.view.words.terminal import print_table

    folder = out_folder(out)
    outcomes = run_campaigns(campaigns, folder, wanted, workers, cluster)
    compared = sw.campaigns.compare_outcomes(outcomes)
    together, reasons = judge_together(outcomes, folder)
    files = write_together(outcomes, compared, folder, together, reasons)
    if json:
        print_json(summary_json(outcomes, compared, together))
    else:
        print_table(title(len(outcomes)), campaign_rows(outcomes))
        for words in failure_sentences(outcomes):
            say(words)
        common, differs = compared_sentences(compared)
        for head, sentences in (("common to all", common), ("differs", differs)):
            for words in sentences or ["nothing"]:
                say(f"{head}: {words}")
        _tell_together(together, reasons)
        for path in files:
            say(f"wrote {path}")
        say_next(f"open {files[0]}, which leads to the page of every campaign")
    end(outcomes)


def judge_together(
    outcomes: "Sequence[sw.campaigns.Outcome]", folder: Path
) -> "tuple[sw.specimens.SpecimensReport | None, list[str]]":
    """Fit one law over the campaigns that were weighed; with it, why a campaign is left out or there is no law."""
    specimens, reasons = list["sw.specimens.SpecimenStatistics"](), list[str]()
    for outcome in outcomes:
        if outcome.failed or not outcome.numbers["weighed"]:
            reasons.append(f"{outcome.name} is left out of the law over all: nothing was weighed in it")
            continue
        try:
            specimens.append(sw.specimens.read_specimen(folder / outcome.name / "specimen.npz"))
        except InputError as error:
            reasons.append(f"{outcome.name} is left out of the law over all: {error}")
    try:
        return sw.judge_specimens(specimens), reasons
    except InputError as error:
        return None, [*reasons, f"no law over all: {error}"]


def _tell_together(together: "sw.specimens.SpecimensReport | None", reasons: Sequence[str]) -> None:
    from slipwise.view.words.specimen_words import effect_rows, effect_sentences, not_compared_words, number_rows
    from slipwise.view.words.terminal import print_table

    for words in reasons:
        say(words)
    if together is None:
        return
    say(f"one law over all: {together.sentence}")
    for words in (*effect_sentences(together), *not_compared_words(together)):
        say(f"  {words}")
    if rows := effect_rows(together):
        print_table("Effects over all specimens", rows)
    if rows := number_rows(together):
        print_table("Numbers of the law: mean over specimens, and spread between them (95 %)", rows)


def write_together(
    outcomes: "Sequence[sw.campaigns.Outcome]",
    compared: "sw.campaigns.Compared",
    folder: Path,
    together: "sw.specimens.SpecimensReport | None" = None,
    reasons: Sequence[str] = (),
) -> list[Path]:
    """Write what leads to the results of all campaigns, their numbers side by side, and the law over all."""
    from slipwise.view.files import save_json, save_page, save_rows
    from slipwise.view.pages.campaigns_page import campaigns_page
    from slipwise.view.words.campaign_tables import flat_rows, summary_json

    files = [
        save_page(campaigns_page(outcomes, compared, together, reasons), folder / "index.html"),
        save_json(summary_json(outcomes, compared, together), folder / "summary.json"),
        save_rows(flat_rows(outcomes), folder / "summary.csv"),
    ]
    law = folder / "specimens.json"
    if together is None:
        law.unlink(missing_ok=True)  # that of another call would be taken for this one's
        return files
    return [*files, save_json(together.as_json(), law)]


def end(outcomes: "Sequence[sw.campaigns.Outcome]") -> None:
    """Say how many campaigns failed, show what was no fault of theirs, and exit with 2 or 1 if any did."""
    failed = [outcome for outcome in outcomes if outcome.failed]
    if not failed:
        return
    faults = [outcome for outcome in failed if "traceback" in outcome.numbers]
    for outcome in faults:
        say(f"{outcome.name}: this is a fault of Slipwise, please report it\n{outcome.numbers['traceback']}", ERR)
    names = ", ".join(outcome.name for outcome in failed)
    say(f"error: {len(failed)} of {len(outcomes)} campaigns could not be diagnosed: {names}; why stands above", ERR)
    raise typer.Exit(1 if faults else 2)


def _names(campaigns: Sequence[Path]) -> list[str]:
    """Name every campaign's folder of results: as its own folder, with that above where two are called alike.

    Raises:
        SettingError: a campaign is given twice.
    """
    homes = [campaign.resolve() for campaign in campaigns]
    twice = [str(home) for home, count in Counter(homes).items() if count > 1]
    if twice:
        raise SettingError(f"{twice[0]} is given twice; give each campaign once")
    depth = 1
    while len({home.parts[-depth:] for home in homes}) < len(homes):
        depth += 1
    alike = Counter(home.name for home in homes)
    return [home.name if alike[home.name] == 1 else "_".join(home.parts[-depth:]).replace("/", "") for home in homes]
