"""The script itself: a fitted rig as commands of OpenSeesPy, to be run alone."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from slipwise.export.buffer_links import BufferLink
from slipwise.export.friction_fit import FrictionFit
from slipwise.rig import Specimen

#: Elastic slip before a slider gives way, over the largest slip [1]: OpenSees' sliders cannot stick rigidly, and slide
#: too far by about its root.
ELASTIC_SLIP = 1e-5
#: A step has converged at this share of the elastic slip [1].
_CONVERGED = 1e-2
#: Steps of the analysis in each step of the motion: a block that slides freely errs by 1.5 % with one, by 1 % with two.
_PARTS = 2


@dataclass(frozen=True)
class OpenSeesModel:
    """All that a script says.

    Attributes:
        specimen: as its effects leave it.
        frictions: pad -> friction model.
        curvatures: pad -> curvature of its sliding face [1/m].
        buffers: each along x and along y, in the order of the rig.
        drag: dashpots at the centre of gravity along x and y [N s/m].
        stick_stiffness: of each slider before it gives way [N/m].
        elastic_slip: that stiffness allows [m].
        dt: step of the motion and of the analysis [s].
        axes: of the table that move, of "xyz".
        data: name of the file of the motion, beside the script.
        title: of the motion.
        rig: and its effects, in words.
        remarks: where it differs from the model, in words.
    """

    specimen: Specimen
    frictions: Mapping[str, FrictionFit]
    curvatures: Mapping[str, float]
    buffers: Sequence[tuple[BufferLink, BufferLink]]
    drag: tuple[float, float]
    stick_stiffness: float
    elastic_slip: float
    dt: float
    axes: str
    data: str
    title: str
    rig: str
    remarks: Sequence[str]


def script_text(model: OpenSeesModel) -> str:
    """Return the text of the script."""
    parts = [_head(model), _girder(model), _pads(model), _buffers(model), _drag(model), _gravity(model), _shake(model)]
    return "\n".join(part for part in parts if part)


def _number(value: float) -> str:
    return repr(float(f"{value:.9g}"))


def _plain(words: str) -> str:
    """Return words that can stand in the script's docstring."""
    return words.replace("\\", "/").replace('"""', "'''")


def _head(model: OpenSeesModel) -> str:
    remarks = "".join(f"\n- {_plain(words)}" for words in model.remarks) or "\n- nothing"
    return f'''"""{_plain(model.rig)}

Shaken by: {_plain(model.title)}. The table's acceleration stands in {model.data}, beside this script.
Units: N, m, s, kg. Needs OpenSeesPy (pip install openseespy). Written by `slipwise export opensees`.
The last line that is printed is the largest slip along x. History of the run: the file of this script's name that ends
in _history.csv, columns as Slipwise names its channels.

Where this script differs from the model:{remarks}
"""

import sys
from pathlib import Path

import openseespy.opensees as ops

HERE = Path(__file__).resolve()
DT = {_number(model.dt)}  # step of the motion [s]
PARTS = {_PARTS}  # steps of the analysis in each: sliders turn round within a step, which costs accuracy

ops.logFile(str(HERE.with_name(HERE.stem + "_opensees.log")), "-noEcho")
ops.wipe()
ops.model("basic", "-ndm", 3, "-ndf", 6)
'''


def _girder(model: OpenSeesModel) -> str:
    s = model.specimen
    inertia = ", ".join(_number(x) for x in s.inertia)
    x, y, z = (_number(v) for v in (s.centre_x, s.centre_y, s.centre_height))
    lines = [
        "# the girder: one rigid body; node 1 is its centre of gravity. Displacements are relative to the table",
        f"ops.node(1, {x}, {y}, {z})",
        f"ops.mass(1, {_number(s.mass)}, {_number(s.mass)}, {_number(s.mass - s.bending_mass)}, {inertia})",
    ]
    if s.bending_mass:
        w = 6.283185307179586 * s.bending_frequency
        stiffness, damping = s.bending_mass * w * w, 2.0 * s.bending_damping * w * s.bending_mass
        lines += [
            "# its first bending mode: a mass on a vertical spring and dashpot",
            f"ops.node(2, {x}, {y}, {z})",
            f"ops.mass(2, 0.0, 0.0, {_number(s.bending_mass)}, 0.0, 0.0, 0.0)",
            "ops.fix(2, 1, 1, 0, 1, 1, 1)",
            f'ops.uniaxialMaterial("Elastic", 2, {_number(stiffness)}, {_number(damping)})',
            'ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 3)',
        ]
    return "\n".join(lines) + "\n"


def _friction(fit: FrictionFit, area: float) -> str:
    if fit.kind == "Coulomb":
        numbers = (fit.fast,)
    elif fit.kind == "VelDependent":
        numbers = (fit.slow, fit.fast, fit.rate)
    else:
        numbers = (fit.slow, fit.fast, area, fit.drop, fit.per_pressure, fit.rate)
    return f'"{fit.kind}", tag, ' + ", ".join(_number(x) for x in numbers)


