"""What a diagnosis has named, and the intervals of its sizes, from diagnosis.json."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.effects import find_effect
from slipwise.errors import InputError
from slipwise.input_file import read_input
from slipwise.model import EffectUse, Model, use_of
from slipwise.studies.ensemble.distributions import Varied


@dataclass(frozen=True)
class Diagnosed:
    """A diagnosis, as far as it matters here.

    Attributes:
        path: of the file.
        rig: on which it was found; "" in a file that does not say so.
        effects: labels of what was named.
        sizes: label.parameter -> value, low, high [SI]; low and high are None where there is no interval.
    """

    path: Path
    rig: str
    effects: tuple[str, ...]
    sizes: Mapping[str, tuple[float, float | None, float | None]]


def read_diagnosis(place: Path | str) -> Diagnosed:
    """Read a diagnosis.json, or that of a folder.

    Raises:
        InputError: it is not there, or is none.
    """
    path = Path(place) / "diagnosis.json" if Path(place).is_dir() else Path(place)
    if not path.is_file():
        raise InputError(f"{path}: no such file; `slipwise diagnose CAMPAIGN --out FOLDER` writes diagnosis.json there")
    try:
        content = json.loads(read_input(path))
        best = next(iter(content["candidates"]), None)
        parameters = best["parameters"] if best else {}
        sizes = {key: _size(entry) for key, entry in parameters.items()}
        names = tuple(str(name) for name in content["effects"])
        found = tuple(dict.fromkeys(key.rpartition(".")[0] for key in sizes))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise InputError(f"{path}: this is no diagnosis.json of this version ({error!r})") from None
    # an ambiguous verdict names all rivals: the best explanation is taken, which is the first candidate
    named = tuple(label for label in found if label.split("[")[0] in names or label in names)
    return Diagnosed(path, str(content.get("rig", "")), named, sizes)


def _size(entry: Mapping[str, Any]) -> tuple[float, float | None, float | None]:
    low, high = entry["low"], entry["high"]
    return float(entry["value"]), None if low is None else float(low), None if high is None else float(high)


def use_diagnosed(found: Diagnosed, label: str) -> EffectUse:
    """Return an effect at the size that a diagnosis has found.

    Raises:
        SlipwiseError: an effect of a user's own, which only a model.toml can name by its file.
    """
    name, _, target = label.partition("[")
    effect = find_effect(name)
    values = {
        key.rpartition(".")[2]: value for key, (value, _, _) in found.sizes.items() if key.rpartition(".")[0] == label
    }
    return use_of(effect, {**effect.typical(), **values}, target.removesuffix("]"))


def list_intervals(found: Diagnosed, model: Model, labels: tuple[str, ...]) -> tuple[list[Varied], list[str]]:
    """Return the sizes that are drawn, and what is said of those that are not.

    Args:
        found: the diagnosis.
        model: with the effects.
        labels: of the effects whose sizes are drawn.
    """
    drawn: list[Varied] = []
    notes: list[str] = []
    for key, (_, low, high) in found.sizes.items():
        label, _, name = key.rpartition(".")
        if label not in labels:
            continue
        own = model[label].numbers.get(name)
        parameter = model[label].effect.parameter(name)
        if own is None:
            continue
        if low is None or high is None or not low < high:
            notes.append(f"{key} has no interval in {found.path.name}; it stays {parameter.shown(own)}")
        elif not low <= own <= high:
            notes.append(
                f"{key} is {parameter.shown(own)} in the model, outside the interval {parameter.shown(low)} to "
                f"{parameter.shown(high)} of {found.path.name}; it stays as the model has it"
            )
        else:
            bounds = (parameter.low, parameter.high)
            drawn.append(Varied(key, low, high, parameter.unit, parameter.whole, own, bounds))
    return drawn, notes
