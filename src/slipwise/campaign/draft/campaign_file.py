"""Draft a campaign.toml from the files of a folder: what the headers say is mapped, what only a person knows is marked.

Nothing is guessed silently: every line that rests on a header's word carries "decide" with what it rests on.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.draft.channel_mapping import map_columns
from slipwise.campaign.draft.column import Mapped
from slipwise.campaign.draft.column_lines import column_lines, own_column_lines, quoted
from slipwise.campaign.draft.data_files import DataFile, open_data_files
from slipwise.campaign.draft.levels import MappedLevels, map_levels
from slipwise.campaign.draft.rig import rig_for
from slipwise.campaign.draft.roles import is_sine, record_of, roles_of
from slipwise.campaign.draft.time_column import no_time
from slipwise.channels import pads_in, part_of
from slipwise.data_files.table import SUFFIXES
from slipwise.errors import InputError
from slipwise.record import Record, write_text
from slipwise.rig.files import SPECIMEN_FILE

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
    files, passed = open_data_files(folder)
    if not files:
        why = f" can be read: {'; '.join(passed)}" if passed else ""
        raise InputError(f"{folder}: no data file in it{why}; possible: {', '.join(SUFFIXES)}")
    levels = map_levels(sorted(files, key=_liveliness, reverse=True))
    mapped = _mapped(files, levels)
    of_file = {file.path.name: {**mapped, **levels.own.get(file.path.name, {})} for file in files}
    records = {file.path.name: _recognised(file, of_file[file.path.name]) for file in files}
    ours = list(dict.fromkeys(name for file in files for name in file.known))
    lines = [*column_lines(files, ours, mapped, levels.left), *_derived(mapped)]
    named = [*ours, *re.findall(r'channel = "(\w+)", unit', "\n".join(line for line in lines if line[:1] != "#"))]
    known = [record for record in records.values() if record is not None]
    guess, why, specimen = rig_for(known, pads_in(named), folder, levels.order)
    possible = "a name of `slipwise rigs`, a specimen.toml or an MJCF file"
    rig = guess if ask is None else ask(f"Which rig ({possible})?", guess)
    head = [
        "# Drafted from the files of this folder. Lines with `decide` need your eyes.",
        "# `slipwise channels` lists the channels.",
        *(f"# not read: {words}" for words in passed),
        *(f"# note: {' '.join(note.split())}" for file in files for note in file.notes),
        f"name = {quoted(folder.resolve().name)}",
        f"rig  = {quoted(rig)}   # decide: {possible} ({why})",
        "",
    ]
    notes = []
    if open_units := sum('unit = "?"' in line for line in lines):
        stand = "1 unit is" if open_units == 1 else f"{open_units} units are"
        notes.append(f'# note: {stand} "?", because no header states it: write it')
    for file in files:
        lacking = [repr(header) for header in mapped if header not in file.headers]
        if lacking:
            others = f"{file.path.name} has no column {', '.join(lacking)}"
            notes.append(f"# note: {others}: name its columns as in the other files, or give it a folder of its own")
    for name in levels.own:
        notes.append(f"# note: {name} has its levels in another order than the other files: it has columns of its own")
    untimed = [file for file in files if not _timed(file, mapped)]
    if untimed:
        notes.append(f"# note: {untimed[0].path.name} shows no time: {no_time(untimed[0].columns)}")
        head.insert(-1, '# sample_rate = "500 Hz"   # decide: map a column to "time", or write the rate here')
    head[2:2] = notes
    if rig != "pad":
        head += _logger(ask)
    if levels.order is None and not any(part_of(n)[0] == "pad" and n.endswith(("_N", "_P")) for n in named):
        lines += ["# [constants]             # decide: no column holds a pad's load", '# pad_A_N = "10 kN"', ""]
    return "\n".join([*head, *lines, *_runs(records, levels.own)]) + "\n", specimen if rig == guess else ""


def _logger(ask: Ask | None) -> list[str]:
    known = "" if ask is None else ask('Low-pass filter of the logger ("100 Hz", "none", empty if not known)?', "")
    if known.strip():
        return ["[logger]", f"lowpass = {quoted(known.strip())}", ""]
    return ["# [logger]                # decide: what the logger did to the channels", '# lowpass = "100 Hz"', ""]


def _mapped(files: Sequence[DataFile], levels: MappedLevels) -> dict[str, Mapped]:
    """Recognise columns in the file that moves most; headers mean the same in all files."""
    out: dict[str, Mapped] = dict(levels.common)
    for file in sorted(files, key=_liveliness, reverse=True):
        taken = {m.channel for m in out.values()}
        fresh = [c for c in file.columns if c.header not in out and c.header not in levels.left]
        known = {m.channel: m.sign * c.values for c in file.columns if (m := out.get(c.header)) is not None}
        found = map_columns(fresh, {**file.known, **known}, file.step)
        out |= {header: m for header, m in found.items() if m.channel not in taken}
    return out


def _liveliness(file: DataFile) -> tuple[bool, float]:
    """Rank files by how much their accelerations move: both directions at once tell most, an earthquake than a sine."""
    moving = [c.values for c in file.columns if c.kind == "acceleration" and np.ptp(c.values) > 0.0]
    if not moving:
        return False, 0.0
    return not any(is_sine(values) for values in moving), float(np.prod([np.std(values) for values in moving]))


def _channels(file: DataFile, mapped: Mapping[str, Mapped]) -> dict[str, Array]:
    """Return the channels of a file that are known, its times from the stated step where no column holds them."""
    chosen = ((c, mapped[c.header]) for c in file.columns if c.header in mapped)
    channels = {**file.known, **{m.channel: m.sign * c.values for c, m in chosen}}
    if "time" not in channels and file.step is not None and file.columns:
        channels["time"] = np.arange(len(file.columns[0].values), dtype=np.float64) * file.step
    return channels


def _timed(file: DataFile, mapped: Mapping[str, Mapped]) -> bool:
    return file.step is not None or "time" in _channels(file, mapped) or not file.columns


def _recognised(file: DataFile, mapped: Mapping[str, Mapped]) -> Record | None:
    return record_of(_channels(file, mapped), file.path)


def _derived(mapped: Mapping[str, Mapped]) -> list[str]:
    """Return [derived]: displacements with another reference than their channel's."""
    lines = [f"{m.channel.removesuffix('_raw')} = {quoted(m.derived)}" for m in mapped.values() if m.derived]
    return (
        ["[derived]   # decide: displacements that were measured from elsewhere", *sorted(lines), ""] if lines else []
    )


def _runs(records: Mapping[str, Record | None], own: Mapping[str, Mapping[str, Mapped]]) -> list[str]:
    lines = []
    for name, (role, why) in roles_of(records).items():
        reason = f" ({why})" if why else ""
        lines += [
            "[[run]]",
            f"file = {quoted(name)}",
            f"role = {quoted(role)}   # decide: fit, repeat (same motion again) or holdout{reason}",
            '# rest_before = "30 min"   # decide: the pause before this run',
            *own_column_lines(own.get(name, {})),
            "",
        ]
    return lines
