"""Code that lies beside data is run only where a person has said so: a folder may be a stranger's."""

from collections.abc import Collection
from pathlib import Path

from slipwise.errors import InputError, visible

#: Files of effects that may be run: none, those that are named, or all that a model names.
Trust = bool | Collection[Path | str]


def check_trusted(file: Path, named_in: Path, trust: Trust) -> None:
    """Refuse to run an effect file that nobody has named.

    Args:
        file: the effect file.
        named_in: the file that names it, for the message.
        trust: what may be run.

    Raises:
        InputError: it may not be run; the message says how to look at it and how to allow it.
    """
    if trust is True or (trust and file.resolve() in {Path(known).resolve() for known in trust}):
        return
    shown = visible(str(file))
    raise InputError(
        f"{named_in.name} names an effect file, {shown!r}: it is code, which can do with this machine what you can, "
        f"and is not run unasked. Look at it with a text viewer, for example `less '{shown}'`; then allow this file by "
        f"--effect '{shown}', or all that the model names by --trust (in Python: load_model(path, trust=True))"
    )
