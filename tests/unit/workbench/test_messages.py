"""Everything that a page may say is read as it stands; anything else is refused in words."""

import json

import numpy as np
import pytest

from slipwise.errors import SettingError
from slipwise.workbench.messages import Drag, Set, Undo, read_message

pytest.importorskip("websockets")
from mutated_messages import WHOLE, mutated  # noqa: E402  needs the extra


@pytest.mark.parametrize("message", WHOLE, ids=lambda message: message["do"])
def test_what_a_page_says_is_read_as_text_and_as_bytes(message):
    text = json.dumps(message)
    read = read_message(text)
    assert read == read_message(text.encode()) and type(read).__name__.lower() == message["do"]


def test_a_number_is_read_with_its_question_and_a_value_with_its_unit():
    assert read_message('{"do": "drag", "key": "rig.mass", "value": 1, "n": 3}') == Drag("rig.mass", 1.0, 3)
    assert read_message('{"do": "set", "key": "rig.mass", "value": "10 t"}') == Set("rig.mass", "10 t")
    assert read_message('{"do": "undo"}') == Undo()


@pytest.mark.parametrize("said", [
    "", "null", "[]", '"undo"', '{"do": null}', '{"do": "fly"}', '{"do": ["undo"]}', '{"do": "undo", "twice": true}',
    '{"do": "undo"}{"do": "undo"}', '{"do": "toggle"}', '{"do": "toggle", "effect": ["run_in"]}', "[" * 31_000,
    '{"do": "look", "run": ' + "[" * 31_000, '{"do": "set", "key": "rig.mass", "value": null}', "\ud800", b"\xff",
    '{"do": "set", "key": "rig.mass", "value": "' + "9" * 61 + '"}', '{"do": "toggle", "effect": "' + "x" * 501 + '"}',
    *(f'{{"do": "drag", "key": "rig.mass", "value": {value}, "n": 1}}' for value in
      ("NaN", "Infinity", "-Infinity", "1e999", "9" * 400, "[1]", '"1"', "true")),
    *(f'{{"do": "drag", "key": "rig.mass", "value": 1, "n": {n}}}' for n in (-1, 1.5, "1e3", 2**53, "9" * 5000)),
])  # fmt: skip
def test_what_does_not_fit_is_refused_in_words(said):
    with pytest.raises(SettingError, match="the workbench did not understand this request: ."):
        read_message(said)


def test_a_thousand_damaged_messages_are_read_or_refused_in_words():
    rng = np.random.default_rng(5)
    refused = 0
    for _ in range(1000):
        try:
            read_message(mutated(rng)[0])
        except SettingError as error:
            assert str(error)
            refused += 1
    assert 500 < refused < 1000
