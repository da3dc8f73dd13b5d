"""What a campaign's channels must satisfy, with a law of friction and without.

`run_data.py` holds what a fit sees of a run, `stages.py` the way from there to the residuals, `noise.py` what divides
them, `table.py` their order and their sums of squares. `rigid_balances.py` are the relations of the audit.
"""
