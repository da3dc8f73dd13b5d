"""Another program's model, read back from its output, and what a campaign says of it."""
