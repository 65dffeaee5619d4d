"""Nonlinear march of the stress down a hopper towards its radial field, and how it breaks down."""
