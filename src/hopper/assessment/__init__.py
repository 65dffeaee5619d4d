"""What is known about one hopper: radial solution, limits of wall friction, stability.

Every number carries an absolute error.
"""
