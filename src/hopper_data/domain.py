"""Tables of sweeps of wall friction, neutral curves and borders of the stable domain."""

from typing import get_args

from hopper.domain.stability_map import REGIONS
from hopper.radial.friction_limit import End
from hopper_data.tables import Table, angle, flag, number

ENDS = (*get_args(End), "none")

FRICTION: Table = (angle("phi", "angle of wall friction", "phi", "friction_angle"),)
SWEEP: Table = (
    number("abscissa", "supremum of Re(lambda)", "phi"),
    number("line", "abscissa of the asymptotic line", "phi"),
    number("highest_mode", "largest real part of a low mode", "phi"),
    number("abscissa_error", "error estimate of the abscissa", "phi", "error_estimate"),
    flag("region", "verdict, or why there is none", REGIONS, "phi"),
)
NEUTRAL_CURVE: Table = (
    angle("neutral_delta", "internal friction of neutral stability", "point", "delta"),
    angle("neutral_phi", "wall friction of neutral stability", "point", "friction_angle"),
)
DELTA: Table = (angle("delta", "angle of internal friction", "delta"),)
BORDERS: Table = (
    angle("limit_phi", "largest wall friction with a radial solution", "delta", "limit"),
    angle("limit_error", "error estimate of limit_phi", "delta"),
    flag("limit_end", "what ends the branch", ENDS, "delta", "end"),
    angle(
        "tangency_phi",
        "wall friction at which a characteristic is tangent, NaN where the limit comes first or "
        "the smooth wall is beyond it",
        "delta",
        "tangency",
    ),
    angle(
        "singular_velocity_phi",
        "wall friction at which psi reaches pi/4, NaN as before",
        "delta",
        "singular_velocity",
    ),
)
