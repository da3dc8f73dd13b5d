"""The noise of the gauges: how large it is, and how many independent samples a record holds.

What this noise makes of a residual, a balance of the girder for one, is computed in `relations/noise.py`.
"""
