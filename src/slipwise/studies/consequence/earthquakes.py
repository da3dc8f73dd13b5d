"""Earthquakes of the bridge: records, folders of records, drawn ones, scaled to a spectrum and brought to the model."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from slipwise.errors import InputError, SettingError, SlipwiseError
from slipwise.motion import TableMotion, load_motion, resample, scale_time
from slipwise.motion.load import is_description
from slipwise.motion.response_spectrum import ResponseSpectrum, scale_to_spectrum
from slipwise.simulation.simulator import DT

#: An earthquake that is drawn where nothing is said of it: that of `slipwise motions`, in the time of a bridge.
DRAWN = "quake:f=1.2Hz,strong=13s"
#: How PEER's files begin: the number of the record in its data base.
_PEER = re.compile(r"RSN\d+(?=_)")


def list_earthquakes(
    given: Sequence[str], drawn: int, seed: int, target: ResponseSpectrum | None, length_scale: float
) -> tuple[Mapping[str, TableMotion], list[str]]:
    """Return the table's motions by name, and what was left out.

    Args:
        given: files, folders (see `_records`) and descriptions. Of a quake without a seed as many are drawn as `drawn`
            says.
        drawn: how many.
        seed: of the first one that is drawn.
        target: spectrum of the bridge to which each is scaled; None leaves them as they are.
        length_scale: bridge over model [1]: the motions are the bridge's, the model's last shorter.

    Raises:
        InputError: no motion is left.
        SettingError: nothing that could be drawn, or a motion that is given twice.
        SlipwiseError: a motion that is named by itself cannot be read.
    """
    found: dict[str, TableMotion] = {}
    left_out: list[str] = []
    for name, specs, in_folder in _named(given, drawn, seed):
        if name in found:
            raise SettingError(f"the motion {name} is given twice; give it once")
        try:
            motion = load_motion(specs)
            motion = motion if target is None else scale_to_spectrum(motion, target)
        except SlipwiseError as error:
            if not in_folder:
                raise
            left_out.append(f"{name}: {error}")
            continue
        motion = scale_time(motion, length_scale) if length_scale != 1.0 else motion
        # a replay would thin it to its step anyway: hundreds are held until then
        found[name] = resample(motion, DT) if motion.dt < DT else motion
    if not found:
        raise InputError(f"no motion can be read: {'; '.join(left_out) or 'none is given'}")
    return found, left_out


def _named(given: Sequence[str], drawn: int, seed: int) -> list[tuple[str, list[str], bool]]:
    """Return what makes each motion: name, what `load_motion` takes, and whether a folder holds it."""
    out: list[tuple[str, list[str], bool]] = []
    texts = list(given) or ([DRAWN] if drawn else [])
    seeds = 0
    for text in texts:
        if Path(text).is_dir():
            out += [(name, files, True) for name, files in _records(Path(text)).items()]
        elif drawn and is_description(text) and text.startswith("quake") and "seed=" not in text:
            seeds += 1
            rest = text.partition(":")[2]
            described = [f"quake:seed={seed + i}{',' + rest if rest else ''}" for i in range(drawn)]
            out += [(each, [each], False) for each in described]
        else:
            out.append((text, [text], False))
    if drawn and not seeds:
        raise SettingError(
            f"--drawn {drawn}: name an earthquake without a seed of which they are drawn, as --motions {DRAWN}, or no "
            "motion at all"
        )
    return out


def _records(folder: Path) -> dict[str, list[str]]:
    """Return the records of a folder, name -> files.

    Each folder in it is one, and so are files that differ in their endings only (K-NET's ABC.EW, ABC.NS, ABC.UD) and
    files of one record sequence number of PEER (RSN1633_...); components of other names go into a folder of their own.
    """
    found: dict[str, list[str]] = {}
    for entry in sorted(folder.iterdir()):
        if entry.name.startswith("."):
            continue
        if entry.is_dir():
            if files := sorted(str(f) for f in entry.iterdir() if f.is_file() and not f.name.startswith(".")):
                found[str(entry)] = files
        else:
            numbered = _PEER.match(entry.name)
            found.setdefault(str(folder / (numbered[0] if numbered else entry.stem)), []).append(str(entry))
    return {name if len(files) > 1 or Path(name).is_dir() else files[0]: files for name, files in found.items()}
