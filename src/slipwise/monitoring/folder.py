"""What lies in a watched folder: which runs are whole, which are still being written, and which are to come."""

import time
from collections.abc import Container
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from slipwise.campaign.settings import RunSettings, Settings, read_settings
from slipwise.data_files.table import SUFFIXES
from slipwise.monitoring.half_written import how_it_ends

#: A file that has not changed for so long is no longer being written [s]; one whose last line is open, for so long.
_SETTLED, _OPEN = 1.0, 5.0


@dataclass(frozen=True)
class FileState:
    """A file as it was found.

    Attributes:
        size: in bytes.
        changed: time of its last change [ns].
    """

    size: int
    changed: int


@dataclass(frozen=True)
class FolderState:
    """What a look at the folder has shown.

    Attributes:
        settings: what campaign.toml says, of the runs those whose files are whole.
        whole: file -> its state.
        unfinished: file -> its state, of those that are still being written.
        notices: what is waited for, a sentence each.
        unnamed: files that are taken as runs though campaign.toml does not name them.
        model: state of model.toml, None where there is none.
        campaign: state of campaign.toml.
    """

    settings: Settings
    whole: dict[str, FileState]
    unfinished: dict[str, FileState]
    notices: tuple[str, ...]
    unnamed: tuple[str, ...]
    campaign: FileState | None
    model: FileState | None

    @property
    def key(self) -> tuple[object, ...]:
        """What a judgement rests on: another key asks for another judgement."""
        return self.campaign, self.model, tuple(sorted((n, s.size, s.changed) for n, s in self.whole.items()))


@dataclass
class Observer:
    """Looks at a folder again and again, and remembers since when each file has been as it is.

    Attributes:
        folder: of the campaign.
        taken: files that campaign.toml does not name and that are runs all the same, once they were taken.
        since: file -> its state, when it was first seen in it [s], and whether it was seen in another one before.
    """

    folder: Path
    taken: set[str] = field(default_factory=set[str])
    since: dict[str, tuple[FileState, float, bool]] = field(default_factory=dict[str, tuple[FileState, float, bool]])

    def look(self) -> FolderState:
        """Look once.

        Raises:
            InputError: there is no campaign.toml, or it cannot be used.
        """
        path = self.folder / "campaign.toml"
        settings = read_settings(path, runs_needed=False)
        campaign = state_of(path)
        listed = {_file_of(self.folder, run.file): run for run in settings.runs}
        found = {name: state for name in listed if (state := state_of(self.folder / name)) is not None}
        further = self._further(listed, campaign)
        notices = [f"{name}: no such file yet; it is waited for" for name in listed if name not in found]
        whole: dict[str, FileState] = {}
        unfinished: dict[str, FileState] = {}
        for name, state in {**found, **further}.items():
            taken, why = self._is_whole(name, state)
            (whole if taken else unfinished)[name] = state
            if why:
                notices.append(f"{name} {why}; it is waited for")
        runs = [run for run in settings.runs if _file_of(self.folder, run.file) in whole]
        unnamed = [name for name in further if name in whole]
        self.taken |= set(unnamed)
        runs += [RunSettings(name, "fit", None, None) for name in unnamed]
        return FolderState(
            replace(settings, runs=tuple(runs)), whole, unfinished, tuple(notices), tuple(unnamed), campaign,
            state_of(self.folder / "model.toml"),
        )  # fmt: skip

    def _further(self, listed: Container[str], campaign: FileState | None) -> dict[str, FileState]:
        """Return data files that campaign.toml does not name, and could not: they are younger, the oldest first."""
        found: dict[str, FileState] = {}
        for path in self.folder.iterdir():
            if (
                path.is_dir()
                or path.suffix.lower() not in SUFFIXES
                or path.name.startswith((".", "~"))
                or path.name in listed
            ):
                continue
            state = state_of(path)
            younger = state is not None and campaign is not None and state.changed > campaign.changed
            if state is not None and (younger or path.name in self.taken):
                found[path.name] = state
        return dict(sorted(found.items(), key=lambda pair: (pair[1].changed, pair[0])))

    def _is_whole(self, name: str, state: FileState) -> tuple[bool, str]:
        """Return whether a file is taken, and why not; nothing where it has only just been seen."""
        now = time.monotonic()
        before, since, grows = self.since.get(name, (state, now, False))
        if before != state:
            since, grows = now, True
        self.since[name] = state, since, grows
        try:
            endings = {how_it_ends(path) for path in _files_of(self.folder / name)}
        except OSError as error:  # it is being copied, or was taken away again
            return False, f"cannot be read ({error.strerror})"
        if now - since >= (_OPEN if "open" in endings else _SETTLED):
            cut = "cut" in endings
            return not cut, "ends in the middle of a line: it is half-written" if cut else ""
        return False, "is still being written" if grows else ""


def state_of(path: Path) -> FileState | None:
    """Return the state of a file, or of all files of a run that lies in a folder; None where there is none."""
    with suppress(OSError):
        found = [one.stat() for one in _files_of(path)]
        if found:
            return FileState(sum(one.st_size for one in found), max(one.st_mtime_ns for one in found))
    return None


def _files_of(path: Path) -> list[Path]:
    if path.is_dir():
        return [one for one in path.iterdir() if one.is_file() and not one.name.startswith(".")]
    return [path] if path.is_file() else []


def _file_of(folder: Path, name: str) -> str:
    """Return the file in which a run lies: "run.dat#2" is a table of run.dat."""
    if "#" in name and not (folder / name).exists():
        return name.rpartition("#")[0]
    return name
