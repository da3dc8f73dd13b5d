"""The laws that were found in the campaigns of a folder, read from what `discover` has written beside them."""

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.discovery.law_test import MARK
from slipwise.display import Tabular
from slipwise.errors import InputError
from slipwise.residual_map.states import UNITS, WORDS
from slipwise.short_repr import short_repr

#: What `discover` writes.
_ANSWER = "discovery.json"
_CONTRACT, _DATE = re.compile(r"\bcontract=(\d+)"), re.compile(r"\d{4}-\d{2}-\d{2}")


@short_repr
@dataclass(frozen=True)
class ListedLaw:
    """A law that was found.

    Attributes:
        name: of its effect.
        file: its effect file.
        campaign: in which it was found.
        evidence: "law", or "state" where its form is open.
        states: that drive it.
        port: how it enters.
        form: its form.
        tied: forms that cannot be told apart from it.
        share: of what the model left above noise on held-out runs that it explains [1]; None where that is not known.
        valid: state -> range of the data [SI].
        date: of the discovery; "" where its file says none.
        contract: of effects, that its file was written for; 0 where it does not say.
    """

    name: str
    file: Path
    campaign: str
    evidence: str
    states: tuple[str, ...]
    port: str
    form: str
    tied: tuple[str, ...]
    share: float | None
    valid: Mapping[str, tuple[float, float]]
    date: str
    contract: int

    def as_json(self) -> dict[str, Any]:
        """Return the law for a program to read."""
        return {
            **{name: getattr(self, name) for name in ("name", "campaign", "evidence", "port", "form", "share", "date")},
            "file": str(self.file),
            "states": list(self.states),
            "tied": list(self.tied),
            "valid": {state: list(ends) for state, ends in self.valid.items()},
            "contract": self.contract,
        }

    def as_row(self) -> dict[str, Any]:
        """Return the law as a row of a table."""
        ranges = (f"{s} {low:.3g} to {high:.3g} {UNITS.get(s, '')}".rstrip() for s, (low, high) in self.valid.items())
        return {
            "law": self.name,
            "campaign": self.campaign,
            "depends on": " and ".join(WORDS.get(s, s) for s in self.states),
            "enters": self.port,
            "form": " or ".join((self.form, *self.tied)),
            "held-out share": self.share,
            "valid": "; ".join(ranges),
            "date": self.date,
            "file": str(self.file),
        }


@dataclass(frozen=True, repr=False)
class LawList(Tabular):
    """The laws of a folder.

    Attributes:
        folder: that was searched.
        laws: by campaign and name.
    """

    folder: Path
    laws: tuple[ListedLaw, ...]

    def as_json(self) -> dict[str, Any]:
        """Return the laws for a program to read."""
        return {"schema": 1, "folder": str(self.folder), "laws": [law.as_json() for law in self.laws]}

    def _headline(self) -> str:
        count = len(self.laws)
        return f"{count} law{'' if count == 1 else 's'} in {self.folder}"

    def _rows(self) -> list[dict[str, Any]]:
        return [law.as_row() for law in self.laws]


def list_laws(folder: Path | str) -> LawList:
    """List the laws that `discover` has written below a folder; their files are read, not run.

    Args:
        folder: with campaigns, or with what `discover` wrote of them.

    Raises:
        InputError: there is no such folder.
    """
    place = Path(folder)
    if not place.is_dir():
        raise InputError(f"{place} is no folder; give one with what `slipwise discover` wrote, such as out")
    found: dict[Path, ListedLaw] = {}
    for answer in sorted(place.rglob(_ANSWER)):
        try:
            told = json.loads(answer.read_text(encoding="utf-8"))
            laws = list(zip(told["laws"], told["files"], strict=False)) if told["evidence"] in ("law", "state") else []
        except (OSError, ValueError, KeyError, TypeError):
            continue  # another program's file of that name
        for law, name in laws:
            file = answer.parent / Path(name).name  # the folder may have been moved since
            if file.is_file():
                found[file.resolve()] = _listed(law, told, file)
    return LawList(place, tuple(sorted(found.values(), key=lambda law: (law.campaign, law.name))))


def _listed(law: Mapping[str, Any], told: Mapping[str, Any], file: Path) -> ListedLaw:
    text = file.read_text(encoding="utf-8")
    contract, date = _CONTRACT.search(text), _DATE.search(text.split("Source:")[-1]) if MARK in text else None
    return ListedLaw(
        name=file.stem,
        file=file,
        campaign=str(told["campaign"]),
        evidence=str(told["evidence"]),
        states=tuple(law["states"]),
        port=str(law["port"]),
        form=str(law["form"]),
        tied=tuple(law["tied"]),
        share=_held_out_share(told.get("held_out") or {}),
        valid={state: (float(ends[0]), float(ends[1])) for state, ends in law["valid"].items()},
        date=date.group() if date else "",
        contract=int(contract.group(1)) if contract else 0,
    )


def _held_out_share(errors: Mapping[str, Any]) -> float | None:
    before, after = errors.get("before"), errors.get("after")
    if before is None or after is None or before <= 1.0:
        return None
    return 1.0 - max(after**2 - 1.0, 0.0) / (before**2 - 1.0)
