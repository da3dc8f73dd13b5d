"""The verb: shake a model with many earthquakes, with what was named and without it, its sizes drawn."""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import SettingError
from slipwise.jobs.executors import run_all
from slipwise.jobs.job_log import Finished
from slipwise.model import Model
from slipwise.model.file import as_model, save_model
from slipwise.motion import TableMotion
from slipwise.motion.response_spectrum import ResponseSpectrum, read_spectrum
from slipwise.rig.similarity import LENGTH_SCALE
from slipwise.studies.consequence.diagnosed import Diagnosed, list_intervals, read_diagnosis, use_diagnosed
from slipwise.studies.consequence.earthquakes import list_earthquakes
from slipwise.studies.consequence.result import Consequence, Distribution, to_bridge
from slipwise.studies.ensemble.distributions import Varied, draw, read_varied
from slipwise.studies.ensemble.member import FileBase, Shaken, member_key, motion_key, run_shaken
from slipwise.studies.ensemble.members_file import write_members
from slipwise.studies.ensemble.responses import RESPONSES

WITHOUT, WITH = "without", "with"
#: What is asked of the bridge, the response of the sentence first.
_ASKED = ("slip", "residual_slip", "pad_load", "buffer_force")
_SIMILARITY = (
    "numbers of the bridge follow from those of the model by similarity (accelerations and pressures alike, lengths "
    "{:g} times): how friction follows speed, heat, and lengths of pre-sliding and wear do not scale so, and are those "
    "of the model"
)


