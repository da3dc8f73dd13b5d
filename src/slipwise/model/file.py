"""model.toml: a model that people read and edit by hand.

    rig = "bridge1"

    [specimen]                      # optional: what is known better than the rig's rated values
    mass = "10.02 t"

    [[effect]]
    name = "shear_rate"
    strength = "1.379 MPa"          # a parameter that is not given takes its typical value
    held = ["rate"]                 # parameters that no fit changes
    [effect.pads]                   # what a pad has of its own, where an effect acts on single pads
    A = { strength = "1.1 MPa" }

    [[effect]]
    name = "channel_gain"
    target = "pad_A_N"
    gain = "3 %"

    [[effect]]
    file = "mine.py"                # an effect of one's own, beside this file

Comments and order survive every change that Slipwise makes.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Table

from slipwise.effects import Effect, Trust, catalogue
from slipwise.errors import InputError, SettingError, unknown_name
from slipwise.input_file import read_input
from slipwise.model import EffectUse, Model, base_model
from slipwise.model.entry import entry_use, label_of, new_entry, write_values
from slipwise.model.unused_values import refuse_stated
from slipwise.params import same_number
from slipwise.record import write_text
from slipwise.rig import RIGS, Specimen, load_specimen
from slipwise.rig.known import SPECIMEN_UNITS, better_known, known_better, read_known
from slipwise.units import quantity

_TOP = ("rig", "specimen", "effect")
_HEAD = """# A model: the rig and the effects that act on it. `slipwise add` and `slipwise remove` edit this file too,
# and keep your comments. `slipwise effects NAME` tells what an effect is.
"""


def load_model(path: Path | str, *, trust: Trust = False) -> Model:
    """Read a model.toml.

    Args:
        path: of the file.
        trust: effect files that it names and that may be run: none, these, or all (True).

    Raises:
        InputError: no file, no TOML, something that is needed is missing, or an effect file that is not trusted.
        UnknownNameError: a rig, effect, parameter or key that does not exist, with the nearest ones.
        UnitError: a value without a unit or of the wrong dimension.
        SettingError: a value out of bounds, or effects that cannot go together.
    """
    return _model(_read(Path(path)), Path(path), trust)


def as_model(given: Model | Specimen | Path | str) -> Model:
    """Return the model that a user means: itself, a model.toml, or a rig, which stands for the paper's law on it.

    Raises:
        SettingError: something else.
        SlipwiseError: a file or a rig that cannot be read.
    """
    if isinstance(given, Model):
        return given
    if isinstance(given, Specimen):
        return base_model(given)
    if not isinstance(given, Path | str):
        raise SettingError(
            "a model is what base_model or load_model gives, the path of a model.toml, or the name of a rig "
            f"({', '.join(RIGS)}); got {type(given).__name__}"
        )
    return load_model(given) if Path(given).suffix == ".toml" else base_model(given)


def save_model(model: Model, path: Path | str) -> None:
    """Write a model; a file that is there keeps its comments, and its order as far as the model has it.

    Args:
        model: what is written.
        path: of the file, model.toml.

    Raises:
        SettingError: the file is of another rig.
    """
    path = Path(path)
    rig = _name_rig(model.specimen, path.parent)
    document = _read(path) if path.is_file() else tomlkit.parse(f"{_HEAD}rig = {tomlkit.item(rig).as_string()}\n")
    rated = load_specimen(str(document["rig"]), path.parent)
    if rated.path.resolve() != model.specimen.path.resolve():
        raise SettingError(f"{path} is a model of {document['rig']!r}, not of {rig!r}; write to another file")
    unused = model.unused_values
    known = {n: value for n, value in known_better(model.specimen, rated).items() if n not in unused}
    _write_specimen(document, known)
    labels = [u.label for u in model.uses]
    entries = _entries(document)
    for i in reversed(range(len(entries))):
        if label_of(entries[i], path) not in labels:
            del entries[i]
    written = {label_of(entry, path): entry for entry in entries}
    for wanted in model.uses:
        if wanted.label in written:
            write_values(written[wanted.label], wanted)
        else:
            _append(document, wanted, _file_of(wanted.effect, path))
    if not model.uses:
        document.pop("effect", None)  # an empty list would be no table of [[effect]]
    write_text(path, _separate(tomlkit.dumps(document)))


def _name_rig(specimen: Specimen, folder: Path) -> str:
    """Return what a model.toml in a folder calls a rig: a name of the package, or a file, seen from there."""
    # a rig of one's own may have the name of one of the package
    if specimen.name in RIGS and load_specimen(specimen.name).path == specimen.path:
        return specimen.name
    return _as_seen_from(folder, specimen.path)


def _as_seen_from(folder: Path, file: Path) -> str:
    """Return a file's path for a text that lies in a folder: relative where it is inside, whole where it is not."""
    there, whole = folder.resolve(), file.resolve()
    return (whole.relative_to(there) if whole.is_relative_to(there) else whole).as_posix()


