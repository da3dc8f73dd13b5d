"""UNAM ASA 2.0 (Mexico, "archivo estandar de aceleracion"): lines of "label : value", then one column a channel in gal.

Values of channels stand between slashes: "/V/N00E/N90E". The values begin below the second ruler that follows "DATOS DE
ACELERACION". Labels differ by their blanks, points, case and accents from network to network, so only their letters
are compared. Source: the files' own headers.
"""

import re

from slipwise.data_files.words import folded
from slipwise.errors import InputError
from slipwise.motion.number_rows import table_of_numbers
from slipwise.motion.orientation import orientation
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, check_count, is_number, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_LOOK_AT = 200
_DATA, _RULER = "DATOSDEACELERACION", re.compile(r"\s*--[-+\s]*")


def recognise(head: bytes) -> bool:
    """Return whether the file says that it is a standard file of acceleration."""
    return "ARCHIVOESTANDARDEACELERACION" in _letters(head.decode("utf-8", "replace"))


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every channel of a file.

    Raises:
        InputError: a header line is missing or odd, or there are not as many rows as it says.
        UnitError: the unit is none of acceleration.
    """
    first = _first_row(source)
    header = [line.partition(":") for line in source.lines[:first]]

    def values(label: str, without: str = "MUESTRA", needed: bool = True) -> list[str]:
        """Return what stands behind the labels that begin so; channels 7 to 12 have a line of their own."""
        letters = _letters(label)
        found = [
            value.strip()
            for key, _, value in header
            if _letters(key).startswith(letters) and (not without or without not in _letters(key)[len(letters) :])
        ]
        if not found and needed:
            raise InputError(f"{source.name}: the header does not state {label}; it is damaged, fetch the file again")
        return found

    def parts(label: str, without: str = "MUESTRA", needed: bool = True) -> list[str]:
        lists = [value.strip("/ ") for value in values(label, without, needed)]
        return [part.strip() for value in lists if value for part in value.split("/")]

    def text(label: str) -> str:
        return next(iter(values(label, needed=False)), "")

    names = [_known(name) for name in parts("ORIENTACION")]
    steps = [positive(number(t, source.name), source.name, "the step") for t in parts("INTERVALO DE MUESTREO")]
    counts = [round(number(t, source.name)) for t in parts("NUM. TOTAL DE MUESTRAS")]
    if not len(names) == len(steps) == len(counts) or len(set(steps)) > 1 or len(set(counts)) > 1:
        raise InputError(
            f"{source.name}: the channels {', '.join(names)} do not agree in steps ({steps}) or numbers of samples "
            f"({counts}); the header is damaged"
        )
    dt, dt_words = settle_step(steps[0], given, source)
    unit = values("UNIDADES DE LOS DATOS")[0]
    factor, unit_words = settle_unit(unit, given, source)
    table = table_of_numbers(source, range(first, len(source.lines)), len(names))
    check_count(len(table), counts[0], source, "NUM. TOTAL DE MUESTRAS", given.allow_short)
    peaks = parts("ACEL. MAX.", needed=False)
    at = parts("ACEL. MAX., C1-C6, EN LA MUESTRA", without="", needed=False)
    station, event = text("CLAVE DE LA ESTACION"), text("FECHA DEL SISMO")
    start = time_in(f"{event} {text('HORA DE LA PRIMERA MUESTRA')}")
    traces = []
    for column, name in enumerate(names):
        peak = None
        if column < len(peaks) and is_number(peaks[column]):
            # Samples are counted from 1.
            time = (float(at[column]) - 1.0) * dt if column < len(at) and is_number(at[column]) else None
            size = number(peaks[column], source.name) * factor
            peak = HeaderPeak(size, time, half_last_digit(peaks[column]) * factor, f"{peaks[column]} {unit}")
        traces.append(
            Trace(
                source=source,
                name=name,
                title=f"{text('NOMBRE DE LA ESTACION')} {event}".strip() or source.stem,
                dt=dt,
                acceleration=table[:, column] * factor,
                treatment=(f"read as UNAM ASA: {source.name}, channel {name}", f"{unit_words}; {dt_words}"),
                header_peak=peak,
                origin=MotionOrigin(station=station, event=event, start=start),
                aliases=(f"C{column + 1}", str(column + 1)),
            )
        )
    return traces


def _first_row(source: SourceFile) -> int:
    """Return the index of the first row of values.

    Raises:
        InputError: no two rulers stand below "DATOS DE ACELERACION".
    """
    head = source.lines[:_LOOK_AT]
    data = next((i for i, line in enumerate(head) if _letters(line).startswith(_DATA)), 0)
    rulers = [i for i, line in enumerate(head) if i > data and _RULER.fullmatch(line)]
    if len(rulers) < 2:
        raise InputError(
            f"{source.name}: the values of a standard file of acceleration stand below two rulers of hyphens under "
            "DATOS DE ACELERACION, which are not there; it is damaged, fetch the file again"
        )
    return rulers[1] + 1


def _known(name: str) -> str:
    """Return the part of "L;N65E" (axis and bearing) that says where the channel points."""
    parts = [part.strip() for part in name.split(";")]
    return next((part for part in reversed(parts) if orientation(part) != "unknown"), name)


def _letters(text: str) -> str:
    return re.sub(r"[^A-Z0-9]", "", folded(text).upper())
