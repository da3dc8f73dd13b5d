"""Evidence: what an explanation is worth, against noise and against what matters."""
