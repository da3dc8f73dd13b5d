"""Hostile and damaged folders: refused in a sentence with bounded time and memory, or read rightly."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from scipy.io import savemat

import slipwise as package
from shaking import needs_shared
from slipwise.campaign import load_campaign
from slipwise.errors import InputError, SlipwiseError
from slipwise.rig import load_specimen
from slipwise.rig.statics import at_rest

#: What a command may take of the machine: addresses of memory [bytes] and time [s].
MEMORY, SECONDS = 4 << 30, 60
RUN = "import resource, sys; resource.setrlimit(resource.RLIMIT_AS, (int(sys.argv.pop(1)),) * 2)\n" + (
    "from slipwise.cli import main; main()"
)


def command(*words: object, cwd: Path | None = None) -> tuple[int, str]:
    """Run the command line in a process of bounded memory; give its exit code and what it said."""
    path = os.pathsep.join([str(Path(package.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, "-c", RUN, str(MEMORY), *map(str, words)],
        capture_output=True,
        text=True,
        timeout=SECONDS,
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": path},
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("unit_power_tower", "'mm**9**9**9/mm' is no unit"),
        ("window_empty", "the window holds 0 samples, at least 16 are needed; the step is 0.002 s"),
        ("dt_1e-15", "its times advance by 1e-15 s; is the unit of the time right?"),
        ("wide", "a line has more than 4096 columns"),
        ("parquet", "of 100 rows cannot be read (Couldn't deserialize thrift"),
        ("mat", "not a readable MATLAB file"),
    ],
)
def test_a_hostile_folder_is_refused_in_a_sentence(slipwise, name, words):
    folder = needs_shared("faulty_inputs", "hostile", name)
    # those that took for ever or all memory run in a process of their own
    code, said = command("audit", folder) if name in ("unit_power_tower", "mat") else slipwise("audit", folder)[::2]
    assert code == 2 and words in said and "Traceback" not in said


def test_a_temperature_in_degrees_is_no_difference():
    campaign = load_campaign(needs_shared("faulty_inputs", "hostile", "derived_degC"))
    assert campaign.runs[0].record["pad_A_T"] == pytest.approx(293.15)


def test_the_code_of_a_strangers_folder_is_not_run(tmp_path):
    source = needs_shared("faulty_inputs", "hostile", "model_runs_code")
    folder = tmp_path / "campaign"
    shutil.copytree(source, folder)
    for words in (("compare",), ("audit",)):
        code, said = command(*words, folder, *(() if words == ("audit",) else ("--out", tmp_path / "o")), cwd=folder)
        assert "Traceback" not in said and code == (0 if words == ("audit",) else 2)
    assert not list(tmp_path.rglob("CODE_RAN"))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        (
            "fourbuffers",
            "the tendon 'buffer_4_x' has the coefficient -1.5 of the joint girder_yaw; from the places .* 0",
        ),
        ("g_child_mass", "the site girder_centre stands off the centre of gravity by 0, 0, -0.133333 m"),
        ("noactuator", "lacks the actuators table_apitch"),
    ],
)
def test_a_rig_whose_parts_contradict_each_other_is_refused(name, words):
    path = needs_shared("faulty_inputs", "hostile", "rigs", f"{name}.xml")
    with pytest.raises(InputError, match=words):
        load_specimen(path)


def test_six_pads_carry_the_girder_together():
    specimen = load_specimen(needs_shared("faulty_inputs", "hostile", "rigs", "pads6.xml"))
    assert specimen.pads == ("A", "B", "C", "D", "E", "F")
    assert sum(at_rest(specimen).load) == pytest.approx(specimen.mass * specimen.gravity, rel=1e-6)


def test_a_girder_off_the_middle_loads_the_nearer_pads_more(tmp_path):
    path = needs_shared("faulty_inputs", "hostile", "rigs", "g_pos_x.xml")
    assert load_specimen(path).centre_x == pytest.approx(0.3)
    code, said = command("replay", "sine:2Hz,0.05g,cycles=9", "--rig", path, "--no-pictures", "--no-recording", "--csv",
                         "--out", tmp_path)  # fmt: skip
    assert code == 0, said
    header, first = (tmp_path / "record.csv").read_text().splitlines()[:2]
    loads = dict(zip(header.split(","), map(float, first.split(",")), strict=True))
    specimen = load_specimen(path)
    apart = specimen.weight * 0.3 / (2.0 * specimen.half_spacing[0]) / 1e3
    assert loads["pad_A_N [kN]"] - loads["pad_B_N [kN]"] == pytest.approx(apart, rel=0.01)


SLIDER = 'rig = "pad"\n[constants]\npad_A_N = "1 kN"\n[[run]]\nfile = "{file}"\nrole = "fit"\n'


def test_a_small_matlab_file_that_unpacks_to_gigabytes_names_its_variable_and_shape(tmp_path):
    savemat(tmp_path / "a.mat", {"t": np.arange(9.0), "balloon": np.zeros((12_000, 9_000))}, do_compression=True)
    assert (tmp_path / "a.mat").stat().st_size < 2e6
    (tmp_path / "campaign.toml").write_text(SLIDER.format(file="a.mat"))
    code, said = command("audit", tmp_path)
    assert code == 2 and "the variable 'balloon' of 12000 x 9000 it unpacks to more than 800 MB" in said


def test_a_small_parquet_file_of_a_billion_rows_names_columns_and_rows(tmp_path):
    rows = 30_000_000
    zeros = pa.chunked_array([pa.array(np.zeros(1_000_000))] * (rows // 1_000_000))
    names = ["time [s]", "slip_x [mm]", "slip_y [mm]", "pad_A_N [kN]"]
    pq.write_table(pa.table({name: zeros for name in names}), tmp_path / "a.parquet", compression="zstd")
    assert (tmp_path / "a.parquet").stat().st_size < 1e6
    (tmp_path / "campaign.toml").write_text('rig = "pad"\n[[run]]\nfile = "a.parquet"\nrole = "fit"\n')
    code, said = command("audit", tmp_path)
    assert code == 2 and "4 columns of 30000000 rows are more than 800 MB" in said


TABLE = "time [s],slip_x [mm],pad_A_T [degC]\n" + "".join(f"{0.01 * i:.2f},{i % 7},20\n" for i in range(60))


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ('[specimen]\nmass = "-1 t"\n', "mass = -1000 kg cannot be; possible are 0.001 to 1e+08 kg"),
        ('[specimen]\nmass = "nan t"\n', "not a finite number"),
        ('[specimen]\nmass = "1e300 t"\n', "cannot be; possible are"),
        ('[specimen]\npad_stiffness = "1e30 N/m"\n', "pad_stiffness = 1e+30 N/m cannot be"),
        ('[specimen]\ngravity = "inf m/s^2"\n', "not a finite number"),
        ('[constants]\npad_B_T = "-400 degC"\n', "possible are 70 K to 2000 K: is its unit right"),
        ('[derived]\npad_B_T = "9000 degC"\n', "possible are 70 K to 2000 K: is its unit right"),
        ('[derived]\npad_B_P = "' + "(" * 400 + "1 kN" + ")" * 400 + ' / 1 m^2"\n', "more than 200 parts"),
        ('[derived]\npad_B_P = "' + "(" * 90 + "1 kN" + ")" * 90 + ' / 1 m^2"\n', "nested deeper than 20"),
        ('[derived]\npad_B_P = "slip_x ^ 99999999"\n', "powers up to 9 are read"),
        ("description = " + "[" * 5000 + "]" * 5000 + "\n", "not valid TOML"),
    ],
)
def test_settings_without_sense_are_refused_with_what_is_possible(tmp_path, settings, words):
    (tmp_path / "a.csv").write_text(TABLE)
    constants = "" if "[constants]" in settings else '[constants]\npad_A_N = "1 kN"\n'
    (tmp_path / "campaign.toml").write_text(
        f'rig = "pad"\n{settings}{constants}[[run]]\nfile = "a.csv"\nrole = "fit"\n'
    )
    with pytest.raises(SlipwiseError) as told:
        load_campaign(tmp_path)
    assert words in str(told.value)


def test_files_from_outside_the_folder_are_named(tmp_path):
    (tmp_path / "a.csv").write_text(TABLE)
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "campaign.toml").write_text(SLIDER.format(file="../a.csv"))
    assert "campaign.toml takes ../a.csv from outside its folder" in load_campaign(tmp_path / "inner").notes
