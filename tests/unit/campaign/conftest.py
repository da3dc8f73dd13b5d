"""A campaign of one slider in a folder."""

from pathlib import Path

import pytest

from unit.campaign.slider import RUNS, slider, text


@pytest.fixture
def campaign(tmp_path):
    """Write a campaign of two runs; give a function that says what else campaign.toml holds and what the files do."""

    def write(more: str = "", runs: str = RUNS, rig: str = "pad", **files: str | bytes) -> Path:
        folder = tmp_path / "slider"
        folder.mkdir(exist_ok=True)
        content: dict[str, str | bytes] = {"one": text(slider(1)), "two": text(slider(2)), **files}
        for name, written in content.items():
            path = folder / f"{name}.csv"
            path.write_bytes(written if isinstance(written, bytes) else written.encode())
        (folder / "campaign.toml").write_text(f'name = "slider"\nrig = "{rig}"\n{more}\n{runs}', encoding="utf-8")
        return folder

    return write
