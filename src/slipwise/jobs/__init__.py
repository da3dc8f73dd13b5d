"""Work on every core and on the disk: processes, kept results, files that are whole or not there."""
