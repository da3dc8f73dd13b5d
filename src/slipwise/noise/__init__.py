"""The noise of the gauges: how large it is, and how many independent samples a record holds."""
