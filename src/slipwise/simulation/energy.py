"""The energy balance of a simulation, seen from the table.

    change of kinetic energy = work of the table's inertia forces and of gravity - friction - buffers + pads' contacts

Every term is summed from forces and motions by the trapezoidal rule, as a laboratory would from its channels; what does
not close is the error of the time step. Source: work and energy in a frame that moves with the table.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.rig import Rig, storey_names
from slipwise.simulation.sensor_channels import has_sensor, sensor


@dataclass
class EnergyBook:
    """Running sums over the chunks of a simulation [J].

    Attributes:
        table: work of the table's acceleration on the girder, in the table's frame.
        friction: dissipated and stored at the pads along x and y, (n_pads, 2).
        buffers: dissipated and stored in the buffers.
        others: work of gravity, of the columns of storeys, of the pads' contacts, of drag, of the shear keys' vertical
            friction and of the bending mode on the girder.
    """

    rig: Rig
    table: float = 0.0
    others: float = 0.0
    buffers: float = 0.0
    friction: Array | None = None
    turning: bool = False
    kinetic_start: float | None = None
    kinetic_end: float = 0.0
    _last: tuple[Array, Array] | None = None

    def add(self, sensordata: Array, control: Array) -> None:
        """Book a chunk: sensordata (n, n_sensors) and command (n, 4)."""
        self.turning = self.turning or bool(np.any(control[:, 3]))
        if not self.rig.specimen.free:
            return
        if self._last is not None:
            sensordata = np.concatenate([self._last[0], sensordata])
            control = np.concatenate([self._last[1], control])
        self._last = (sensordata[-1:].copy(), control[-1:].copy())
        if len(sensordata) < 2:
            return
        specimen, rig = self.rig.specimen, self.rig
        names = ("x", "y", "z", "roll", "pitch", "yaw")
        at = np.concatenate([sensor(rig, f"at_girder_{n}", sensordata) for n in names], axis=1)
        ends = np.concatenate([sensor(rig, f"rate_girder_{n}", sensordata[[0, -1]]) for n in names], axis=1)
        # The bending mode's mass moves with the girder horizontally and on its own spring vertically.
        rigid = specimen.mass - specimen.bending_mass
        mass = np.array([specimen.mass, specimen.mass, rigid])
        inertia = np.array([*mass, *(i * rigid / specimen.mass for i in specimen.inertia)])
        user = sensor(rig, "pads", sensordata)
        steps = np.diff(at, axis=0)
        push = -mass * control[:, :3]
        self.table += _work(push, steps[:, :3])
        self.others += _work(np.full((len(at), 1), -rigid * specimen.gravity), steps[:, 2:3])
        n_pads = len(specimen.pads)
        # Where the girder tilts, a pad pushes it sideways too, and from a place that slips: its compression knows both.
        self.others -= _work(user[:, 0 : 3 * n_pads : 3], np.diff(user[:, -n_pads:], axis=0))
        girder = [int(rig.model.joint(f"girder_{n}").dofadr[0]) for n in names]
        slip = np.diff(at @ rig.jacobian[:, girder].T, axis=0)
        force = np.empty((len(at), 2 * n_pads))
        force[:, 0::2], force[:, 1::2] = user[:, 1 : 3 * n_pads : 3], user[:, 2 : 3 * n_pads : 3]
        per_row = np.sum(0.5 * (force[1:] + force[:-1]) * slip[:, : 2 * n_pads], axis=0)
        done = per_row.reshape(n_pads, 2)
        self.friction = done if self.friction is None else self.friction + done
        self.buffers += _work(user[:, 3 * n_pads : -3 - n_pads], slip[:, 2 * n_pads :])
        self.others += _work(user[:, -3 - n_pads : -n_pads], steps[:, :3])
        if has_sensor(rig, "at_bending"):
            self._add_bending(sensordata, at)
        kinetic = 0.5 * np.sum(inertia * ends**2, axis=1)
        if specimen.storeys:
            rate = np.concatenate([sensor(rig, f"rate_girder_{n}", sensordata) for n in names], axis=1)
            kinetic += self._add_storeys(sensordata, control, at, rate)
        if self.kinetic_start is None:
            self.kinetic_start = float(kinetic[0])
        self.kinetic_end = float(kinetic[1])

    def _add_bending(self, sensordata: Array, at: Array) -> None:
        """Book the force of the mode's spring and damper on the girder."""
        specimen = self.rig.specimen
        omega = 2.0 * np.pi * specimen.bending_frequency
        q = sensor(self.rig, "at_bending", sensordata)
        rate = sensor(self.rig, "rate_bending", sensordata)
        pull = omega**2 * q - specimen.gravity + 2.0 * specimen.bending_damping * omega * rate
        spring = specimen.bending_mass * pull
        self.others += _work(spring, np.diff(at[:, 2:3], axis=0))

    def _add_storeys(self, sensordata: Array, control: Array, at: Array, rate: Array) -> Array:
        """Book what moves the floors and what their columns take; gives their kinetic energy at both ends (2,) [J]."""
        specimen, kinetic = self.rig.specimen, np.zeros(2)
        place, speed = at[:, :3].copy(), rate[:, :3].copy()
        for name, storey in zip(storey_names(specimen.storeys), specimen.storeys, strict=True):
            arm, moved = storey.z - specimen.centre_height, []
            for axis, (stiffness, damping) in enumerate(
                ((storey.stiffness_x, storey.damping_x), (storey.stiffness_y, storey.damping_y))
            ):
                bent = sensor(self.rig, f"at_{name}_{'xy'[axis]}", sensordata)
                bending = sensor(self.rig, f"rate_{name}_{'xy'[axis]}", sensordata)
                self.others -= _work(stiffness * bent + damping * bending, np.diff(bent, axis=0))
                place[:, axis : axis + 1] += bent
                speed[:, axis : axis + 1] += bending
                turned = (4, 1.0) if axis == 0 else (3, -1.0)  # pitch moves what is above along x, roll along -y
                moved.append([states[:, turned[0]] * turned[1] * arm for states in (at, rate)])
            along = place + np.stack([moved[0][0], moved[1][0], np.zeros(len(at))], axis=1)
            velocity = speed + np.stack([moved[0][1], moved[1][1], np.zeros(len(at))], axis=1)
            steps = np.diff(along, axis=0)
            self.table += _work(-storey.mass * control[:, :3], steps)
            self.others += _work(np.full((len(at), 1), -storey.mass * specimen.gravity), steps[:, 2:3])
            kinetic += 0.5 * storey.mass * np.sum(velocity[[0, -1]] ** 2, axis=1)
        return kinetic

    @property
    def dissipated(self) -> float:
        """Work against friction of all pads [J]."""
        return float(self.friction.sum()) if self.friction is not None else 0.0

    def error(self) -> float | None:
        """What does not close, as a fraction of the input [1]; None where slip is prescribed or the table turns."""
        if self.kinetic_start is None or self.turning:
            return None
        left = self.table + self.others - self.dissipated - self.buffers - (self.kinetic_end - self.kinetic_start)
        put_in = max(abs(self.table), self.dissipated)
        return left / put_in if put_in > 0.0 else 0.0


def _work(force: Array, steps: Array) -> float:
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * steps))
