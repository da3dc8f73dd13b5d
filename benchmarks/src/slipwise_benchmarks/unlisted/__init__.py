"""Laws that are in no catalogue, in the form of the catalogue's files: what a diagnosis may only call unknown."""