def _pads(model: OpenSeesModel) -> str:
    s = model.specimen
    lines = [
        "# pads: sliders with a vertical spring and dashpot that only push. First node: the plate's side,",
        f"# over which the load moves; here the pads stand on the {s.pads_on}",
        'ops.uniaxialMaterial("Elastic", 1, 1e-3)  # no moment, no torsion',
        f"# a pad slides after an elastic slip of {1e6 * model.elastic_slip:.3g} um: STICK [N/m]",
        f"STICK = {_number(model.stick_stiffness)}",
        "PADS = {}  # name -> tag of its element; the girder's node is tag + 1, the table's tag",
    ]
    for number, place in enumerate(s.places):
        tag = 100 + 10 * number
        x, y, z = _number(place.x), _number(place.y), _number(place.z)
        curvature = model.curvatures[place.name]
        kind, radius = "flatSliderBearing", ""
        if curvature > 0.0:
            kind, radius = "singleFPBearing", f"{_number(1.0 / curvature)}, "
        plate, other, up = ("tag + 1", "tag", -1) if s.pads_on == "table" else ("tag", "tag + 1", 1)
        lines += [
            "",
            f'tag = PADS["{place.name}"] = {tag}',
            f"ops.node(tag, {x}, {y}, 0.0)",
            f"ops.node(tag + 1, {x}, {y}, 0.0)",
            "ops.fix(tag, 1, 1, 1, 1, 1, 1)",
            'ops.rigidLink("beam", 1, tag + 1)',
            f"ops.frictionModel({_friction(model.frictions[place.name], s.pad_areas[number])})",
            f'ops.uniaxialMaterial("Elastic", tag, {_number(place.stiffness)}, {_number(place.damping)})',
        ]
        spring = "tag"
        if place.z:
            strain = _number(place.z)
            lines.append(f'ops.uniaxialMaterial("InitStrain", tag + 1, tag, -{strain})  # the pad stands {z} m higher')
            spring = "tag + 1"
        lines += [
            f'ops.element("{kind}", tag, {plate}, {other}, tag, {radius}STICK,',
            f'            "-P", {spring}, "-T", 1, "-My", 1, "-Mz", 1, "-orient", 0, 0, {up}, 1, 0, 0,',
            '            "-iter", 100, 1e-8)  # by default 25 rounds to 1e-12, which double precision does not reach',
        ]
    return "\n".join(lines) + "\n"


def _buffers(model: OpenSeesModel) -> str:
    if not model.buffers:
        return ""
    lines = [
        "# buffers: springs between table and girder along x and y, which carry no weight",
        "BUFFERS = {}  # name -> tag of its element",
    ]
    for number, (buffer, links) in enumerate(zip(model.specimen.buffers, model.buffers, strict=True)):
        place = ", ".join(_number(v) for v in (buffer.x, buffer.y, buffer.z))
        lines += [
            "",
            f'tag = BUFFERS["{buffer.name}"] = {2000 + 20 * number}',
            f"ops.node(tag, {place})",
            f"ops.node(tag + 1, {place})",
            "ops.fix(tag, 1, 1, 1, 1, 1, 1)",
            'ops.rigidLink("beam", 1, tag + 1)',
            *_direction(links[0], "tag"),
            *_direction(links[1], "tag + 10"),
            'ops.element("zeroLength", tag, tag, tag + 1, "-mat", tag, tag + 10, "-dir", 1, 2)',
        ]
    return "\n".join(lines) + "\n"


def _direction(link: BufferLink, tag: str) -> list[str]:
    """Return the commands of the material of one direction, whose tag is `tag`."""
    damping = _number(link.damping)
    if not len(link.backbone) and not link.loop_force:
        return [f'ops.uniaxialMaterial("Elastic", {tag}, {_number(link.stiffness)}, {damping})']
    lines, parts = [], []
    if len(link.backbone):
        strains, forces = (", ".join(_number(v) for v in column) for column in link.backbone.T)
        lines += [
            f'ops.uniaxialMaterial("ElasticMultiLinear", {tag} + 1, {damping},',
            f'    "-strain", {strains},',
            f'    "-stress", {forces})',
        ]
    else:
        lines.append(f'ops.uniaxialMaterial("Elastic", {tag} + 1, {_number(link.stiffness)}, {damping})')
    parts.append(f"{tag} + 1")
    if link.loop_force:
        steep = _number(link.loop_force / link.loop_length)
        if link.rounded:  # Dahl's loop is Bouc and Wen's with n = 1 and gamma = 0
            numbers = f"0.0, {steep}, 1.0, 0.0, {_number(1.0 / link.loop_length)}, 1.0, 0.0, 0.0, 0.0"
            lines.append(f'ops.uniaxialMaterial("BoucWen", {tag} + 2, {numbers})')
        else:
            lines.append(f'ops.uniaxialMaterial("ElasticPP", {tag} + 2, {steep}, {_number(link.loop_length)})')
        parts.append(f"{tag} + 2")
    return [*lines, f'ops.uniaxialMaterial("Parallel", {tag}, {", ".join(parts)})']


