"""A rig's file on the command line: what is refused is a sentence and exit code 2, and leaves nothing behind."""

import pytest

from changed_rigs import changed

MOTION = "sine:2Hz,0.2g,cycles=9"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            (
                "girder",
                '<body name="ballast"><joint name="swing"/><inertial pos="0 0 0" mass="5" diaginertia="1 1 1"/></body>',
            ),
            "line 66",
        ),
        (('mass="10000"', 'mass="0"'), "mass = 0 kg cannot be"),
        (('mass="10000"', 'mass="1e400"'), "line 53: mass='1e400' of the inertial must be finite"),
        (("</worldbody>", "</world>"), "mine.xml is no XML"),
        (('data="200e6"', 'data="200e9"'), "a step of 0.5 ms does not suit pads of 200000 kN/mm"),
    ],
    ids=["a body that swings", "no mass", "a number too large", "malformed", "pads too stiff for the step"],
)
def test_replay_refuses_a_rig_in_a_sentence_and_leaves_nothing(slipwise, tmp_path, change, words):
    (tmp_path / "rigs").mkdir()
    rig = changed(tmp_path / "rigs", change)
    code, said, error = slipwise(
        "replay", MOTION, "--rig", rig, "--out", tmp_path / "o", "--no-pictures", "--no-recording"
    )
    assert code == 2 and words in " ".join((said + error).split()) and "Traceback" not in said + error
    assert not (tmp_path / "o").exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["rigs"]


def test_a_campaign_on_a_refused_rig_names_the_element(slipwise, tmp_path):
    changed(tmp_path, ('<joint name="girder_x"', '<joint name="girder_x" damping="9"'))
    (tmp_path / "a.csv").write_text("time [s],slip_x [mm]\n" + "".join(f"{i / 100},{i % 7}\n" for i in range(60)))
    (tmp_path / "campaign.toml").write_text('rig = "mine.xml"\n[[run]]\nfile = "a.csv"\nrole = "fit"\n')
    code, said, error = slipwise("audit", tmp_path)
    assert code == 2 and "mine.xml, line 47: the joint 'girder_x' has damping = 9" in " ".join((said + error).split())


def test_a_rig_that_is_understood_is_replayed(slipwise, tmp_path):
    rig = changed(tmp_path, ('mass="10000"', 'mass="9000"'))
    code, said, error = slipwise(
        "replay", MOTION, "--rig", rig, "--out", tmp_path / "o", "--no-pictures", "--no-recording"
    )
    assert code == 0, said + error
    assert (tmp_path / "o" / "record.parquet").exists()
