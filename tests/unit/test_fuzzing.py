"""What the fuzzing scripts damage can be read undamaged, and a few damaged files of every kind are refused in words."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fuzzing import MINE, WITH_CODE, targets
from slipwise.errors import InputError, SlipwiseError


def test_undamaged_files_are_read_and_code_beside_a_model_is_not_run(tmp_path: Path) -> None:
    refused = []
    for target in targets(tmp_path):
        try:
            target.try_with(target.data)
        except InputError as error:
            refused.append((target.data, str(error)))
    assert [data for data, _ in refused] == [WITH_CODE]
    assert "mine.py" in refused[0][1] and (tmp_path / "campaign" / "mine.py").read_text() == MINE


@pytest.fixture(scope="module")
def text_files(tmp_path_factory: pytest.TempPathFactory) -> list:
    found = targets(tmp_path_factory.mktemp("files"))
    return [t for t in found if t.path.suffix in (".toml", ".xml")]


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    which=st.integers(0, 4),
    places=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=3),
    put=st.sampled_from([b"", b"-", b"nan", b"1e999", b'"', b"[", b"}", b"\x00", b"\xff", b"m**9**9", b"degC", b"="]),
)  # fmt: skip
def test_damaged_settings_models_and_rigs_are_read_or_refused_in_words(text_files, which, places, put) -> None:
    target = text_files[which % len(text_files)]
    data = target.data
    for place in places:
        at = int(place * len(data))
        data = data[:at] + put + data[at + 1 :]
    try:
        target.try_with(data)
    except SlipwiseError as error:
        assert str(error)
