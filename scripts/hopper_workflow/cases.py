"""What the report says of a hopper of the list `cases`, beside its page."""

from pathlib import Path


def verdict(artifact: str) -> str:
    """Return the outcome in words, a dash where there is no artifact yet."""
    if not Path(artifact).exists():
        return "\N{EM DASH}"
    from hopper_workflow import reading  # takes a second, and only a report asks

    return str(reading.read(artifact).outcome.item()).replace("_", " ")