def _read(path: Path) -> tomlkit.TOMLDocument:
    if not path.is_file():
        raise InputError(
            f"{path}: no such file; `slipwise add` writes a model.toml, as `slipwise diagnose --accept` does"
        )
    try:
        document = tomlkit.parse(read_input(path).decode("utf-8-sig"))
    except (TOMLKitError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(
            f"{path}: not valid TOML: {error}; texts stand in quotes, and every key has a line of its own"
        ) from None
    for key in document:
        if key not in _TOP:
            raise unknown_name(f"key in {path.name}", key, _TOP)
    if "rig" not in document:
        raise InputError(f"{path}: 'rig' is missing; write for example rig = \"bridge1\"")
    if not isinstance(document.get("effect", AoT([])), AoT):
        raise InputError(f"{path}: effects are written as [[effect]] with double brackets, one for each")
    return document


def _entries(document: tomlkit.TOMLDocument) -> AoT:
    return cast(AoT, document.get("effect", AoT([])))


def _model(document: tomlkit.TOMLDocument, path: Path, trust: Trust) -> Model:
    specimen = load_specimen(str(document["rig"]), path.parent)
    part = cast(Mapping[str, Any], document.get("specimen", {}))
    known = read_known(part, f"[specimen] of {path.name}")
    uses = tuple(entry_use(entry, path, trust, slider=not specimen.free) for entry in _entries(document))
    model = Model(better_known(specimen, known, path.name), uses)
    refuse_stated(model.specimen, model.unused_values)
    return model


def _file_of(effect: Effect, path: Path) -> str:
    """Return a user's effect file as seen from the model file; nothing for an effect of the catalogue."""
    if effect.name in catalogue():
        return ""
    return _as_seen_from(path.parent, effect.path)


def _append(document: tomlkit.TOMLDocument, wanted: EffectUse, file: str) -> None:
    if "effect" not in document:
        document["effect"] = tomlkit.aot()
    else:
        _entries(document)[-1].add(tomlkit.nl())  # the last line of a file may not have ended
    _entries(document).append(new_entry(wanted, file))


def _separate(text: str) -> str:
    """Return a file's text with one blank line before each effect; a comment right above one stays there."""
    lines: list[str] = []
    for line in text.split("\n"):
        if line.strip() == "[[effect]]" and not (lines and lines[-1].startswith("#")):
            while lines and not lines[-1].strip():
                lines.pop()
            lines.append("")
        lines.append(line)
    return "\n".join(lines).rstrip() + "\n"


def _write_specimen(document: tomlkit.TOMLDocument, known: Mapping[str, float | str]) -> None:
    if "specimen" not in document and not known:
        return
    if "specimen" not in document:
        entries = document.pop("effect", None)
        document["specimen"] = tomlkit.table()
        if entries is not None:
            document["effect"] = entries
    part = cast(Table, document["specimen"])
    for name in [n for n in part if n not in known]:
        del part[name]
    for name, value in known.items():
        if isinstance(value, str):
            part[name] = value
        elif name not in part or not same_number(quantity(str(part[name]), SPECIMEN_UNITS[name], name), value):
            part[name] = f"{value:.15g} {SPECIMEN_UNITS[name]}".removesuffix(" 1")
