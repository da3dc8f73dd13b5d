"""States that a hook may ask for although nobody measures them: rates, lags, and what has been since the last reversal.

Every effect that asks for one keeps all of them in its own block of memory, and they are brought up to date once per
instant, before any force of that instant is known. What takes friction takes that of the instant before.

A stroke ends where the motion turns back by more than a right angle and reaches `_RETURNED` of the speed that the
stroke had: below that it is noise of a pad that sticks. A pause or another run begins a new stroke.
"""

from math import exp, sqrt

from slipwise.arrays import Array
from slipwise.effects import DERIVED
from slipwise.jobs.machine_code import kept
from slipwise.simulation.kernel.compilable import compilable

#: Share of a stroke's largest speed at which motion against it is a reversal [1].
_RETURNED = 0.01
#: More steps than this between two instants are a gap: the finest steps are a tenth of the usual ones.
_GAP = 25.0
_NAMES = tuple(DERIVED)
_RATE, _LAGGED, _LOAD_RATE = (_NAMES.index(n) for n in ("speed_rate", "lagged_load", "load_rate"))
_SINCE, _WAY, _LAST_PEAK, _LAST_STROKE = (
    _NAMES.index(n) for n in ("time_since_reversal", "distance_since_reversal", "last_peak_speed", "last_stroke")
)
_SLID, _HEAT, _OUTWARD, _CURVATURE = (_NAMES.index(n) for n in ("slid", "heat", "outward", "path_curvature"))
#: Behind the states: time, velocity, begin of the stroke, its direction and largest speed; begin of a motion against it
#: and its way, whether there is one; whether anything has been observed.
_TIME = len(_NAMES)
_VX, _VY, _BEGIN, _X, _Y, _PEAK, _TURNED, _BACK, _TURNING, _BEGUN = range(_TIME + 1, _TIME + 11)
#: Numbers in one block.
SIZE = _TIME + 11


@compilable
def observe(
    memory: Array, friction: float, load: float, area: float, velocity_x: float, velocity_y: float, slip_x: float,
    slip_y: float, time: float, dt: float, time_constant: float,
) -> None:  # fmt: skip
    """Bring the states of a contact up to date, in place.

    Args:
        memory: (SIZE,) states, then what they are made from.
        friction: of the instant before [N].
        load: [N].
        area: apparent [m^2].
        velocity_x: slip rate [m/s].
        velocity_y: slip rate [m/s].
        slip_x: [m].
        slip_y: [m].
        time: [s].
        dt: usual time between two instants [s].
        time_constant: of what lags [s].
    """
    speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
    elapsed = time - memory[_TIME]
    if memory[_BEGUN] == 0.0 or elapsed <= 0.0 or elapsed > _GAP * dt:
        memory[_LAGGED] = load
        memory[_RATE] = memory[_LOAD_RATE] = memory[_CURVATURE] = memory[_LAST_PEAK] = memory[_LAST_STROKE] = 0.0
        memory[_VX], memory[_VY], memory[_X], memory[_Y], memory[_PEAK] = velocity_x, velocity_y, 0.0, 0.0, 0.0
        memory[_BEGIN], memory[_WAY], memory[_TURNING], memory[_BEGUN] = time, 0.0, 0.0, 1.0
    else:
        before = sqrt(memory[_VX] * memory[_VX] + memory[_VY] * memory[_VY])
        way = 0.5 * (before + speed) * elapsed
        memory[_RATE] = (speed - before) / elapsed
        kept = exp(-elapsed / time_constant)
        lagged = load + (memory[_LAGGED] - load) * kept
        memory[_LOAD_RATE] = (lagged - memory[_LAGGED]) / elapsed
        memory[_LAGGED] = lagged
        memory[_HEAT] = memory[_HEAT] * kept + friction * before / area * time_constant * (1.0 - kept)
        turned = abs(memory[_VX] * velocity_y - memory[_VY] * velocity_x)
        memory[_CURVATURE] = turned / (before * speed * way) if before * speed * way > 0.0 else 0.0
        memory[_SLID] += way
        _follow_stroke(memory, velocity_x, velocity_y, speed, way, time)
        memory[_VX], memory[_VY] = velocity_x, velocity_y
    memory[_SINCE] = time - memory[_BEGIN]
    outward = slip_x * velocity_x + slip_y * velocity_y
    memory[_OUTWARD] = 1.0 if outward > 0.0 else (-1.0 if outward < 0.0 else 0.0)
    memory[_TIME] = time


@compilable
def _follow_stroke(memory: Array, velocity_x: float, velocity_y: float, speed: float, way: float, time: float) -> None:
    """Carry the stroke on by a way [m], or begin another."""
    along = velocity_x * memory[_X] + velocity_y * memory[_Y]
    memory[_WAY] += way
    if along >= 0.0:
        memory[_TURNING] = 0.0
        if speed > _RETURNED * memory[_PEAK]:
            memory[_X], memory[_Y] = velocity_x / speed, velocity_y / speed
        memory[_PEAK] = max(memory[_PEAK], speed)
        return
    if memory[_TURNING] == 0.0:
        memory[_TURNING], memory[_TURNED], memory[_BACK] = 1.0, time, 0.0
    memory[_BACK] += way
    if speed > _RETURNED * memory[_PEAK]:
        memory[_LAST_PEAK], memory[_LAST_STROKE] = memory[_PEAK], memory[_WAY] - memory[_BACK]
        memory[_BEGIN], memory[_WAY], memory[_TURNING] = memory[_TURNED], memory[_BACK], 0.0
        memory[_X], memory[_Y], memory[_PEAK] = velocity_x / speed, velocity_y / speed, speed


@kept()
def observe_record(time, load, friction, velocity, slip, area, lag, memory, out):  # pragma: no cover - compiled
    """Let every pad's states follow a record; fills `out` (n, p, states).

    Load and friction are (n, p), velocity and slip (n, p, 2), memory is (p, SIZE); the rest as in `observe`.
    """
    count = out.shape[2]
    for pad in range(load.shape[1]):
        for i in range(len(time)):
            before = friction[max(i - 1, 0), pad]
            dt = time[1] - time[0]
            observe(
                memory[pad], before, load[i, pad], area, velocity[i, pad, 0], velocity[i, pad, 1], slip[i, pad, 0],
                slip[i, pad, 1], time[i], dt, lag,
            )  # fmt: skip
            out[i, pad] = memory[pad, :count]


def cool(memory: Array, seconds: float, time_constant: float) -> None:
    """Let a pause take the heat away, in place; memory as in `observe`."""
    memory[_HEAT] *= exp(-seconds / time_constant)
