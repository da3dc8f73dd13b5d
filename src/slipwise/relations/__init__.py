"""What a campaign's channels must satisfy, with a law of friction and without."""
