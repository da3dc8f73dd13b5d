"""Draft a campaign.toml from the files of a folder: what the headers say is mapped, what only a person knows is marked.

Nothing is guessed silently: every line that rests on a header's word carries "decide" with what it rests on.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.draft_column import Column, Mapped, column_of
from slipwise.campaign.draft_columns import map_columns
from slipwise.campaign.draft_rig import rig_for
from slipwise.campaign.draft_roles import is_sine, record_of, roles_of
from slipwise.campaign.table import SUFFIXES, open_table
from slipwise.channels import channel, is_channel, pads_in, part_of
from slipwise.errors import InputError, SlipwiseError
from slipwise.record import Record, write_text
from slipwise.rig.files import SPECIMEN_FILE
from slipwise.units import affine, parse_unit

Array = NDArray[np.float64]
#: "disp (in)", "force [kip]": a name and its unit.
_HEADER = re.compile(r"^\s*(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*$")
_OURS = re.compile(r"^(?P<name>[A-Za-z]\w*)\s*\[(?P<unit>[^\]]*)\]$")
#: Words of a header -> channel that it may be.
_WORDS: tuple[tuple[tuple[str, ...], str], ...] = (
    (("time", "zeit", "tempo", "t"), "time"),
    (("slip", "disp", "displacement", "position", "travel", "weg"), "slip_x"),
    (("vel", "velocity", "speed"), "slip_vx"),
    (("normal", "axial", "load", "vertical"), "pad_A_N"),
    (("pressure", "druck"), "pad_A_P"),
    (("force", "friction", "shear", "kraft"), "pad_A_Fx"),
    (("temperature", "temp"), "pad_A_T"),
    (("table",), "table_ax"),
    (("acc", "accel", "acceleration", "girder"), "girder_ax"),
)


@dataclass(frozen=True)
class DataFile:
    """A data file of the folder: its headers, its columns of our names, and those that were looked at."""

    path: Path
    headers: tuple[str, ...]
    known: Mapping[str, Array]
    columns: tuple[Column, ...]


#: Ask a person: (question, what is taken without an answer) -> answer.
Ask = Callable[[str, str], str]


def init_campaign(folder: Path | str, *, ask: Ask | None = None) -> Path:
    """Write a first campaign.toml into a folder of measured runs; what only a person knows is marked in it.

    Args:
        folder: with the data files; notes, pictures and files without a table are passed over and listed.
        ask: asked for the rig and the logger's filter; None takes the guesses.

    Returns:
        The file.

    Raises:
        InputError: the file exists, or there is nothing to draft it from.
    """
    path = Path(folder) / "campaign.toml"
    if path.exists():
        raise InputError(f"{path} exists and is not overwritten; move it away to draft a new one")
    text, specimen = draft_campaign(Path(folder), ask)
    if specimen:
        write_text(path.with_name(SPECIMEN_FILE), specimen)
    write_text(path, text)
    return path


def draft_campaign(folder: Path, ask: Ask | None = None) -> tuple[str, str]:
    """Write the text of a first campaign.toml, and that of a specimen.toml where it needs one, else "".

    Args:
        folder: with the data files.
        ask: as in `init_campaign`.

    Raises:
        InputError: no such folder, or no data file in it that can be read.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; a campaign is a folder with data files")
    files, passed = _data_files(folder)
    if not files:
        why = f": {'; '.join(passed)}" if passed else ""
        raise InputError(f"{folder}: no data file in it{why}; possible: {', '.join(SUFFIXES)}")
    mapped = _mapped(files)
    records = {file.path.name: _recognised(file, mapped) for file in files}
    headers = list(dict.fromkeys(h for file in files for h in file.headers if not _is_ours(h)))
    ours = list(dict.fromkeys(name for file in files for name in file.known))
    lines = _columns(headers, ours, mapped)
    named = [*ours, *re.findall(r'channel = "(\w+)", unit', "\n".join(line for line in lines if line[:1] != "#"))]
    known = [record for record in records.values() if record is not None]
    guess, why, specimen = rig_for(known, pads_in(named), folder)
    possible = "a name of `slipwise rigs`, a specimen.toml or an MJCF file"
    rig = guess if ask is None else ask(f"Which rig ({possible})?", guess)
    head = [
        "# Drafted from the files of this folder. Lines with `decide` need your eyes.",
        "# `slipwise channels` lists the channels.",
        *(f"# not read: {words}" for words in passed),
        f"name = {_quoted(folder.resolve().name)}",
        f"rig  = {_quoted(rig)}   # decide: {possible} ({why})",
        "",
    ]
    if rig != "pad":
        head += _logger(ask)
    if not any(part_of(n)[0] == "pad" and n.endswith(("_N", "_P")) for n in named):
        lines += ["# [constants]             # decide: no column holds a pad's load", '# pad_A_N = "10 kN"', ""]
    return "\n".join([*head, *lines, *_runs(records)]) + "\n", specimen if rig == guess else ""


