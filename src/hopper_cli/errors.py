"""Errors of the command; messages are one line and name the remedy."""

from hopper.errors import HopperError


class UsageError(HopperError):
    """An option is wrong, or a file cannot be written as asked; the message names the option."""
