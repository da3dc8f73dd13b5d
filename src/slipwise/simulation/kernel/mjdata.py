"""Where the fields of MuJoCo's data stand in memory, from MuJoCo's own description of its structs.

A compiled callback receives bare pointers. The offsets are worked out from `mujoco.introspect` by the C rules of
alignment and are checked against a live object before they are used.
"""

import ctypes
from dataclasses import dataclass
from functools import cache
from typing import Any

import mujoco
from mujoco.introspect import ast_nodes, structs

from slipwise.errors import SimulationError

_PLAIN: dict[str, type] = {
    "mjtNum": ctypes.c_double,
    "double": ctypes.c_double,
    "float": ctypes.c_float,
    "int": ctypes.c_int,
    "unsigned int": ctypes.c_uint,
    "mjtSize": ctypes.c_int64,
    "size_t": ctypes.c_size_t,
    "uintptr_t": ctypes.c_void_p,
    "uint64_t": ctypes.c_uint64,
    "mjtByte": ctypes.c_ubyte,
    "mjtBool": ctypes.c_ubyte,
    "char": ctypes.c_char,
}


@dataclass(frozen=True)
class Offsets:
    """Offsets in bytes of what the callbacks use.

    Attributes:
        data: field of mjData -> offset.
        contact_size: size of one mjContact.
        contact: field of mjContact -> offset.
    """

    data: dict[str, int]
    contact_size: int
    contact: dict[str, int]


def _ctype(node: Any) -> type:
    if isinstance(node, ast_nodes.PointerType):
        return ctypes.c_void_p
    if isinstance(node, ast_nodes.ArrayType):
        out = _ctype(node.inner_type)
        for extent in reversed(node.extents):
            out = out * extent
        return out
    name = str(getattr(node, "name", "")).removeprefix("struct ").rstrip("_")
    if name in _PLAIN:
        return _PLAIN[name]
    if name in structs.STRUCTS:
        return _structure(name)
    if name.startswith("mjt"):  # an enumeration
        return ctypes.c_int
    raise SimulationError(
        f"MuJoCo {mujoco.__version__} has a field of a type {name!r} that is not known here; use --engine python"
    )


@cache
def _structure(name: str) -> type[ctypes.Structure]:
    fields = [(field.name, _ctype(field.type)) for field in structs.STRUCTS[name].fields]
    return type(name, (ctypes.Structure,), {"_fields_": fields})


@cache
def offsets() -> Offsets:
    """Work the offsets out and check them against a live object.

    Raises:
        SimulationError: this build of MuJoCo lays its data out in another way.
    """
    data_fields = ("time", "ncon", "contact", "userdata", "ctrl", "qpos", "qvel", "qacc", "qfrc_applied",
                   "qfrc_constraint", "ten_length", "ten_velocity", "efc_frictionloss", "efc_pos", "efc_vel",
                   "efc_J", "efc_aref", "efc_force", "sensordata")  # fmt: skip
    data, contact = _structure("mjData"), _structure("mjContact")
    found = Offsets(
        data={name: getattr(data, name).offset for name in data_fields},
        contact_size=ctypes.sizeof(contact),
        contact={name: getattr(contact, name).offset for name in ("geom1", "geom2", "efc_address")},
    )
    _check(found)
    return found


def _check(found: Offsets) -> None:
    """Compare pointers and numbers read through the offsets with what the bindings show."""
    model = mujoco.MjModel.from_xml_string(_PROBE)
    live = mujoco.MjData(model)
    live.time = 0.125
    live.userdata[:] = [3.0, 4.0]
    mujoco.mj_forward(model, live)
    base = live._address
    plain = (
        "userdata",
        "ctrl",
        "qpos",
        "qvel",
        "qacc",
        "qfrc_applied",
        "qfrc_constraint",
        "ten_length",
        "ten_velocity",
    )
    for name in (*plain, "sensordata", "efc_J"):
        pointer = ctypes.c_void_p.from_address(base + found.data[name]).value
        if pointer != getattr(live, name).__array_interface__["data"][0]:
            raise SimulationError(_moved(name))
    if ctypes.c_double.from_address(base + found.data["time"]).value != live.time:
        raise SimulationError(_moved("time"))
    if ctypes.c_int.from_address(base + found.data["ncon"]).value != live.ncon or live.ncon != 2:
        raise SimulationError(_moved("ncon"))
    for name in ("efc_frictionloss", "efc_pos", "efc_vel", "efc_aref", "efc_force"):
        pointer = ctypes.c_void_p.from_address(base + found.data[name]).value or 0
        values = (ctypes.c_double * live.nefc).from_address(pointer)
        if list(values) != list(getattr(live, name)):
            raise SimulationError(_moved(name))
    start = ctypes.c_void_p.from_address(base + found.data["contact"]).value or 0
    for i, contact in enumerate(live.contact):
        for name, offset in found.contact.items():
            if ctypes.c_int.from_address(start + i * found.contact_size + offset).value != getattr(contact, name):
                raise SimulationError(_moved(f"contact.{name}"))


def _moved(name: str) -> str:
    return (
        f"MuJoCo {mujoco.__version__} keeps {name} elsewhere than its own description says; "
        "the compiled engine cannot be used with it: use --engine python"
    )


_PROBE = """
<mujoco><size nuserdata="2"/><worldbody><geom name="floor" type="plane" size="1 1 1" condim="1"/>
<body pos="0 0 0.09"><joint name="x" type="slide" axis="0 0 1"/><geom size="0.1" condim="1"/></body>
<body pos="1 0 0.09"><joint name="y" type="slide" axis="0 0 1"/><geom size="0.1" condim="1"/></body></worldbody>
<tendon><fixed name="t" frictionloss="2"><joint joint="x" coef="1"/></fixed></tendon>
<actuator><motor joint="x"/></actuator><sensor><jointpos joint="x"/></sensor></mujoco>
"""
