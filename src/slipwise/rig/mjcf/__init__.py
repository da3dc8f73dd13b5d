"""The MJCF file of a rig: written of a specimen, and read into one, with all that it may hold."""
