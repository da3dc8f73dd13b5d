"""Tables in the terminal."""

import io
import re

from rich.console import Console

from slipwise.rig import RIGS
from slipwise.studies.campaigns import Outcome, Scored
from slipwise.view.words.campaign_tables import campaign_rows, score_rows
from slipwise.view.words.effects import effect_rows
from slipwise.view.words.terminal import cell, print_summary, print_table

SUMMARY = {
    "slip_x_half_range_mm": 24.79123, "slip_x_max_mm": 26.74, "energy_kN_cm": 642.4, "uplift_s": 0.0,
    "energy_balance_error": -6.3e-7, "dt_s": 0.0005, "steps": 13601, "wall_s": 4.1, "engine": "compiled",
    "pads": {p: {"N_min_kN": 12.79, "N_max_kN": 38.07, "F_max_kN": 3.6, "energy_kN_cm": 160.6} for p in "ABCD"},
}  # fmt: skip


def printed(function, *given, width: int = 100) -> str:
    stream = io.StringIO()
    function(*given, Console(file=stream, width=width))
    return stream.getvalue()


def test_columns_are_all_keys_in_order_and_a_missing_value_leaves_its_cell_empty():
    lines = printed(print_table, "Candidates", [{"effect": "run_in", "p": 0.97}, {"effect": "heating", "note": "late"}])
    assert lines.splitlines()[0].strip() == "Candidates"
    assert lines.index("effect") < lines.index(" p ") < lines.index("note")
    assert "0.97" in lines and "late" in lines and "None" not in lines


def test_brackets_are_printed_as_they_are():
    assert "N [kN] [bold]" in printed(print_table, "[red]t", [{"N [kN] [bold]": "[/]"}])


def test_a_summary_shows_every_number_with_its_unit_and_a_row_for_each_pad():
    text = printed(print_summary, SUMMARY)
    for part in ("24.79", "mm", "642.4", "kN cm", "compiled", "N min [kN]", "38.07"):
        assert part in text
    assert [line.split()[0] for line in text.splitlines() if line.strip()[:1] in tuple("ABCD")] == list("ABCD")


def test_a_summary_says_what_hangs_on_landings_only_where_pads_lifted():
    assert "several landings" not in printed(print_summary, SUMMARY)
    assert "several landings" in printed(print_summary, SUMMARY | {"uplift_s": 0.2})


def test_a_summary_without_pads_shows_what_there_is():
    assert "Pads" not in printed(print_summary, {"steps": 10})


def test_values_are_written_short():
    assert [cell(v) for v in (None, True, 1, 0.123456, ["a", 2.0], "x")] == ["", "yes", "1", "0.1235", "a, 2", "x"]


def test_names_of_the_catalogue_of_rigs_and_of_scored_campaigns_are_whole_at_eighty_columns():
    said = {"verdict": "effects", "effects": ["direction_asymmetry", "buffer_hysteresis"], "probability": 0.98,
            "base_error": 12.3, "final_error": 1.04, "seconds": 41.2}  # fmt: skip
    scored = [Scored(Outcome("m07_slider_second_logger", said), ("direction_asymmetry", "buffer_hysteresis"), True)]
    effects = [{key: row[key] for key in ("name", "equation", "summary")} for row in effect_rows()]
    rigs = [{"rig": name, "mass [t]": 10.0, "pads": 4, "pressure [MPa]": 16.88, "buffers [kN/mm]": 3.461,
             "frequency [Hz]": 2.961, "h/b": 0.122} for name in RIGS]  # fmt: skip
    campaigns = [Outcome("m07_slider_second_logger", {**said, "sizes": {}})]
    for rows in (score_rows(scored), campaign_rows(campaigns), effects, rigs):
        text = printed(print_table, "Names", rows, width=80)
        names = {word for row in rows for word in re.findall(r"\w+_\w+", str(next(iter(row.values()))))}
        assert names <= set(re.findall(r"\w+", text))


def test_a_table_that_has_no_room_is_written_in_blocks_and_no_name_is_broken():
    rows = [{"campaign": "march_of_the_third_year_with_the_new_plates",
             "effects": "direction_asymmetry + buffer_hysteresis",
             **{f"size of the number {i}": 1.0 + i for i in range(9)}}]  # fmt: skip
    text = printed(print_table, "2 campaigns", rows, width=80)
    for name in ("march_of_the_third_year_with_the_new_plates", "direction_asymmetry", "buffer_hysteresis"):
        assert name in text
    assert "size of the number 8: 9" in text


def test_a_table_keeps_to_the_width_of_the_terminal():
    rows = [
        {"rig": "three_pads", "mass [t]": 12.0, "buffers [kN/mm]": 2.4, "where it lies": "in a folder of its own " * 5}
    ]
    assert max(map(len, printed(print_table, "Rigs", rows, width=60).splitlines())) <= 60
