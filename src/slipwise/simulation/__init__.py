"""The replay of a table motion in MuJoCo, and the laws driven by measured states."""
