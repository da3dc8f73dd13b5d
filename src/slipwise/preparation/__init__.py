"""A campaign as fits see it: each fault of a sample found, mended or masked, once for every command.

`prepare.py` lists the steps in the order in which they run. `sample_faults.py` finds a late logger, a wrong sign or
unit and a tared cell, `put_right.py` puts them right; what the logger's filter is, `logger.py` estimates.
"""
