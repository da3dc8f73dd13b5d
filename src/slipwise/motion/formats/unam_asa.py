"""UNAM ASA 2.0 (Mexico, "archivo estandar de aceleracion"): 109 lines of text, then one column a channel in gal.

Values of channels in the header stand between slashes: "/V/N00E/N90E". Source: the files' own headers.
"""

from slipwise.errors import InputError
from slipwise.motion.origin import Origin, time_in
from slipwise.motion.source_file import SourceFile, check_count, header_field, number, positive
from slipwise.motion.spaced_table import spaced_table
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, check_header_peak, half_last_digit

_HEADER_LINES = 109


def recognise(head: bytes) -> bool:
    """Tell whether the file says that it is a standard file of acceleration."""
    return b"ARCHIVO ESTANDAR DE ACELERACION" in head


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every channel of a file.

    Raises:
        InputError: a header line is missing or odd, or there are not as many rows as it says.
        UnitError: the unit is none of acceleration.
    """

    def field(key: str) -> str:
        return header_field(source, rf"^\s*{key}[^:]*:\s*(.*?)\s*$", 0, _HEADER_LINES, repr(key))[0][1]

    def parts(key: str) -> list[str]:
        return [part.strip() for part in field(key).strip("/").split("/")]

    names = parts(r"ORIENTACION C1-C6")
    steps = [positive(number(t, source.name), source.name, "the step") for t in parts(r"INTERVALO DE MUESTREO, C1-C6")]
    counts = [round(number(t, source.name)) for t in parts(r"NUM\. TOTAL DE MUESTRAS, C1-C6")]
    if not len(names) == len(steps) == len(counts) or len(set(steps)) > 1 or len(set(counts)) > 1:
        raise InputError(
            f"{source.name}: the channels {', '.join(names)} do not agree in steps ({steps}) or numbers of samples "
            f"({counts}); the header is damaged"
        )
    dt, dt_words = settle_step(steps[0], given, source)
    factor, unit_words = settle_unit(field("UNIDADES DE LOS DATOS"), given, source)
    table = spaced_table(source, range(_HEADER_LINES, len(source.lines)), len(names))
    check_count(len(table), counts[0], source, "NUM. TOTAL DE MUESTRAS")
    peaks, at = parts(r"ACEL\. MAX\.\(Gal\), C1-C6"), parts(r"ACEL\. MAX\., C1-C6")
    station = field("CLAVE DE LA ESTACION")
    event = field("FECHA DEL SISMO")
    start = time_in(f"{event} {field('HORA DE LA PRIMERA MUESTRA')}")
    traces = []
    for column, name in enumerate(names):
        values = table[:, column] * factor
        peak = None
        if column < len(peaks) and column < len(at) and peaks[column] and at[column]:
            # Samples are counted from 1.
            time = (number(at[column], source.name) - 1.0) * dt
            peak = HeaderPeak(
                number(peaks[column], source.name) * factor, time, half_last_digit(peaks[column]) * factor
            )  # fmt: skip
            check_header_peak(values, dt, peak, source, name)
        traces.append(
            Trace(
                source=source,
                name=name,
                title=f"{field('NOMBRE DE LA ESTACION')} {event}",
                dt=dt,
                acceleration=values,
                baseline="none",
                treatment=(f"read as UNAM ASA: {source.name}, channel {name}", f"{unit_words}; {dt_words}"),
                header_peak=peak,
                origin=Origin(station=station, event=event, start=start),
            )
        )
    return traces
