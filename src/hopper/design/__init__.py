"""The design of a hopper: how wide it may be, and how wide its outlet must be."""
