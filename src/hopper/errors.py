"""Typed errors. Messages are one line, in degrees, and name the remedy."""


class HopperError(Exception):
    """Base of every error this package raises on purpose."""


class InvalidParameterError(HopperError, ValueError):
    """An input is non-finite, out of range, or of an unknown kind."""


class WallFrictionError(HopperError):
    """The wall is rougher than the material can transmit: there is no wall angle psi_w."""


class NonPositiveStressError(HopperError):
    """The radial solution for these parameters has no positive average stress."""


class NoRadialSolutionError(HopperError):
    """No radial solution exists for this wall friction.

    ``largest_friction_angle`` (radians) is the largest wall friction that has one; None if not
    even a smooth wall has.
    """

    def __init__(self, message: str, largest_friction_angle: float | None) -> None:
        super().__init__(message)
        self.largest_friction_angle = largest_friction_angle


class NoLimitError(HopperError):
    """There is no such limit for a material and its wall; the message says why."""


class NowhereError(NoLimitError):
    """What the limit would bound is so for no hopper of that material and wall."""


class SingularVelocityError(HopperError):
    """The velocity equation is singular because psi reaches pi/4 at ``theta`` (radians)."""

    def __init__(self, message: str, theta: float) -> None:
        super().__init__(message)
        self.theta = theta


class TangencyError(HopperError):
    """A stress is beyond the tangency of a characteristic with the line on which it is given.

    No smooth march starts there; ``theta`` (radians) is where it is furthest beyond.
    """

    def __init__(self, message: str, theta: float) -> None:
        super().__init__(message)
        self.theta = theta


class ConvergenceError(HopperError):
    """An iteration did not reach an acceptable error; the message names the achieved one."""


def not_resolved_because(friction_angle: float) -> str:
    """Return why a solution for a wall friction (radians) may be hard to resolve, and a remedy."""
    if friction_angle > 0:
        return "psi is too close to its singular value, lower the wall friction"
    return "delta or the half angle is extreme, take another one"
