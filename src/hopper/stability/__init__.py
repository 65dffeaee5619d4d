"""Section 4 of the paper: linear stability of Mohr-Coulomb materials.

The linearised equations and their line; low modes, which users trust; the paper's own matrix, mesh
spectrum and filter; transient growth; smooth-wall theory.
"""
