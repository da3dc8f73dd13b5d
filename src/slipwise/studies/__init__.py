"""Studies made with the library."""
