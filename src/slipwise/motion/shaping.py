"""Motions made from motions: scaled, trimmed, tapered, their baseline treated. What was done is added to the words."""

from dataclasses import replace

import numpy as np

from slipwise.errors import InputError, SettingError
from slipwise.motion.baseline import without_baseline
from slipwise.motion.table_motion import AXES, Steady, TableMotion
from slipwise.motion.trace import Baseline


def scale(motion: TableMotion, factor: float) -> TableMotion:
    """Multiply the accelerations of all components.

    Raises:
        SettingError: the factor is zero or not finite.
    """
    if not np.isfinite(factor) or factor == 0:
        raise SettingError(f"a motion cannot be scaled by {factor!r}; give a finite factor other than 0")
    words = f"accelerations scaled by {factor:.6g}"
    return replace(motion, acceleration=motion.acceleration * factor, treatment=(*motion.treatment, words))


def scale_to_peak(motion: TableMotion, peak: float, axis: str = "x") -> TableMotion:
    """Multiply the accelerations of all components so that one axis reaches a peak.

    Args:
        motion: the motion.
        peak: largest absolute acceleration of the axis [m/s^2].
        axis: "x", "y" or "z".

    Raises:
        SettingError: no such axis, or a peak that is not positive.
        InputError: the axis is at rest.
    """
    if axis not in AXES:
        raise SettingError(f"a table has no axis {axis!r}; it has {', '.join(AXES)}")
    if not (np.isfinite(peak) and peak > 0):
        raise SettingError(f"a peak of {peak!r} m/s^2 is not possible; give a positive one")
    now = float(motion.peaks[AXES.index(axis)])
    if now == 0:
        raise InputError(f"{motion.title}: nothing moves in {axis}, so it cannot be scaled to a peak there")
    return scale(motion, peak / now)


def scale_time(motion: TableMotion, length_scale: float) -> TableMotion:
    """Shorten the time to that of a model: accelerations stay, time is divided by sqrt(length scale).

    Source: paper, Similarity law (acceleration 1, time the root of length). Speed-dependent friction, heating and
    pre-sliding do not follow it (see `slipwise.rig.similarity`).

    Args:
        motion: of the prototype.
        length_scale: prototype length over model length [1], e.g. 10.69 for bridge 1.

    Raises:
        SettingError: the scale is not positive.
    """
    if not (np.isfinite(length_scale) and length_scale > 0):
        raise SettingError(f"a length scale of {length_scale!r} is not possible; give a positive number")
    root = float(np.sqrt(length_scale))
    steady = motion.steady
    if steady:
        steady = Steady(steady.start / root, steady.end / root, steady.period / root)
    words = f"time divided by {root:.5g} (similarity, length scale {length_scale:g}), accelerations unchanged"
    return replace(motion, dt=motion.dt / root, steady=steady, treatment=(*motion.treatment, words))


def trim(motion: TableMotion, start: float = 0.0, end: float | None = None) -> TableMotion:
    """Keep the samples from start to end [s]; the first one kept becomes time 0.

    Raises:
        InputError: fewer than two samples lie between them.
    """
    stop = motion.duration if end is None else end
    # Half a millionth of a step: a time that was written as a sample's time means that sample.
    first = max(int(np.ceil(start / motion.dt - 1e-6)), 0)
    last = min(int(np.floor(stop / motion.dt + 1e-6)), len(motion) - 1)
    if last - first < 1:
        raise InputError(
            f"{motion.title}: between {start:g} and {stop:g} s lie fewer than two samples; "
            f"the motion lasts {motion.duration:g} s"
        )
    shift = first * motion.dt
    steady = motion.steady
    if steady:
        began, ended = max(steady.start - shift, 0.0), min(steady.end, last * motion.dt) - shift
        steady = Steady(began, ended, steady.period) if ended > began else None
    words = f"trimmed to {shift:.6g} ... {last * motion.dt:.6g} s"
    return replace(
        motion, acceleration=motion.acceleration[first : last + 1], steady=steady, treatment=(*motion.treatment, words)
    )


def treat_baseline(motion: TableMotion, how: Baseline) -> TableMotion:
    """Take "mean" or "linear" (or "none") from every component.

    Raises:
        SettingError: another word.
    """
    values = np.empty_like(motion.acceleration)
    words = []
    for column, axis in enumerate(AXES):
        values[:, column], done = without_baseline(motion.acceleration[:, column], how)
        words.append(f"{axis}: {done}")
    return replace(motion, acceleration=values, treatment=(*motion.treatment, *words))


def taper(motion: TableMotion, seconds: float) -> TableMotion:
    """Let the accelerations rise from zero and fall to zero along half a cosine at both ends, each of this length [s].

    Raises:
        SettingError: the length is not positive, or both ends together are longer than the motion.
    """
    if not (np.isfinite(seconds) and 0 < seconds <= motion.duration / 2):
        raise SettingError(
            f"a taper of {seconds!r} s is not possible; {motion.title} lasts {motion.duration:g} s, "
            "so give a positive length of at most half of that"
        )
    rise = np.clip(np.minimum(motion.time, motion.duration - motion.time) / seconds, 0.0, 1.0)
    weight = 0.5 * (1.0 - np.cos(np.pi * rise))
    words = f"tapered over {seconds:g} s at both ends"
    return replace(motion, acceleration=motion.acceleration * weight[:, None], treatment=(*motion.treatment, words))
