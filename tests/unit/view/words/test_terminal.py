"""Tables in the terminal."""

import io

from rich.console import Console

from slipwise.view.words.terminal import cell, print_summary, print_table

SUMMARY = {
    "slip_x_half_range_mm": 24.79123, "slip_x_max_mm": 26.74, "energy_kN_cm": 642.4, "uplift_s": 0.0,
    "energy_balance_error": -6.3e-7, "dt_s": 0.0005, "steps": 13601, "wall_s": 4.1, "engine": "compiled",
    "pads": {p: {"N_min_kN": 12.79, "N_max_kN": 38.07, "F_max_kN": 3.6, "energy_kN_cm": 160.6} for p in "ABCD"},
}  # fmt: skip


def printed(function, *given) -> str:
    stream = io.StringIO()
    function(*given, Console(file=stream, width=100))
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
