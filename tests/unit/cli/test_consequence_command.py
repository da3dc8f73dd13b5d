"""`slipwise consequence` writes a sentence, a picture and a table that say the same; bad input is one sentence."""

import csv
import json

import slipwise as sw


def test_sentence_picture_table_and_page_say_the_same(slipwise, tmp_path):
    sw.save_model(sw.base_model("bridge1").adding(sw.use("heating")), tmp_path / "model.toml")
    (tmp_path / "site.csv").write_text("period [s],acceleration [g]\n0.2,0.9\n0.6,0.9\n2.0,0.3\n")
    out = tmp_path / "out"
    words = (
        "consequence",
        tmp_path / "model.toml",
        "--motions",
        "quake:f=1.5Hz,strong=4s",
        "--drawn",
        "3",
        "--out",
        out,
    )
    code, said, _ = slipwise(*words, "--spectrum", tmp_path / "site.csv", "--workers", "1")
    assert code == 0
    content = json.loads((out / "consequence.json").read_text())
    assert content["words"] in said and content["words"].startswith("heating raises the 90 % peak slip of the bridge")
    assert content["words"] in (out / "consequence.html").read_text()
    rows = list(csv.DictReader((out / "consequence.csv").open()))
    slip = [row for row in rows if row["response"] == "peak slip [mm]"]
    assert [row["of"] for row in slip] == ["model", "bridge"]
    assert float(slip[1]["90 % with"]) / float(slip[0]["90 % with"]) > 10.6
    assert (out / "consequence.png").stat().st_size > 10_000
    assert "no interval of a size is known" in said
    assert sw.load_model(out / "without.toml").uses[-1].label == "shear_rate"


def test_a_model_without_anything_to_leave_out_and_a_folder_without_records_are_refused(slipwise, tmp_path):
    code, _, err = slipwise("consequence", "bridge1", "--drawn", "2", "--out", tmp_path / "out")
    assert code == 2 and "nothing is named that could be left out" in err
    (tmp_path / "records").mkdir()
    folder = ("--motions", tmp_path / "records", "--out", tmp_path / "out")
    code, _, err = slipwise("consequence", "bridge1", "--without", "shear_rate", *folder)
    assert code == 2 and "no motion can be read" in err
