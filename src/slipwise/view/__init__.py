"""Pictures, recordings, reports and tables of finished results."""
