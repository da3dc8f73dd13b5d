"""Selection: one posterior over everything that may be missing, imperfections included, and what it proposes."""