def _drag(model: OpenSeesModel) -> str:
    if not any(model.drag):
        return ""
    s = model.specimen
    centre = ", ".join(_number(v) for v in (s.centre_x, s.centre_y, s.centre_height))
    return f"""# drag on the girder: dashpots between its centre of gravity and the table
ops.node(3, {centre})
ops.fix(3, 1, 1, 1, 1, 1, 1)
ops.uniaxialMaterial("Elastic", 3, 0.0, {_number(model.drag[0])})
ops.uniaxialMaterial("Elastic", 4, 0.0, {_number(model.drag[1])})
ops.element("zeroLength", 3, 3, 1, "-mat", 3, 4, "-dir", 1, 2)
"""


def _gravity(model: OpenSeesModel) -> str:
    s = model.specimen
    bending = ""
    if s.bending_mass:
        bending = f"\nops.load(2, 0.0, 0.0, {_number(-s.bending_mass * s.gravity)}, 0.0, 0.0, 0.0)"
    return f"""

def settings(tolerance):
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", tolerance, 30)
    ops.algorithm("Newton")


# weight, in ten steps
ops.timeSeries("Linear", 1)
ops.pattern("Plain", 1, 1)
ops.load(1, 0.0, 0.0, {_number(-(s.mass - s.bending_mass) * s.gravity)}, 0.0, 0.0, 0.0){bending}
settings(1e-10)
ops.integrator("LoadControl", 0.1)
ops.analysis("Static")
if ops.analyze(10) != 0:
    sys.exit("the girder does not stand on its pads: the analysis under its weight did not converge")
ops.loadConst("-time", 0.0)
ops.wipeAnalysis()
"""


def _shake(model: OpenSeesModel) -> str:
    s = model.specimen
    buffers = "BUFFERS" if model.buffers else "{}"
    x, y, h = (_number(v) for v in (s.centre_x, s.centre_y, s.centre_height))
    return f"""# the table's acceleration: columns x, y, z [m/s^2], one line a step
rows = [line.split() for line in HERE.with_name("{model.data}").read_text().splitlines() if not line.startswith("#")]
for axis in {[("xyz".index(a) + 1) for a in model.axes]!r}:
    ops.timeSeries("Path", 10 + axis, "-dt", DT, "-values", *[float(row[axis - 1]) for row in rows])
    ops.pattern("UniformExcitation", 10 + axis, axis, "-accel", 10 + axis)
settings({_number(_CONVERGED * model.elastic_slip)})
ops.integrator("Newmark", 0.5, 0.25)
ops.analysis("Transient")


def step():
    \"\"\"Go on by one step of the motion; where it does not converge, by other rules or smaller steps.\"\"\"
    left, part = DT, DT / PARTS
    while left > 1e-9 * DT:
        if go_on(min(part, left)):
            left -= min(part, left)
        elif part > DT / 1000:
            part /= 4
        else:
            sys.exit(f"the analysis did not converge at {{ops.getTime():.4f}} s")


def go_on(seconds):
    \"\"\"Make one step of the analysis; say whether it converged.\"\"\"
    if ops.analyze(1, seconds) == 0:
        return True
    ops.algorithm("ModifiedNewton", "-initial")  # slow and sure where sliders turn round
    ops.test("NormDispIncr", {_number(_CONVERGED * model.elastic_slip)}, 300)
    converged = ops.analyze(1, seconds) == 0
    ops.algorithm("Newton")
    ops.test("NormDispIncr", {_number(_CONVERGED * model.elastic_slip)}, 30)
    return converged


names = ["time [s]", "slip_x [m]", "slip_y [m]"]
names += [f"pad_{{pad}}_{{part}} [N]" for pad in PADS for part in ("N", "Fx", "Fy")]
names += [f"buffer_{{buffer}}_F{{axis}} [N]" for buffer in {buffers} for axis in "xy"]
peak = 0.0
with HERE.with_name(HERE.stem + "_history.csv").open("w") as history:
    history.write(",".join(names) + "\\n")
    for number in range(1, len(rows)):
        step()
        dx, dy, _, roll, pitch, yaw = ops.nodeDisp(1)
        values = [number * DT, dx - {h} * pitch + {y} * yaw, dy + {h} * roll - {x} * yaw]
        for tag in PADS.values():
            fx, fy, fz = ops.eleResponse(tag, "globalForce")[{"0:3" if s.pads_on == "table" else "6:9"}]
            values += [-fz, fx, fy]
        for tag in {buffers}.values():
            values += ops.eleResponse(tag, "force")[6:8]
        history.write(",".join(f"{{value:.9g}}" for value in values) + "\\n")
        peak = max(peak, abs(values[1]))
print(f"peak slip x [mm]: {{1e3 * peak:.6g}}")
"""
