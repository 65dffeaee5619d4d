"""Spectral methods that know nothing of hoppers: Chebyshev tools, and what any dense matrix asks.

Chebyshev collocation; spectra matched between meshes; pseudospectra, robust stability, transient
growth and sensitivity of matrices.
"""
