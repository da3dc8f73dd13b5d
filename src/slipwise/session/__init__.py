"""A session: a campaign, a model that is worked at, and every step of that work, on disk as it is made."""
