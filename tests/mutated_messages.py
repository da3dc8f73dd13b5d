"""Messages of the workbench's page, damaged at random, and a page that sends them and waits for the answers."""

import json
import threading
from contextlib import ExitStack
from typing import Any

import numpy as np
import pytest

client = pytest.importorskip("websockets.sync.client")
ConnectionClosed = pytest.importorskip("websockets.exceptions").ConnectionClosed

WHOLE: list[dict[str, Any]] = [
    {"do": "look", "run": "quake_hv", "relation": "pads", "beside": "before", "watches": True},
    {"do": "look", "run": "sine_hv", "relation": "girder", "beside": "model.toml"},
    {"do": "drag", "key": "rig.mass", "value": 9900.0, "n": 7},
    {"do": "settle"},
    {"do": "set", "key": "rig.mass", "value": "10.1 t"},
    {"do": "set", "key": "rig.buffer_stiffness", "value": 4.1e6},
    {"do": "toggle", "effect": "run_in", "target": ""},
    {"do": "toggle", "effect": "channel_gain", "target": "pad_A_N"},
    *({"do": name} for name in ("take", "law", "undo", "redo", "accept", "cancel", "fit", "next", "report")),
]
#: What is put in place of a value, or written into the text.
_VALUES: list[Any] = [
    None, True, -1, 0, 2**53, 10**400, 1e308, 5e-324, "", "x", "é" * 300, "\0", "\ud800", "__proto__", "../etc/passwd",
    "mine.py", "1e999 m", "9**9**9 t", "NaN", [], {}, [[]], {"do": "fit"}, ["rig.mass"], "a" * 5000,
]  # fmt: skip
_PIECES = [
    b"", b"{", b"}", b"[", b"]", b'"', b",", b":", b"\\", b"\\ud800", b"\0", b"\xff", b"\xc3", b"NaN", b"Infinity",
    b"-Infinity", b"1e999", b"9" * 400, b"[" * 31_000, b'{"a":' * 9_000, b"\x1b[2J", b"true", b"null", b"\xef\xbb\xbf",
]  # fmt: skip


def mutated(rng: np.random.Generator) -> tuple[bytes, bool]:
    """Damage a message; gives its bytes, and whether they are sent as text."""
    message = dict(WHOLE[rng.integers(len(WHOLE))])
    kind = rng.integers(8)
    if kind < 3:  # another value, a name that is not known, or one less
        names = list(message)
        name = names[rng.integers(len(names))]
        if kind == 0:
            message[name] = _VALUES[rng.integers(len(_VALUES))]
        elif kind == 1:
            message[f"{name}x"] = _VALUES[rng.integers(len(_VALUES))]
        else:
            del message[name]
    data = json.dumps(message).encode()
    if kind > 3:
        for _ in range(rng.integers(1, 4)):
            at, gone = rng.integers(len(data) + 1), rng.integers(6)
            put = _PIECES[rng.integers(len(_PIECES))] if rng.random() < 0.7 else rng.bytes(rng.integers(1, 5))
            data = data[:at] + put + data[at + gone :]
    if kind == 7 and rng.random() < 0.3:
        data = data[: rng.integers(len(data) + 1)]
    return data, bool(rng.random() < 0.8)


class Talker:
    """A page that says whatever it likes, hears everything, and comes back where the server hangs up."""

    def __init__(self, address: str) -> None:
        """Open the socket of a page; `address` is the page's."""
        self._address = address.replace("http", "ws") + "socket"
        self._open_ones = ExitStack()
        self._asked = 0
        self._heard = threading.Condition()
        self.problems: list[str] = []
        self.models: list[str] = []
        self.hung_up = -1
        self._open()

    def _open(self) -> None:
        self.hung_up += 1
        connection = client.connect(self._address, max_size=None, open_timeout=60)
        self._channel, self._gone = self._open_ones.enter_context(connection), False
        threading.Thread(target=self._listen, args=(self._channel,), daemon=True).start()

    def _listen(self, channel: Any) -> None:
        try:
            for told in channel:
                content = json.loads(told) if isinstance(told, str) else {}
                if content.get("kind") == "campaign":
                    self.models = content["models"]
                if content.get("kind") == "problem":
                    with self._heard:
                        self.problems.append(content["words"])
                        self._heard.notify_all()
        except ConnectionClosed:
            pass
        with self._heard:
            self._gone |= channel is self._channel
            self._heard.notify_all()

    def say(self, data: bytes, *, as_text: bool = True) -> bool:
        """Say something; False where the server has hung up before, and the next thing is said to it anew."""
        try:
            self._channel.send(data, text=as_text)
        except ConnectionClosed:
            self._open()
            return False
        return True

    def answered(self, seconds: float = 120.0) -> bool:
        """Ask something until it is answered: everything before it is over then; False where nobody answers."""
        self._asked += 1
        word = f"question-{self._asked}"
        while True:
            if not self.say(json.dumps({"do": word}).encode()):
                continue
            with self._heard:
                heard = self._heard.wait_for(lambda: self._gone or any(word in w for w in self.problems), seconds)
                if not self._gone:
                    return heard
            self._open()

    def close(self) -> None:
        """Go."""
        self._open_ones.close()
