"""Campaigns of families on disk, made once: folders, answer keys, and what others measure of each.

    OUT/campaigns/NAME/     campaign.toml and its runs, as a laboratory would hand them over
    OUT/answers/NAME.json   the answer key, apart, so that no diagnosis reads it; written last
    OUT/features.jsonl      one line a campaign: what a judge is given, added by whoever measures it

A campaign is made again only when the code that it depends on has changed, or its answer key is not there.
"""

import json
import shutil
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise_benchmarks.families import FAMILIES, Family, build_family


@dataclass(frozen=True)
class Order:
    """A campaign to make.

    Attributes:
        out: folder of all.
        family: name of a family.
        maker: who makes it.
        seed: of everything random.
        depends_on: hash of the code that it is made by.
    """

    out: Path
    family: str
    maker: str
    seed: int
    depends_on: str

    @property
    def name(self) -> str:
        """Name of the campaign's folder."""
        return FAMILIES[self.family].campaign(self.maker, self.seed)

    @property
    def folder(self) -> Path:
        """Folder of the campaign."""
        return self.out / "campaigns" / self.name

    @property
    def answer(self) -> Path:
        """File of its answer key."""
        return self.out / "answers" / f"{self.name}.json"


def orders(out: Path, families: Iterable[Family], makers: Iterable[str], count: int, first: int = 0) -> list[Order]:
    """Give the campaigns of these families, `count` seeds of each from a place on; every family once, then again."""
    hashes = {(family.name, maker): family.depends_on(maker) for family in families for maker in makers}
    return [
        Order(out, name, maker, FAMILIES[name].seeds[place], depends_on)
        for place in range(first, first + count)
        for (name, maker), depends_on in hashes.items()
    ]


def is_made(order: Order) -> bool:
    """Tell whether a campaign is there, made by the code as it is now."""
    if not order.answer.exists() or not order.folder.exists():
        return False
    return json.loads(order.answer.read_text(encoding="utf-8"))["depends_on"] == order.depends_on


def make(order: Order) -> dict[str, Any]:
    """Make one campaign and give its answer key; what was there of it is replaced."""
    began = time.process_time()
    order.answer.unlink(missing_ok=True)
    shutil.rmtree(order.folder, ignore_errors=True)
    made = build_family(FAMILIES[order.family], order.maker, order.seed)
    made.write(order.folder)
    answer = {**made.answer, "depends_on": order.depends_on, "seconds": round(time.process_time() - began, 2)}
    order.answer.parent.mkdir(parents=True, exist_ok=True)
    whole = order.answer.with_suffix(".part")
    text = json.dumps(answer, indent=1, allow_nan=False)
    whole.write_text(text + "\n", encoding="utf-8")
    whole.replace(order.answer)
    return json.loads(text)


def read_answers(out: Path) -> dict[str, dict[str, Any]]:
    """Give name -> answer key of all that are made."""
    files = sorted((out / "answers").glob("*.json"))
    return {file.stem: json.loads(file.read_text(encoding="utf-8")) for file in files}


def add_features(out: Path, name: str, features: Mapping[str, Any]) -> None:
    """Add what was measured of a campaign: one line with its name, which takes the place of an earlier one."""
    with (out / "features.jsonl").open("a", encoding="utf-8") as stream:
        stream.write(json.dumps({"name": name, **features}, allow_nan=False) + "\n")


def read_features(out: Path) -> dict[str, dict[str, Any]]:
    """Give name -> what was measured of it; empty where nothing was."""
    path = out / "features.jsonl"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return {line["name"]: line for line in map(json.loads, lines)}
