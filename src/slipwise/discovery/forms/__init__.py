"""Forms: how a missing force may go with a state, one file each."""