def _logger(ask: Ask | None) -> list[str]:
    known = "" if ask is None else ask('Low-pass filter of the logger ("100 Hz", "none", empty if not known)?', "")
    if known.strip():
        return ["[logger]", f"lowpass = {_quoted(known.strip())}", ""]
    return ["# [logger]                # decide: what the logger did to the channels", '# lowpass = "100 Hz"', ""]


def _is_ours(header: str) -> bool:
    match = _OURS.match(header)
    return bool(match and is_channel(match["name"]))


def _data_files(folder: Path) -> tuple[list[DataFile], list[str]]:
    """Open what can be a data file; say what is passed over and why."""
    files, passed = [], []
    for path in sorted(p for p in folder.iterdir() if p.is_file() and not p.name.startswith(".")):
        if path.suffix.lower() not in SUFFIXES:
            passed.append(f"{path.name} (no data file)")
            continue
        try:
            files.append(_opened(path))
        except InputError as error:
            words = str(error).removeprefix(f"{path}: ").removeprefix(f"{path.name}: ")
            passed.append(f"{path.name} ({_one_line(words)})")
    return files, passed


def _one_line(text: str) -> str:
    return " ".join(text.split())[:160]


def _opened(path: Path) -> DataFile:
    """Read all columns of a file that hold numbers."""
    table = open_table(path)
    known: dict[str, Array] = {}
    columns: list[Column] = []
    for i, header in enumerate(table.headers):
        try:
            (values,) = table.columns([i]).values
        except InputError:
            continue  # a column of words
        if not np.isfinite(values).all():
            continue
        match = _OURS.match(header)
        if match and is_channel(match["name"]):
            try:
                factor, offset = affine(match["unit"], channel(match["name"]).unit, header)
            except SlipwiseError:
                continue
            known[match["name"]] = factor * values + offset
        else:
            columns.append(column_of(header, values))
    if table.step is not None and "time" not in known and not any(c.kind == "time" for c in columns) and columns:
        known["time"] = np.arange(len(columns[0].values), dtype=np.float64) * table.step
    return DataFile(path, table.headers, known, tuple(columns))


def _mapped(files: Sequence[DataFile]) -> dict[str, Mapped]:
    """Recognise columns in the file that moves most; headers mean the same in all files."""
    out: dict[str, Mapped] = {}
    for file in sorted(files, key=_liveliness, reverse=True):
        taken = {m.channel for m in out.values()}
        fresh = [c for c in file.columns if c.header not in out]
        found = map_columns(fresh, {**file.known, **_channels(file, out)})
        out |= {header: m for header, m in found.items() if m.channel not in taken}
    return out


def _liveliness(file: DataFile) -> tuple[bool, float]:
    """Rank files by how much their accelerations move: both directions at once tell most, an earthquake than a sine."""
    moving = [c.values for c in file.columns if c.kind == "acceleration" and np.ptp(c.values) > 0.0]
    if not moving:
        return False, 0.0
    return not any(is_sine(values) for values in moving), float(np.prod([np.std(values) for values in moving]))


def _channels(file: DataFile, mapped: Mapping[str, Mapped]) -> dict[str, Array]:
    chosen = ((c, mapped[c.header]) for c in file.columns if c.header in mapped)
    return {m.channel: m.sign * c.values for c, m in chosen}


def _recognised(file: DataFile, mapped: Mapping[str, Mapped]) -> Record | None:
    return record_of({**file.known, **_channels(file, mapped)}, file.path)


def _columns(headers: Sequence[str], ours: Sequence[str], mapped: Mapping[str, Mapped]) -> list[str]:
    """Give [columns]: lines for what was recognised, or whose words and unit fit a channel, comments for the rest."""
    if not headers:
        return []
    lines, taken = ["[columns]"], {*ours, *(m.channel for m in mapped.values())}
    for header in headers:
        found = _HEADER.match(header)
        name, unit = (found["name"], found["unit"]) if found else (header, "")
        if header in mapped:
            m = mapped[header]
            sign = ", sign = -1" if m.sign < 0 else ""
            entry = f"{{ channel = {_quoted(m.channel)}, unit = {_quoted(m.unit)}{sign} }}"
            lines.append(f"{_quoted(header)} = {entry}   # decide: {m.sure}: {_one_line(m.why)}")
            continue
        guess = _guess(name, unit)
        if guess and guess not in taken:
            taken.add(guess)
            entry = f"{{ channel = {_quoted(guess)}, unit = {_quoted(unit)} }}"
            lines.append(
                f"{_quoted(header)} = {entry}   # decide: guess by its name: channel, sign (sign = -1 turns it)"
            )
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


def _runs(records: Mapping[str, Record | None]) -> list[str]:
    lines = []
    for name, (role, why) in roles_of(records).items():
        reason = f" ({why})" if why else ""
        lines += [
            "[[run]]",
            f"file = {_quoted(name)}",
            f"role = {_quoted(role)}   # decide: fit, repeat (same motion again) or holdout{reason}",
            '# rest_before = "30 min"   # decide: the pause before this run',
            "",
        ]
    return lines


def _quoted(text: str) -> str:
    plain = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", " ", plain) + '"'
