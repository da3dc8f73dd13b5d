"""A step of the day: what came in, and what was said of it; and all steps as the file that a restart goes on from."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec

from slipwise.errors import InputError
from slipwise.record import write_json
from slipwise.short_repr import short_repr

#: Of watch.json.
SCHEMA = 1


@short_repr
@dataclass(frozen=True)
class Step:
    """What was said when one or more runs had come in.

    Attributes:
        number: from 1.
        began: local time, "2026-11-28 14:03:20".
        runs: names of those that are new or changed.
        files: file -> sha256, of all runs that were judged.
        basis: sha256 of campaign.toml and model.toml together.
        refused: what could not be read, a sentence each.
        gauges: the audit of all runs in a sentence.
        accused: findings of the new runs by themselves, as the audit names them.
        broke: what a gauge has in the new runs that it did not have before, a sentence each.
        sound: findings that the runs before had and the new ones have not.
        verdict: diagnosis.json without its candidates, empty before it is known.
        cannot: why there is no verdict, "" where there is one.
        places: where the model fails, a sentence each.
        motions: the next motions as next.json lists them.
        next_words: which motion next, in a sentence.
        report: folder of the diagnosis beside watch.html.
        seconds: what -> how long after the files were whole it was known [s].
        finished: whether nothing of the step is left to do.
    """

    number: int
    began: str
    runs: tuple[str, ...]
    files: dict[str, str]
    basis: str
    refused: tuple[str, ...] = ()
    gauges: str = ""
    accused: tuple[str, ...] = ()
    broke: tuple[str, ...] = ()
    sound: tuple[str, ...] = ()
    verdict: dict[str, Any] = field(default_factory=dict[str, Any])
    cannot: str = ""
    places: tuple[str, ...] = ()
    motions: tuple[dict[str, Any], ...] = ()
    next_words: str = ""
    report: str = ""
    seconds: dict[str, float] = field(default_factory=dict[str, float])
    finished: bool = False


@dataclass(frozen=True)
class _Kept:
    schema: int
    campaign: str
    steps: tuple[Step, ...]


def save_steps(campaign: str, steps: tuple[Step, ...], path: Path) -> None:
    """Write the steps of a campaign; the file is there whole or not at all.

    Raises:
        OutputError: it cannot be written.
    """
    write_json(path, msgspec.to_builtins(_Kept(SCHEMA, campaign, steps)))


def load_steps(path: Path) -> tuple[Step, ...]:
    """Read the steps that an earlier watch has left; none where there is no file.

    Raises:
        InputError: what is there was not written by this version of the program.
    """
    try:
        return msgspec.json.decode(path.read_bytes(), type=_Kept).steps
    except FileNotFoundError:
        return ()
    except (msgspec.MsgspecError, OSError, UnicodeDecodeError) as error:
        raise InputError(
            f"{path} cannot be gone on from ({error}); move it away, or give another folder with --out"
        ) from None


def short_verdict(content: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a step keeps of diagnosis.json: all but the long lists."""
    left_out = ("candidates", "screened", "unknown", "importance", "least", "corrections", "first")
    return {key: value for key, value in content.items() if key not in left_out}
