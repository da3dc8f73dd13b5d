"""The session: compare, see where it fails, learn what is missing, add it, watch the error fall, go back."""

import io
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign, as_campaign
from slipwise.diagnosis.result import Diagnosis
from slipwise.discovery.discover import diagnose_with_law, discover
from slipwise.discovery.result import Discovery
from slipwise.display import Drawn, Tabular
from slipwise.effects import Effect, Trust, catalogue
from slipwise.errors import SettingError
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.model.file import save_model
from slipwise.preparation.data_corrections import DataCorrection
from slipwise.session import changes
from slipwise.session.campaign_folder import CampaignFolder
from slipwise.session.evaluation import NOT_JUDGED, BalanceError, errors_of, evaluator
from slipwise.session.findings import discovered, explained, suggested
from slipwise.session.fitting import Progress, fit_state
from slipwise.session.kept import Kept, resumed
from slipwise.session.responses import RunReplay, replay_errors, replay_run
from slipwise.session.series import Series, list_balances, series_of
from slipwise.session.snapshot import Store
from slipwise.session.sources import Sources
from slipwise.session.state import SessionState, from_json


class Session(Drawn, Tabular):
    """A campaign and a model that is worked at; every step is on disk, and can be undone.

    Attributes:
        campaign: as it was recorded.
        ready: the campaign as fits see it.
        history: every step.
        reference: the state with which errors are compared: the last that was fitted at the beginning, or accepted.
        accepted: whether the model.toml beside the campaign holds that one.
        findings: "explain", "discover": what was found last, as plain data.
        notes: what a user should know of how the session was opened.
        place: folder of the campaign, as it was opened.
        store: the session's folder on disk; None for a session that leaves nothing there.
    """

    def __init__(
        self,
        campaign: Campaign | Path | str,
        model: Model | Path | str | None = None,
        *,
        trust: Trust = False,
        resume: bool = True,
        keep: bool = True,
    ) -> None:
        """Open a campaign, where the last session of it ended.

        Args:
            campaign: or its folder.
            model: or its model.toml; the model.toml beside the campaign, or the paper's law on its rig, if not given.
            trust: effect files that a model or the last session names and that may be run.
            resume: go on where the last session ended; else from the model as it is stated, and undo leads back.
            keep: keep every step on disk; another program cannot open the campaign meanwhile.

        Raises:
            InputError: the campaign lacks what every fit needs, an effect file is not trusted, or another program has
                this session open.
            OutputError: steps cannot be kept: the disk is full, for one.
        """
        self.campaign = as_campaign(campaign)
        self._sources = Sources(self.campaign, trust)
        self._file = self.campaign.folder / "model.toml"
        self.place = CampaignFolder(self.campaign.folder)
        self.store = Store(self.place) if keep else None
        try:
            stated = model if model is not None else self._file if self._file.is_file() else None
            self.ready, start = evaluator(self.campaign, None if stated is None else self._sources.model(stated))
            given = model is not None or not resume
            kept = resumed(self.store, self.campaign, self.ready, self._file, self._kept_effect, start, given=given)
            self.history, self.reference = kept.history, kept.reference
            self.notes = (*(self.store.notes if self.store is not None else ()), *kept.notes)
            self.accepted, self.findings = kept.accepted, dict(kept.findings)
            self.keep()
        except BaseException:
            self.close()
            raise

    @property
    def corrections(self) -> tuple[DataCorrection, ...]:
        """What was done about the data before any fit."""
        return self.ready.prepared.corrections

    @property
    def state(self) -> SessionState:
        """The step that is looked at."""
        return self.history.state

    @property
    def model(self) -> Model:
        """The model as it is now; `save_model` writes it, and `accept` does so beside the campaign."""
        return self.ready.model_of(self.state)

    def toggle(self, effect: str, target: str = "") -> SessionState:
        """Put an effect into the model with the size it had last, or a typical one; or take it out.

        Args:
            effect: its name, or the path of a user's file ("./mine.py").
            target: the channel or card ("pad_*_N"), for effects that need one.

        Raises:
            UnknownNameError: no such effect.
            SettingError: effects that cannot act together, or a target that is missing or is none.
        """
        return self.push(changes.toggled(self.ready, self.state, self.effect(effect), target))

    def set(self, key: str, value: float | str, *, keep: bool = True) -> SessionState:
        """Change one number of the model.

        Args:
            key: "rig.mass", "heating.share" ...
            value: SI, or a text with its unit ("10.1 t").
            keep: on disk too; not while a number is dragged, the next step does it.

        Raises:
            UnknownNameError: the model has no such number.
            SettingError: a value out of bounds.
            UnitError: a unit of the wrong dimension, or none.
        """
        return self.push(changes.with_number(self.ready, self.state, key, value), keep=keep)

    def errors(self, state: SessionState | None = None) -> tuple[BalanceError, ...]:
        """Return the error of every balance, component level, in floors: of the model as it is now, or of a state.

        Args:
            state: of this session; the model as it is now if not given.
        """
        state = state or self.state
        return errors_of(self.ready.objective(state), self.ready.residuals(state))

    def series(self, run: str, relation: str = "pads", state: SessionState | None = None) -> Series:
        """Return one balance of one run, measured and predicted: of the model as it is now, or of a state.

        Args:
            run: name of the run.
            relation: name of the balance; "pads" is what all bearings carry together where no pad's friction was
                measured.
            state: of this session; the model as it is now if not given.

        Raises:
            SettingError: no such run or balance.
        """
        state = state or self.state
        objective = self.ready.objective(state)
        names, relations = objective.run_names, list_balances(objective)
        if run not in names or relation not in relations:
            raise SettingError(
                f"no balance {relation!r} of run {run!r}; runs: {', '.join(names)}; balances: {', '.join(relations)}"
            )
        return series_of(objective, state, self.ready.residuals(state), names.index(run), relation)

    @one_thread_algebra()
    def fit(self, progress: Progress | None = None) -> SessionState:
        """Fit all numbers of the model to the runs that may be fitted.

        Args:
            progress: called with what is being done and the share done; what it raises ends the fit, and the session
                is as before.
        """
        return self.fitted(fit_state(self.ready, self.state, progress or (lambda words, share: None)))

    def fitted(self, state: SessionState) -> SessionState:
        """Take over a state that a fit has found, here or in another process.

        The first fit of the model as it was opened is what others are held against.

        Args:
            state: that the fit has found.
        """
        if not self.reference.fitted and state.terms == self.reference.terms:
            self.reference, self.accepted = state, False
        return self.push(state)

    def replay(self, state: SessionState | None = None, run: str = "") -> RunReplay:
        """Replay a run, the held-out one if none is named, from the table's motion; see `replay_run`.

        Args:
            state: of this session; the model as it is now if not given.
            run: name of the run; the held-out one if not given.
        """
        return replay_run(self.ready, state or self.state, run)

    def replay_errors(self, state: SessionState | None = None) -> dict[str, float]:
        """Return the held-out errors at system level in floors; see `responses.replay_errors`.

        Args:
            state: of this session; the model as it is now if not given.
        """
        return replay_errors(self.ready, state or self.state)

    def explain(self, progress: Progress | None = None) -> Diagnosis:
        """Say which effect the model lacks, as it is now; `take_suggestion` puts it in.

        Args:
            progress: is told what is being done, and the share that is done [1].
        """
        found = diagnose_with_law(self.ready.prepared, self.model, progress=progress)
        self.remember("explain", explained(found, self.state.labels))
        return found

    def discover(self, folder: Path | str | None = None, progress: Progress | None = None) -> Discovery:
        """Find the law of what the model lacks where the catalogue ends, and write it as an effect.

        Args:
            folder: that takes the effect file; the campaign's session folder if not given.
            progress: called with what is being done and the share done.
        """
        found = discover(self.ready.prepared, self.model, progress=progress)
        self.remember("discover", discovered(found, Path(folder or self.place.session_folder()), self.state.labels))
        return found

    def remember(self, kind: str, content: Mapping[str, Any]) -> None:
        """Keep a finding, made here or in another process.

        Args:
            kind: what was found, as the session's file names it.
            content: of the finding, as JSON can hold it.
        """
        self.findings[kind] = dict(content)
        self.keep()

    def take_suggestion(self) -> SessionState:
        """Put in what the last `explain` named, with the size that it found.

        Raises:
            SettingError: it named nothing that could be put in.
        """
        parts = suggested(self.findings.get("explain"), self._kept_effect)
        names = ", ".join(term.label for term, _ in parts)
        return self.push(changes.with_terms(self.ready, self.state, parts, f"{names} added, as suggested"))

    def accept(self, path: Path | str | None = None) -> Path:
        """Write the model as it is now; from here on errors are compared with it.

        Args:
            path: of the model.toml; the one beside the campaign if not given.
        """
        target = self._file if path is None else Path(path)
        self.place.check()
        save_model(self.model, target)
        self.reference, self.accepted = self.state, target.resolve() == self._file.resolve()
        self.keep()
        return target

    def undo(self) -> SessionState:
        """Go one step back; a SettingError says that there is none."""
        self.history = self.history.undone()
        self.keep()
        return self.state

    def redo(self) -> SessionState:
        """Go one step forward again; a SettingError says that there is none."""
        self.history = self.history.redone()
        self.keep()
        return self.state

    def beside(self, other: "Session | Model | Path | str") -> SessionState:
        """Return another model as a state of this session, judged by the same noise.

        Args:
            other: a model, of the same rig.

        Raises:
            SlipwiseError: a file that cannot be read, or effects that cannot act together.
        """
        model = other.model if isinstance(other, Session) else self._sources.model(other)
        return changes.as_stated(self.ready, self.state, self._sources.bounded(model))

    def compare_with(self, other: "Session | Model | Path | str") -> list[dict[str, Any]]:
        """Hold another model, as stated, against the same runs: a row for each balance, in floors; None: not judged.

        Args:
            other: a model, of the same rig.
        """
        there = {e.relation: e for e in self.errors(self.beside(other))}
        return [
            {"balance": e.name, "this model": e.error, "the other": there[e.relation].error}
            for e in self.errors()
            if e.relation in there
        ]

    def close(self) -> None:
        """Let another program open the campaign; what was done stays on disk."""
        if self.store is not None:
            self.store.close()

    def effect(self, name: str) -> Effect:
        """Return an effect of the model with its bounds there, which hold what was stated; or another.

        Args:
            name: of the effect, or the path of its file.
        """
        held = next((u.effect for u in self.ready.model.uses if u.effect.name == name), None)
        return held or self._sources.effect(name)

    def read_state(self, content: Mapping[str, Any], trust: Trust) -> SessionState:
        """Return a state that another process of the same user has written, and whose effect files it runs already.

        Args:
            content: as the session's file holds a state.
            trust: which effect files may be run.
        """
        sources = replace(self._sources, trust=trust)
        return from_json(content, lambda name: self._kept_effect(name, sources))

    def _kept_effect(self, name: str, sources: Sources | None = None) -> Effect:
        return self.effect(name) if name in catalogue() else (sources or self._sources).kept_effect(name)

    def push(self, state: SessionState, *, keep: bool = True) -> SessionState:
        """Take a state as the next step.

        Args:
            state: of this session.
            keep: whether it is written to disk at once.
        """
        self.history = self.history.pushed(state)
        if keep:
            self.keep()
        return state

    def keep(self) -> None:
        """Write every step to disk, as each does by itself; an OutputError says why not, and all stays in memory."""
        if self.store is not None:
            kept = Kept(self.history, self.reference, self.accepted, self.findings)
            self.store.write(kept.as_json(self.campaign, self._file))

    def _headline(self) -> str:
        fitted = "fitted" if self.state.fitted else "not fitted"
        worst = max(self.errors(), key=lambda e: -1.0 if e.error is None else e.error)
        left = NOT_JUDGED if worst.error is None else f"{worst.error:.3g} floors"
        effects = ", ".join(self.state.labels)
        return f"{self.campaign.name}: {effects} ({fitted}); worst in {worst.name}, {left}"

    def _rows(self) -> list[dict[str, Any]]:
        before = {e.relation: e.error for e in self.errors(self.reference)}
        return [
            {
                "balance": e.name,
                "before": before.get(e.relation),
                "now": NOT_JUDGED if e.error is None else e.error,
                **e.runs,
            }
            for e in self.errors()
        ]

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Return a notebook the table and the picture."""
        drawn = io.BytesIO()
        self.plot().savefig(drawn, format="png", dpi=90)
        picture = f'<img alt="error before and now" src="data:image/png;base64,{b64encode(drawn.getvalue()).decode()}">'
        return {"text/plain": repr(self), "text/html": self._repr_html_() + picture}
