"""Comparison: how well does a model do on a campaign, at two levels, and exactly where does it fail?"""
