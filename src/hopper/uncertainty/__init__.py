"""Answers about hoppers whose numbers are known in ranges: extremes, shares, probabilities."""
