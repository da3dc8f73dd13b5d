"""What a test says of a bearing in the terms of the standards: friction, energy, stiffness, damping, their bounds."""
