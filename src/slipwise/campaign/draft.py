"""Draft a campaign.toml from the files of a folder: what the headers say is mapped, what only a person knows is marked.

Nothing is guessed silently: every line that rests on a header's word carries "decide" with what it rests on.
"""

import re
from collections.abc import Sequence
from pathlib import Path

from slipwise.campaign.table import SUFFIXES, open_table
from slipwise.channels import CHANNELS, PADS, channel
from slipwise.errors import InputError, SlipwiseError
from slipwise.record import write_text
from slipwise.units import parse_unit

#: "disp (in)", "force [kip]": a name and its unit.
_HEADER = re.compile(r"^\s*(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*$")
_OURS = re.compile(r"^(?P<name>[A-Za-z]\w*)\s*\[[^\]]*\]$")
#: Words of a header -> channel that it may be.
_WORDS: tuple[tuple[tuple[str, ...], str], ...] = (
    (("time", "zeit", "tempo", "t"), "time"),
    (("slip", "disp", "displacement", "position", "travel", "weg"), "slip_x"),
    (("vel", "velocity", "speed"), "slip_vx"),
    (("normal", "load", "vertical"), "pad_A_N"),
    (("pressure", "druck"), "pad_A_P"),
    (("force", "friction", "shear", "kraft"), "pad_A_Fx"),
    (("temperature", "temp"), "pad_A_T"),
    (("table",), "table_ax"),
    (("acc", "accel", "acceleration", "girder"), "girder_ax"),
)


def init_campaign(folder: Path | str) -> Path:
    """Write a first campaign.toml into a folder of measured runs; what only a person knows is marked in it.

    Returns:
        The file.

    Raises:
        InputError: the file exists, or there is nothing to draft it from.
    """
    path = Path(folder) / "campaign.toml"
    if path.exists():
        raise InputError(f"{path} exists and is not overwritten; move it away to draft a new one")
    write_text(path, draft_campaign(Path(folder)))
    return path


def draft_campaign(folder: Path) -> str:
    """Write the text of a first campaign.toml.

    Args:
        folder: with the data files.

    Raises:
        InputError: no such folder, no data file in it, or a file that cannot be read.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; a campaign is a folder with data files")
    files = sorted(p for p in folder.iterdir() if p.suffix.lower() in SUFFIXES and p.is_file())
    if not files:
        raise InputError(f"{folder}: no data file in it; possible: {', '.join(SUFFIXES)}")
    headers = list(dict.fromkeys(h for file in files for h in open_table(file).headers))
    ours = [m["name"] for h in headers if (m := _OURS.match(h)) and m["name"] in CHANNELS]
    lines = _columns([h for h in headers if not ((m := _OURS.match(h)) and m["name"] in CHANNELS)], ours)
    pads = [p for p in PADS if f"pad_{p}_Fx" in ours]
    rig = "bridge1" if len(pads) == len(PADS) else "pad"
    head = [
        "# Drafted from the files of this folder. Lines with `decide` need your eyes.",
        "# `slipwise channels` lists the channels.",
        f"name = {_quoted(folder.resolve().name)}",
        f"rig  = {_quoted(rig)}   # decide: bridge1, bridge2, block, pad (slip prescribed), or an MJCF file",
        "",
    ]
    if rig != "pad":
        head += ["# [logger]                # decide: what the logger did to the channels", '# lowpass = "100 Hz"', ""]
    named = [*ours, *re.findall(r'channel = "(\w+)", unit', "\n".join(line for line in lines if line[:1] != "#"))]
    if not any(n.startswith("pad_") and n[6:] in ("N", "P") for n in named):
        lines += ["# [constants]             # decide: no column holds a pad's load", '# pad_A_N = "10 kN"', ""]
    return "\n".join([*head, *lines, *_runs(files)]) + "\n"


def _columns(headers: Sequence[str], ours: Sequence[str]) -> list[str]:
    """Give [columns]: lines for headers whose words and unit fit a channel, comments for the rest."""
    if not headers:
        return []
    lines, taken = ["[columns]"], set(ours)
    for header in headers:
        found = _HEADER.match(header)
        name, unit = (found["name"], found["unit"]) if found else (header, "")
        guess = _guess(name, unit)
        if guess and guess not in taken:
            taken.add(guess)
            entry = f"{{ channel = {_quoted(guess)}, unit = {_quoted(unit)} }}"
            lines.append(f"{_quoted(header)} = {entry}   # decide: channel, sign (sign = -1 turns it)")
        else:
            lines.append(
                f'# {_quoted(header)} = {{ channel = "...", unit = {_quoted(unit or "...")} }}   # decide: not used'
            )
    return [*lines, ""]


def _guess(name: str, unit: str) -> str:
    """Give the channel that a header's words and unit both fit; "" where none does."""
    words = re.split(r"[^a-z]+", name.lower())
    for known, wanted in _WORDS:
        if any(word in known for word in words):
            try:
                parse_unit(unit, channel(wanted).unit, name)
            except SlipwiseError:
                continue
            return wanted
    return ""


def _runs(files: Sequence[Path]) -> list[str]:
    lines = []
    for number, file in enumerate(files):
        last = number == len(files) - 1 and len(files) > 1
        lines += [
            "[[run]]",
            f"file = {_quoted(file.name)}",
            f"role = {_quoted('holdout' if last else 'fit')}   # decide: fit, repeat (same motion again) or holdout",
            '# rest_before = "30 min"   # decide: the pause before this run',
            "",
        ]
    return lines


def _quoted(text: str) -> str:
    plain = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", " ", plain) + '"'
