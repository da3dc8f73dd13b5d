"""The notebooks of the documentation still run; what is shipped is executed, small, and made from these sources."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "docs" / "notebooks").glob("*.py"))


@pytest.fixture(scope="module")
def maker():
    pytest.importorskip("nbconvert")
    spec = importlib.util.spec_from_file_location("make_notebooks", ROOT / "scripts" / "make_notebooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)
def test_what_is_shipped_is_executed_and_of_its_source(maker, source):
    nbformat = pytest.importorskip("nbformat")
    shipped = nbformat.read(source.with_suffix(".ipynb"), as_version=4)
    cells = [(cell.cell_type, cell.source) for cell in shipped.cells]
    assert cells == [(cell.cell_type, cell.source) for cell in maker.notebook(source.read_text()).cells]
    code = [cell for cell in shipped.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    assert not any(output.output_type == "error" for cell in code for output in cell.outputs)
    assert source.with_suffix(".ipynb").stat().st_size < maker.LARGEST
    assert f"notebooks/{source.stem}.md" in (ROOT / "mkdocs.yml").read_text()


@pytest.mark.long
@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)
def test_a_notebook_runs(maker, source, tmp_path, monkeypatch):
    if "ISOLATED_BUILDING" in source.read_text():
        building = ROOT.parent / "shared" / "building"
        if not building.is_dir():
            pytest.skip(f"{building} is not there: the measured building that this notebook reads")
        monkeypatch.setenv("ISOLATED_BUILDING", str(building))
    written = maker.write(maker.execute(source), source.stem, tmp_path)
    assert (tmp_path / f"{source.stem}.ipynb") in written
