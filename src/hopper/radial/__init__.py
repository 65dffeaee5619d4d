"""Section 3 of the paper: radial fields of stress and velocity, their family and its limits."""
