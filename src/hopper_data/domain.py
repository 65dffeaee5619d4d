"""Tables of sweeps of wall friction, neutral curves and borders of the stable domain."""

from typing import get_args

from hopper.domain.neutral_curve import CURVE_ENDS
from hopper.domain.stability_map import GOVERNED_BY, PARITY, REGIONS
from hopper.radial.friction_limit import End
from hopper.stability.modes import GOVERNORS
from hopper_data.tables import Table, angle, flag, number

ENDS = (*get_args(End), "none")

FRICTION: Table = (angle("phi", "angle of wall friction", "phi", "friction_angle"),)
SWEEP: Table = (
    flag("region", "verdict, or why there is none", REGIONS, "phi"),
    number("abscissa", "supremum of Re(lambda)", "phi"),
    number("abscissa_error", "error estimate of the abscissa", "phi", "error_estimate"),
    number("abscissa_symmetric", "the same for symmetric disturbances", "phi", "symmetric"),
    number("abscissa_asymmetric", "the same for asymmetric disturbances", "phi", "asymmetric"),
    number("line", "abscissa of the asymptotic line", "phi"),
    angle("psi_max", "largest psi of the radial solution", "phi"),
    flag("governed_by", "what the abscissa is due to", GOVERNED_BY, "phi"),
    flag("parity", "parity of the mode that governs", PARITY, "phi"),
)
NEUTRAL_CURVE: Table = (
    angle("neutral_delta", "internal friction of neutral stability", "point", "delta"),
    angle("neutral_phi", "wall friction of neutral stability", "point", "friction_angle"),
    flag("neutral_governed_by", "what is neutral", GOVERNORS, "point", "governed_by"),
    flag("neutral_parity", "parity of what is neutral", PARITY, "point", "parity"),
    flag("neutral_end", "what ends the curve", CURVE_ENDS, source="end"),
)
DELTA: Table = (angle("delta", "angle of internal friction", "delta"),)
BORDERS: Table = (
    angle("limit_phi", "largest wall friction with a radial solution", "delta", "limit"),
    angle("limit_error", "error estimate of limit_phi", "delta"),
    flag("limit_end", "what ends the branch", ENDS, "delta", "end"),
    angle(
        "tangency_phi",
        "wall friction at which a characteristic is tangent to r = const, NaN where the limit "
        "comes first or the smooth wall is beyond it",
        "delta",
        "tangency",
    ),
    angle(
        "singular_velocity_phi",
        "wall friction at which psi reaches pi/4, NaN as before",
        "delta",
        "singular_velocity",
    ),
    angle(
        "positive_stress_phi",
        "least wall friction with positive stress, NaN where no wall has it",
        "delta",
        "positive_stress",
    ),
)
