"""Linear stability of the radial flow of von Mises cones, where stress and velocity are coupled.

The linearised equations and their collocation; resolved modes; the type of the equations; the laws
of modes of high frequency; verdict and neutral curve.
"""
