"""`slipwise init` on tables as people write them: what is drafted reads as what was measured, or is marked."""

import re
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.campaign.draft import draft_campaign
from slipwise.errors import SlipwiseError
from unit.campaign.later_tables import last_tables, later_tables, newest_tables
from unit.campaign.tables_as_written import STEP, TWO, F, N, T, Written, X, all_tables, plain

TABLES = [*all_tables(), *later_tables(), *last_tables(), *newest_tables()]
_ENTRY = re.compile(
    r'^"(?P<header>.*)" = \{ channel = "(?P<channel>\w+)", unit = "(?P<unit>[^"]*)".*?# decide: (?P<sure>\w+)'
)


def outcome(table: Written, folder: Path) -> tuple[str, str]:
    """Give "right", "incomplete", "wrong" (and marked) or "wrong without a mark", and what is not right."""
    table.write(folder)
    try:
        draft, specimen = draft_campaign(folder)
    except SlipwiseError as error:
        return "incomplete", f"init: {error}"
    marks = {}
    lines = []
    for line in draft.splitlines():
        entry = _ENTRY.match(line)
        if entry:
            marks[entry["channel"]] = entry["sure"]
            # what a person fills in
            line = line.replace('unit = "?"', f'unit = "{table.units.get(entry["channel"], "m")}"')
        lines.append(line.replace("# [constants]", "[constants]"))
    lines = [line.replace('# pad_A_N = "10 kN"', 'pad_A_N = "500 N"') for line in lines]
    filled = {"pad_A_N"} if "# pad_A_N" in draft else set()
    (folder / "campaign.toml").write_text("\n".join(lines), encoding="utf-8")
    if specimen:
        (folder / "specimen.toml").write_text(specimen, encoding="utf-8")
    try:
        record = load_campaign(folder).runs[0].record
    except SlipwiseError as error:
        return "incomplete", f"read: {error}"
    found = {"time": record.time - record.time[0]} | dict(record.channels)
    made = " ".join(record.provenance.get("made", []))
    expected = {name: values - values[0] if name == "time" else values for name, values in table.channels.items()}
    expected.setdefault("time", STEP * np.arange(len(found["time"])))
    if table.units.get("pad_A_Fx") == "1":
        load = expected["pad_A_N"] if "pad_A_N" in expected else None
        expected["pad_A_Fx"] = expected["pad_A_Fx"] * load if load is not None else expected["pad_A_Fx"]
    found = {name: values for name, values in found.items() if name not in filled}
    wrong, lost = [], [name for name in expected if name not in found]
    for name, values in found.items():
        if name not in expected:
            if f"{name} is " not in made:
                wrong.append(name)
            continue
        if table.units.get(name) == "1" and "pad_A_P" in expected:
            continue
        scale = max(float(np.abs(expected[name]).max()), 1e-12)
        if len(values) != len(expected[name]) or np.abs(values - expected[name]).max() > 2e-3 * scale:
            wrong.append(name)
    if wrong:
        unmarked = [name for name in wrong if marks.get(name, "sure") == "sure"]
        return ("wrong without a mark" if unmarked else "wrong"), f"{wrong} of {sorted(found)}"
    return ("incomplete", f"not told: {lost}") if lost else ("right", "")


def test_there_are_sixty_tables_and_more_of_every_kind():
    assert len(TABLES) >= 60


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.name)
def test_a_table_as_people_write_it_is_drafted_so_that_it_reads_as_what_was_measured(table, tmp_path):
    verdict, why = outcome(table, tmp_path)
    assert verdict == "right", why


def test_columns_of_one_name_are_left_to_the_user_with_the_reason(tmp_path):
    table = plain("units alone", "Sec,mm,N,N", TWO, T, X, F, N)
    assert outcome(table, tmp_path)[0] == "incomplete"
    assert "not used: 2 columns have this name; give each its own" in (tmp_path / "campaign.toml").read_text()
