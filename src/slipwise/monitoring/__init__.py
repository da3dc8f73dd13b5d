"""A campaign on the day of its tests: what has come in is judged, run after run, and what is to come is waited for."""
