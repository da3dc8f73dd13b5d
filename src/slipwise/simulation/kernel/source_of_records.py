"""The text of the loops that drive the laws with what was measured."""

from slipwise.simulation.kernel.layout import Layout


def record_text(layout: Layout) -> str:
    """Write `pads_over_record` and `buffers_over_record`."""
    at = layout.at
    return f'''
def pads_over_record(u, time, load, velocity, slip, force, bounds, first, last):
    """Drive the law of pads first..last-1 with measured load (n, p), velocity and slip (n, p, 2).

    Fills force (n, p, 2) and bounds (n, p). Pads share nothing, so that several threads may each drive some. Where a
    pad sticks without a bristle, the law gives only the bound: force is then the bound along the motion.
    """
    bristle, further, remembers = u[{at["stick"]}] > 0.0, u[{at["pad"]}] > 0.0, u[{at["advance"]}] > 0.0
    first_dt = time[1] - time[0] if len(time) > 1 else u[{at["dt"]}]
    for pad in range(first, last):
        z = {at["pad_memory"]} + pad * {layout.pad_block}
        side_x = u[{at["side"]} + 2 * pad]
        side_y = u[{at["side"]} + 2 * pad + 1]
        for i in range(len(time)):
            dt = time[i] - time[i - 1] if i > 0 else first_dt
            velocity_x = velocity[i, pad, 0]
            velocity_y = velocity[i, pad, 1]
            slip_x = slip[i, pad, 0]
            slip_y = slip[i, pad, 1]
            bound = pad_bound(u, z, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt)
            if bristle:
                force_x, force_y = pad_explicit(
                    u, z, bound, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i], dt
                )
            else:
                speed = sqrt(velocity_x * velocity_x + velocity_y * velocity_y)
                share = bound / speed if speed > 0.0 else 0.0
                force_x = share * velocity_x
                force_y = share * velocity_y
            friction = sqrt(force_x * force_x + force_y * force_y) if further or remembers else 0.0
            if further:
                more_x, more_y = pad_further(
                    u, z, bound, friction, load[i, pad], velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time[i],
                    dt,
                )
                force_x += more_x
                force_y += more_y
            if remembers and i + 1 < len(time):
                # Half a step of speed makes an old contact look young: it is worn out over some micrometres.
                pad_advance(
                    u, z, bound, friction, load[i, pad], 0.5 * (velocity_x + velocity[i + 1, pad, 0]),
                    0.5 * (velocity_y + velocity[i + 1, pad, 1]), slip_x, slip_y, side_x, side_y, time[i],
                    time[i + 1] - time[i],
                )
            force[i, pad, 0] = force_x
            force[i, pad, 1] = force_y
            bounds[i, pad] = bound
    return 0


def buffers_over_record(u, time, deflection, rate, force):
    """Drive every buffer's law with measured deflection and rate (n, b, 2); fills force (n, b, 2)."""
    first_dt = time[1] - time[0] if len(time) > 1 else u[{at["dt"]}]
    for buffer in range(deflection.shape[1]):
        stiffness = u[{at["buffer_stiffness"]} + buffer]
        side = 1.0 - 2.0 * buffer
        for axis in range(2):
            z = {at["buffer_memory"]} + (2 * buffer + axis) * {layout.buffer_block}
            for i in range(len(time)):
                dt = time[i] - time[i - 1] if i > 0 else first_dt
                force[i, buffer, axis] = buffer_spring(
                    u, z, deflection[i, buffer, axis], rate[i, buffer, axis], stiffness, side, time[i], dt
                )
    return 0
'''
