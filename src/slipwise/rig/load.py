"""From the file of a rig to a specimen: every value that a replay uses, and a check that nothing else counts."""

from pathlib import Path
from typing import Any

from slipwise.errors import SettingError, UnknownNameError
from slipwise.rig.bounds import out_of_bounds
from slipwise.rig.files import find_rig
from slipwise.rig.mjcf.comparison import check_attributes, check_gravity
from slipwise.rig.mjcf.file import Mjcf, read_mjcf
from slipwise.rig.mjcf.inertia import girder_body, principal_inertia
from slipwise.rig.mjcf.parts import OF_EACH_PAD, WORDS, check_parts, is_free, names_of, pads_of
from slipwise.rig.mjcf.places import edge_distance, pad_places, pad_radii, seating
from slipwise.rig.mjcf.storeys import read_storeys
from slipwise.rig.mjcf.tendons import buffers, check_arms
from slipwise.rig.places import Place, values_of
from slipwise.rig.rest_check import check_rest
from slipwise.rig.specimen import Specimen
from slipwise.rig.specimen_file import read_specimen


def load_specimen(rig: str | Path, beside: Path | None = None) -> Specimen:
    """Read a specimen's rated values from its file.

    Args:
        rig: a name of `RIGS`, the path of a specimen.toml, or of an MJCF file that names its parts as they do.
        beside: folder from which a relative path is meant.

    Raises:
        UnknownNameError: no such rig.
        InputError: the file is no MJCF, a part is missing in it, it holds what would not be simulated, or its pads do
            not carry its weight at rest. The message names the element.
    """
    path = find_rig(rig, beside)
    if path.suffix == ".toml":
        return read_specimen(path)
    file = read_mjcf(path)
    check_parts(file)
    check_gravity(file)
    specimen = _specimen(file)
    check_attributes(file, specimen)
    check_rest(file, specimen)
    return specimen


def _specimen(file: Mjcf) -> Specimen:
    """Collect a specimen's values, each held to what a rig can have where its element can still be named."""
    model, girder = file.model, girder_body(file)
    pads, places = pads_of(file), _places(file)
    check_arms(file)
    numbers = {n: float(model.numeric(n).data[0]) for n in names_of(model, "numeric") if n not in OF_EACH_PAD}
    texts = {text.name: text.data for text in file.spec.texts}
    body = ("inertial", "", "girder") if file.spec.body("girder").explicitinertial else ("body", "girder", "")
    place = ("body", "girder", "")
    values: dict[str, tuple[Any, tuple[str, str, str]]] = {
        "mass": (girder.mass, body),
        "inertia": (principal_inertia(file, girder), body),
        "centre_height": (float(girder.centre[2]), place),
        "centre_x": (float(girder.centre[0]), place),
        "centre_y": (float(girder.centre[1]), place),
        "edge_distance": (edge_distance(file), ("site", "girder_edge_1", "")),
        "gravity": (-float(model.opt.gravity[2]), ("option", "", "")),
        **{name: (number, ("numeric", name, "")) for name, number in numbers.items()},
        **{name: (texts[name], ("text", name, "")) for name in WORDS if name in texts},
    }
    for name, (value, element) in values.items():
        if wrong := out_of_bounds(name, value):
            raise file.refused(wrong, *element)
    held = buffers(file)
    for part in (*places, *held):
        for name, value in values_of(part).items():
            if wrong := out_of_bounds(name, value):
                raise file.refused(wrong, *_element(name, part.name))
    try:
        return Specimen(
            name=file.path.stem,
            path=file.path,
            places=places,
            free=is_free(model),
            buffers=held,
            storeys=read_storeys(file),
            sources={n.removeprefix("source "): data for n, data in texts.items() if n.startswith("source ")},
            **{name: value for name, (value, _) in values.items()},
        )
    except (SettingError, UnknownNameError) as error:
        heavy = "bending_mass" in numbers and numbers["bending_mass"] >= values["mass"][0]
        word = next((name for name in WORDS if name in texts), f"pad_{pads[0]}")
        raise file.refused(str(error), *(("numeric", "bending_mass") if heavy else ("text", word))) from None


def _places(file: Mjcf) -> tuple[Place, ...]:
    """Collect what each pad is."""
    pads = pads_of(file)
    there = names_of(file.model, "numeric")
    of_each = [[float(v) for v in file.model.numeric(n).data] if n in there else [0.0] for n in OF_EACH_PAD]
    each = (given * (len(pads) if len(given) == 1 else 1) for given in of_each)
    rows = zip(pads, pad_places(file), seating(file), pad_radii(file), *each, strict=True)
    return tuple(Place(name, x, y, z, *rest) for name, (x, y), z, *rest in rows)


def _element(value: str, part: str) -> tuple[str, str]:
    """Return the kind and the name of the element that a value of a pad or a buffer stands in."""
    if value in OF_EACH_PAD:
        return "numeric", value
    if value.startswith("buffer"):
        return ("geom", f"buffer_{part}") if value == "buffer_places" else ("tendon", f"buffer_{part}_x")
    return "geom", f"pad_{part}"
