"""A campaign as fits see it: each fault of a sample found, mended or masked, once for every command."""
