"""`slipwise replay`: a table motion in, the record of every channel out."""

import time
from pathlib import Path
from shlex import quote
from typing import Annotated, Any

import typer

import slipwise as sw
from slipwise.cli.console import can_record, out_folder, print_json, progress, say, say_next
from slipwise.cli.options import Trusted
from slipwise.errors import SettingError, SlipwiseError

#: Rig that is shaken where none is said.
_RIG = "bridge1"


def replay(
    motion: Annotated[
        list[str], typer.Argument(help="Files of a recorded motion, or one synthetic: see `slipwise motions`.")
    ],
    rig: Annotated[
        str | None,
        typer.Option(
            help="A name of `slipwise rigs`, or the path of a specimen.toml or an MJCF file; bridge1 if not given."
        ),
    ] = None,
    model: Annotated[
        Path | None, typer.Option(help="A model.toml, for one that was fitted: its rig, its laws and their sizes.")
    ] = None,
    trust: Trusted = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("out/replay"),
    x: Annotated[
        str | None, typer.Option(help="What shakes along x: a component, a file, or none; - reverses it.")
    ] = None,
    y: Annotated[str | None, typer.Option(help="What shakes along y.")] = None,
    z: Annotated[str | None, typer.Option(help="What shakes upwards.")] = None,
    motion_dt: Annotated[str | None, typer.Option(help="Step of a text file without times, e.g. '0.005 s'.")] = None,
    unit: Annotated[str | None, typer.Option(help="Unit of a text file that states none: g, gal, m/s^2 ...")] = None,
    baseline: Annotated[
        str | None, typer.Option(help="mean, linear or none; by default what the format asks for.")
    ] = None,
    join_anyway: Annotated[
        bool, typer.Option("--join-anyway", help="Join components of different stations, sensors, events or times.")
    ] = False,
    count: Annotated[
        str | None, typer.Option(help="Acceleration of one count of a digitizer, e.g. '2.4e-6 m/s^2'.")
    ] = None,
    allow_short: Annotated[
        bool, typer.Option("--allow-short", help="Take a record that is a few values shorter than its header says.")
    ] = False,
    amplitude: Annotated[float, typer.Option("--scale", help="Factor on the acceleration.")] = 1.0,
    peak: Annotated[str | None, typer.Option(help="Scale to this peak along x, e.g. '0.7 g'.")] = None,
    similarity: Annotated[
        str | None, typer.Option(help="Shorten time as the model's: bridge1, bridge2 or a scale of length.")
    ] = None,
    pier: Annotated[
        str | None, typer.Option(help="Take the motion for the ground's; shake with the pier's top: bridge1, bridge2.")
    ] = None,
    start: Annotated[str, typer.Option(help="Begin at this time of the motion.")] = "0 s",
    end: Annotated[str | None, typer.Option(help="End at this time of the motion.")] = None,
    stroke: Annotated[
        str | None, typer.Option(help="Warn when the table would have to go farther, e.g. '150 mm'.")
    ] = None,
    step: Annotated[str, typer.Option(help="Time step of the simulation.")] = "0.5 ms",
    output_step: Annotated[str, typer.Option(help="Time step of the record.")] = "2 ms",
    effect: Annotated[
        list[str] | None, typer.Option(help="Switch an effect on, by name or file, at its typical size.")
    ] = None,
    law: Annotated[
        str | None,
        typer.Option(help="paper (eqs. 7 and 8), if not given, or coulomb: what the effects are added to."),
    ] = None,
    engine: Annotated[str, typer.Option(help="compiled, or python to step through with a debugger.")] = "compiled",
    csv: Annotated[bool, typer.Option("--csv", help="Write record.csv instead of record.parquet.")] = False,
    pictures: Annotated[bool, typer.Option(help="Draw the loops and histories.")] = True,
    recording: Annotated[bool, typer.Option(help="Write the recording for the rerun viewer.")] = True,
    json: Annotated[bool, typer.Option("--json", help="Print summary.json for a program to read.")] = False,
) -> None:
    """Replay a table motion on a rig.

    Example: `slipwise replay quake:seed=1,peak=0.7g,vertical=0.3g --rig bridge1 --out out/quake`
    """
    from slipwise.view.files import save_json

    recording = can_record(recording)
    seconds = None if motion_dt is None else sw.quantity(motion_dt, "s", "--motion-dt")
    treatment: Any = baseline  # one of the words that load_motion checks
    shaking = sw.load_motion(
        motion,
        x=x,
        y=y,
        z=z,
        dt=seconds,
        unit=unit,
        baseline=treatment,
        join_anyway=join_anyway,
        count=count,
        allow_short=allow_short,
    )
    if pier is not None and similarity is not None:
        raise SettingError("--pier shortens time by itself, as the model's; leave --similarity out")
    shaking = _shaped(shaking, amplitude, peak, similarity, start, end)
    if pier is not None:
        shaking = sw.pier_top(shaking, pier)
    sw.motion.warn_of_travel(shaking)
    if stroke is not None:
        sw.motion.warn_beyond_stroke(shaking, sw.quantity(stroke, "m", "--stroke"))
    used = _model(rig, law, effect or []) if model is None else _fitted_model(model, rig, law, effect or [], trust)
    given = {"dt": (step, "--step"), "output_dt": (output_step, "--output-step")}
    settings: dict[str, Any] = {name: sw.quantity(text, "s", option) for name, (text, option) in given.items() if text}
    new, folder = not out.exists(), out_folder(out)
    try:
        with progress("replay") as report:
            answer = sw.replay(used, shaking, engine=engine, progress=report, **settings)
    except sw.SimulationDiverged as error:
        _write_record(error.replay, folder, csv)
        raise
    except SlipwiseError:
        if new:
            folder.rmdir()  # what is refused leaves nothing behind
        raise
    began = time.perf_counter()
    files = [_write_record(answer, folder, csv)]
    written = time.perf_counter()
    files += _draw(answer, used, folder, shaking.title, pictures, recording) if pictures or recording else []
    numbers = answer.summary(shaking) | {"write_s": written - began, "draw_s": time.perf_counter() - written}
    files.append(save_json(numbers, folder / "summary.json"))
    if json:
        print_json(numbers)
    else:
        _tell(numbers, shaking, files)
        of = f"{rig or _RIG} is at its rated values" if model is None else f"the model is that of {model}"
        say_next(_next_step(folder, of, pictures, recording))


