"""A fitted rig in the words of other structural programs, and what they cannot say."""
