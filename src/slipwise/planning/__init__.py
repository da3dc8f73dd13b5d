"""Before a test: which gauges and motions would show an effect, name it, and tell it from others."""
