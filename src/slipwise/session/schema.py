"""What the file of a session holds: checked before anything in it is believed."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal, NotRequired, TypedDict

import msgspec

from slipwise.errors import InputError

#: Of the file; another version of the program may write another.
SCHEMA = 3

_Bound = Literal["", "lower", "upper"]


class _Term(TypedDict):
    effect: str
    targets: list[str]
    group: str
    own: NotRequired[list[str]]
    unused: NotRequired[dict[str, float]]


class _Suggested(_Term):
    values: dict[str, float]


class _Weights(TypedDict):
    terms: list[_Term]
    values: dict[str, float]
    finer: bool
    yaw: bool
    fitted: bool


class _State(TypedDict):
    terms: list[_Term]
    values: dict[str, float]
    weights: _Weights
    fitted: bool
    known: dict[str, tuple[float | None, float | None, _Bound, _Bound]]
    words: str
    edit: str


class _History(TypedDict):
    states: Annotated[list[_State], msgspec.Meta(min_length=1)]
    place: Annotated[int, msgspec.Meta(ge=0)]


class _Found(TypedDict):
    of: list[str]


class _Said(_Found):
    words: str


class _Screened(TypedDict):
    effect: str


class _Limit(TypedDict):
    size: float | None
    value: float | None
    parameter: str
    measured: bool
    peak_slip: NotRequired[float | None]
    energy: NotRequired[float | None]
    largest_load: NotRequired[float | None]


class _Explained(_Said):
    limits: NotRequired[dict[str, _Limit]]
    effects: list[str]
    minor: list[str]
    screened: list[_Screened]
    suggestion: list[_Suggested]
    file: NotRequired[Literal["diagnosis.html"]]


class _Discovered(_Said):
    files: list[str]


class _Place(TypedDict):
    relation: str
    words: str
    error: float


class _Located(_Found):
    instruments: str
    worst: str
    error: float
    places: list[_Place]
    cannot: list[str]


class _Reported(_Found):
    file: Literal["report.html"]


class _Findings(TypedDict, total=False):
    explain: _Explained
    discover: _Discovered
    locate: _Located
    report: _Reported
    next: _Said


class _Snapshot(TypedDict):
    campaign: str
    model: str
    history: _History
    reference: _State
    accepted: bool
    findings: _Findings


def checked(data: bytes, name: str) -> Mapping[str, Any]:
    """Read the file of a session.

    Args:
        data: its bytes.
        name: of the file, for messages.

    Raises:
        InputError: it is empty, cut off, of another version, or lacks what it must hold; the message says what.
    """
    if not data.strip(b"\0 \n"):
        raise InputError(f"{name} is empty")
    try:
        content = msgspec.json.decode(data)
        found = content.get("schema") if isinstance(content, dict) else None
        if found != SCHEMA:
            raise InputError(f"{name} is of another version (schema {found!r}; this one reads {SCHEMA})")
        msgspec.convert(content, _Snapshot)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise InputError(f"{name} is damaged ({error})") from None
    place, steps = content["history"]["place"], len(content["history"]["states"])
    if place >= steps:
        raise InputError(f"{name} is damaged (it is at step {place + 1} of {steps})")
    return content