@dataclass(frozen=True)
class _Plan:
    """All members: motion by motion, draw by draw, without and with what was named."""

    bases: Mapping[str, FileBase]
    motions: Mapping[str, TableMotion]
    draws: int
    varied: tuple[Varied, ...]
    drawn: Array
    named: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.motions) * self.draws * len(self.bases)

    def at(self, place: int) -> tuple[str, str, int]:
        """Return motion, model and number of the draw of a member."""
        number, which = divmod(place, len(self.bases))
        return list(self.motions)[number // self.draws], list(self.bases)[which], number

    def values(self, number: int) -> dict[str, float]:
        """Return what was drawn, key -> value [SI]."""
        return {v.key: float(x) for v, x in zip(self.varied, self.drawn[number], strict=True)}

    def own_values(self, model: str, number: int) -> dict[str, float]:
        """Return of that what a model has."""
        values = self.values(number)
        return {k: x for k, x in values.items() if model == WITH or k.rpartition(".")[0] not in self.named}

    def keys(self) -> list[str]:
        """Return the key of every member."""
        bases = {name: base.key() for name, base in self.bases.items()}
        motions = {name: motion_key(motion) for name, motion in self.motions.items()}
        places = (self.at(place) for place in range(len(self)))
        return [member_key(bases[m], motions[name], 1.0, self.own_values(m, n)) for name, m, n in places]

    def job(self, place: int) -> Shaken:
        """Return a member."""
        name, model, number = self.at(place)
        return Shaken(self.bases[model], tuple(self.own_values(model, number).items()), self.motions[name], 1.0)


def judge_consequence(
    model: Model | Path | str,
    motions: Sequence[str],
    folder: Path | str,
    *,
    diagnosis: Path | str | None = None,
    without: Sequence[str] = (),
    vary: Sequence[str] = (),
    drawn: int = 0,
    draws: int = 1,
    spectrum: ResponseSpectrum | Path | str | None = None,
    length_scale: float | None = None,
    seed: int = 1,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Consequence:
    """Shake a model with many earthquakes, with what was named and without it.

    Both models meet the same earthquakes, and of every size that both have the same draws. Sizes are independent of
    each other, each drawn from its interval.

    Args:
        model: the fitted one; or its model.toml; or a rig, with the paper's law.
        motions: of the bridge: files, folders of records, and descriptions.
        folder: of both models, of members.parquet, and of members.jsonl, from which a stopped run goes on.
        diagnosis: a diagnosis.json, or its folder: what was named, and the intervals of its sizes. A named effect that
            the model lacks is put in at its size.
        without: effects that the second model has not; what the diagnosis names when not given, or else all that the
            model has beside the base law.
        vary: "KEY=LOW..HIGH[unit]" each, as of `slipwise ensemble`: further numbers, uniform.
        drawn: how many earthquakes are drawn of each "quake:..." without a seed.
        draws: of the sizes at each motion.
        spectrum: of the bridge, or a file of it: every motion is scaled to it.
        length_scale: bridge over model [1]; that of the rig when not given, 1 for a rig without a prototype.
        seed: of the earthquakes and of the sizes.
        executor: that runs the replays, see `slipwise.jobs.executors`.
        workers: when no executor is given.
        progress: called with how many of how many replays are finished.

    Raises:
        SettingError: settings that cannot go together, or nothing that could be left out.
        SlipwiseError: a model, diagnosis, motion or spectrum that cannot be read.
    """
    if draws < 1 or drawn < 0:
        raise SettingError(f"--draws {draws}, --drawn {drawn}: at least one draw is needed, and no less than no motion")
    folder, notes = Path(folder), list[str]()
    found = None if diagnosis is None else read_diagnosis(diagnosis)
    whole, named = _whole_model(as_model(model), found, tuple(without), notes)
    if found is not None and found.rig not in ("", whole.specimen.name):
        notes.append(f"{found.path} is of {found.rig}: what was found there is put on {whole.specimen.name}")
    varied = _varied(whole, found, named, vary, notes)
    scale = length_scale if length_scale is not None else LENGTH_SCALE.get(whole.specimen.name, 1.0)
    if not (math.isfinite(scale) and scale > 0.0):
        raise SettingError(f"--length-scale {scale:g}: give the bridge's length over the model's, above 0")
    target = read_spectrum(spectrum) if isinstance(spectrum, str | Path) else spectrum
    shaking, left_out = list_earthquakes(motions, drawn, seed, target, scale)
    notes += [f"left out: {words}" for words in left_out]
    if scale != 1.0:
        notes.append(_SIMILARITY.format(scale))
    bases = _written({WITHOUT: whole.without(*named), WITH: whole}, folder)
    count = len(shaking) * draws
    drawn_values = draw(varied, count, "sobol", seed) if varied else np.zeros((count, 0))
    plan = _Plan(bases, shaking, draws, varied, drawn_values, named)
    began, keys = time.perf_counter(), plan.keys()
    finished = run_all(
        run_shaken, keys, plan.job, folder / "members.jsonl", executor=executor, workers=workers, progress=progress
    )
    seconds = time.perf_counter() - began
    path = folder / "members.parquet"
    write_members(_rows(plan, keys, finished), varied, path, of_models=True)
    values, failed = _paired(plan, keys, finished)
    if failed:
        notes.append(f"{failed} of {len(plan)} replays diverged; their motions are in no distribution")
    asked = [r for r in RESPONSES if r.name in _ASKED and (r.name != "buffer_force" or whole.specimen.buffers)]
    return Consequence(
        rig=whole.specimen.name,
        named=named,
        length_scale=scale,
        earthquakes=len(shaking),
        draws=draws,
        drawn=varied,
        distributions=tuple(
            Distribution(r, values[WITHOUT][r.name], values[WITH][r.name], to_bridge(r, scale)) for r in asked
        ),
        failed=failed,
        path=path,
        notes=tuple(notes),
        run=finished.run,
        seconds=seconds,
    )


def _whole_model(
    model: Model, found: Diagnosed | None, without: tuple[str, ...], notes: list[str]
) -> tuple[Model, tuple[str, ...]]:
    """Return the model with all that was named, and what the other one lacks of it."""
    if not model.specimen.free:
        raise SettingError(
            f"{model.specimen.name}: its slip is prescribed, so that no earthquake moves it; give a free rig"
        )
    for label in found.effects if found is not None else ():
        if not any(label in (use.label, use.effect.name) for use in model.uses):
            assert found is not None
            model = model.adding(use_diagnosed(found, label))
            notes.append(f"{label} is not in the model; it was put in at the size of {found.path.name}")
    faults = [use.label for use in model.uses if "gauge" in use.effect.hooks]
    if faults:
        notes.append(f"{', '.join(faults)}: faults of gauges do nothing to the bridge, and are left out")
        model = model.without(*faults)
    labels = [use.label for use in model.uses]
    if without:
        named = tuple(model[name].label for name in without)
    elif found is not None:
        named = tuple(label for label in found.effects if label in labels)
    else:
        named = tuple(use.label for use in model.uses if not use.effect.base)
    if not named:
        raise SettingError(
            "nothing is named that could be left out: the diagnosis names no effect of the bridge, or the model has "
            "the base law only; give --without EFFECT, or --diagnosis FOLDER of a campaign in which an effect was named"
        )
    return model, named


def _varied(
    model: Model, found: Diagnosed | None, named: tuple[str, ...], vary: Sequence[str], notes: list[str]
) -> tuple[Varied, ...]:
    """Return what is drawn; say where intervals are missing."""
    intervals: list[Varied] = []
    if found is not None:
        intervals, words = list_intervals(found, model, named)
        notes += words
    given = [read_varied(text, model) for text in vary]
    twice = {v.key for v in given}
    varied = (*(v for v in intervals if v.key not in twice), *given)
    if found is None:
        notes.append(
            "no interval of a size is known: a model.toml holds none. Give --diagnosis FOLDER, where diagnosis.json "
            f"has them, or --vary; until then {'all other' if varied else 'all'} sizes stay as the model has them"
        )
    return varied


def _written(models: Mapping[str, Model], folder: Path) -> dict[str, FileBase]:
    """Write both models, from which every process makes them."""
    bases = {}
    for name, model in models.items():
        path = folder / f"{name}.toml"
        path.unlink(missing_ok=True)
        save_model(model, path)
        bases[name] = FileBase(str(path.resolve()), sha256(path.read_bytes()).hexdigest())
    return bases


def _rows(plan: _Plan, keys: Sequence[str], finished: Finished) -> Iterator[dict[str, Any]]:
    for place, numbers in enumerate(finished.numbers(keys)):
        motion, model, number = plan.at(place)
        yield {"model": model, "motion": motion, "scale": 1.0, "member": number, **plan.values(number), **numbers}


def _paired(plan: _Plan, keys: Sequence[str], finished: Finished) -> tuple[dict[str, dict[str, Array]], int]:
    """Return model -> response -> values (n,) of the motions and draws that both models came through, and failures."""
    rows = list(finished.numbers(keys))
    pairs = [rows[i : i + len(plan.bases)] for i in range(0, len(rows), len(plan.bases))]
    whole = [pair for pair in pairs if not any("failed" in numbers for numbers in pair)]
    if not whole:
        raise SettingError("every replay diverged; try fewer or smaller motions, or `slipwise replay` with one of them")
    out = {
        model: {r.name: np.array([float(pair[i][r.name]) for pair in whole]) for r in RESPONSES}
        for i, model in enumerate(plan.bases)
    }
    return out, sum("failed" in numbers for numbers in rows)