def _shaped(
    motion: "sw.TableMotion", amplitude: float, peak: str | None, similarity: str | None, start: str, end: str | None
) -> "sw.TableMotion":
    first, last = sw.quantity(start, "s", "--start"), None if end is None else sw.quantity(end, "s", "--end")
    scales = sw.rig.LENGTH_SCALE
    if first < 0.0:
        raise SettingError(
            f"--start {start!r} lies before the motion begins; give a time of 0 s to {motion.duration:g} s"
        )
    if first > 0.0 or last is not None:
        motion = sw.motion.trim(motion, first, last)
    if similarity is not None:
        try:
            motion = sw.motion.scale_time(motion, scales[similarity] if similarity in scales else float(similarity))
        except ValueError:
            possible = ", ".join(scales)
            raise SettingError(
                f"--similarity {similarity!r}: give {possible} or a scale of length, e.g. 10.69"
            ) from None
    if peak is not None:
        motion = sw.motion.scale_to_peak(motion, sw.quantity(peak, "m/s^2", "--peak"))
    return motion if amplitude == 1.0 else sw.motion.scale(motion, amplitude)


def _model(rig: str | None, law: str | None, effects: list[str]) -> "sw.Model":
    if law not in (None, "paper", "coulomb"):
        raise SettingError(f"--law {law!r}: possible are paper and coulomb")
    model = sw.base_model(rig or _RIG, () if law == "coulomb" else None)
    for name in effects:
        model = model.adding(sw.use(name))
    return model


def _fitted_model(file: Path, rig: str | None, law: str | None, effects: list[str], trust: bool) -> "sw.Model":
    """Return the model of a file, with those effects that it does not hold at their typical sizes."""
    if rig is not None or law is not None:
        raise SettingError(
            f"{file} says which rig it is and which law acts: leave --rig and --law out, or change {file.name}"
        )
    model = sw.load_model(file, trust=trust or effects)
    for added in map(sw.use, effects):
        model = model if added.effect.name in model else model.adding(added)
    return model


def _next_step(folder: Path, of: str, pictures: bool, recording: bool) -> str:
    if recording:
        return f"`slipwise view {quote(str(folder))}` shows the rig in motion"
    if pictures:
        return f"look at the pictures in {folder}"
    return f"read the record: `slipwise.read_record` in Python, or any program; {of}"


def _write_record(answer: "sw.Replay", folder: Path, csv: bool) -> Path:
    path = folder / ("record.csv" if csv else "record.parquet")
    sw.write_record(answer.record, path)
    return path


def _draw(
    answer: "sw.Replay", model: "sw.Model", folder: Path, title: str, pictures: bool, recording: bool
) -> list[Path]:
    from slipwise.view.geometry import geometry_of
    from slipwise.view.replay_files import draw_replay

    geometry = geometry_of(model.built_specimen())
    return draw_replay(answer.record, geometry, folder, title, pictures=pictures, recording=recording)


def _tell(numbers: dict, motion: "sw.TableMotion", files: list[Path]) -> None:
    from slipwise.view.words.terminal import print_summary

    print_summary(numbers)
    for words in motion.treatment:
        say(f"motion: {words}")
    for path in files:
        say(f"wrote {path}")
