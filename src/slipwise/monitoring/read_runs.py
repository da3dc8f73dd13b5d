"""Read the runs of a watched folder, each file once: what cannot be used is told in a sentence, and left out."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from slipwise.campaign import Campaign
from slipwise.campaign.reader import MeasuredFile, assemble, read_file, specimen_of
from slipwise.campaign.settings import Source
from slipwise.errors import SlipwiseError
from slipwise.monitoring.folder import FileState, FolderState, state_of


@dataclass
class RunReader:
    """Reads runs, and keeps the files that it has read for as long as neither they nor campaign.toml change.

    Attributes:
        folder: of the campaign.
        basis: state of campaign.toml with which the files were read.
        files: `source` of a run -> the state in which a file was read, and what it holds.
        refused: file of a run that could not be used when it was last read -> why it is left out.
    """

    folder: Path
    basis: FileState | None = None
    files: dict[Source, tuple[FileState | None, MeasuredFile]] = field(
        default_factory=dict[Source, tuple[FileState | None, MeasuredFile]]
    )
    refused: dict[str, str] = field(default_factory=dict[str, str])

    def read(self, seen: FolderState) -> Campaign | None:
        """Read the runs whose files are whole; `refused` says why each that cannot be used is left out.

        Returns:
            The campaign of those that can be used together, in their order, None where there is none.

        Raises:
            SlipwiseError: the rig of campaign.toml cannot be used.
        """
        if self.basis != seen.campaign:
            self.files, self.basis = {}, seen.campaign
        settings, self.refused = seen.settings, {}
        specimen = specimen_of(self.folder, settings)
        campaign: Campaign | None = None
        usable = replace(settings, runs=())
        for run in settings.runs:
            try:
                state = seen.whole.get(run.file) or state_of(self.folder / run.file.rpartition("#")[0])
                if run.source not in self.files or self.files[run.source][0] != state:
                    file = read_file(self.folder / run.file, settings, specimen, settings.columns_of(run))
                    self.files[run.source] = state, file
                wider = replace(usable, runs=(*usable.runs, run))
                read = {source: file for source, (_, file) in self.files.items()}
                campaign, usable = assemble(self.folder, wider, specimen, read), wider
            except (SlipwiseError, OSError) as error:
                self.files.pop(run.source, None)
                self.refused[run.file] = f"{run.file} is left out: {' '.join(str(error).split())}"
        return campaign
