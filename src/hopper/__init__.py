"""Similarity solutions for granular flows in hoppers (Gremaud, Matthews, Shearer 2000).

Numerics only: functions of arrays and small frozen dataclasses. Angles are in radians, stresses
in units of rho g r. Import what you need from its modules, for instance
``from hopper.radial import solve_radial``.
"""

__version__ = "0.1.0"
