# %% [markdown]
# # Radial fields against the closed form
#
# A radial stress field is $T = r\,\hat T(\vartheta)$, with average stress $\sigma$ and angle $\psi$
# of the major axis as functions of the polar angle alone. We solve for it in a cone, look at it,
# and hold the end of the family, where the stress on the axis vanishes, against a formula.

# %%
from math import atan, degrees, radians

import matplotlib.pyplot as plt
import numpy as np

import hopper

cone = hopper.Hopper("cone", delta=radians(30), half_angle=radians(30))
solution = hopper.solve_radial(cone, friction_angle=atan(0.2))
print(solution)
print(f"stress on the axis {solution.sigma_axis:.6f}, at the wall {solution.sigma_wall:.6f}")
print(f"estimated error {solution.error_estimate:.0e}")

# %% [markdown]
# The fields can be had at any angle, with their slopes. Friction at the wall turns the axes of
# stress.

# %%
theta = np.linspace(0, cone.half_angle, 121)
fig, (left, right) = plt.subplots(1, 2, figsize=(7.1, 2.8), layout="constrained")
for mu in (0.0, 0.1, 0.2, 0.3, 0.35):
    sigma, psi, _, _ = hopper.solve_radial(cone, friction_angle=atan(mu)).fields(theta)
    left.plot(np.degrees(theta), sigma, label=f"μ = {mu:g}")
    right.plot(np.degrees(theta), np.degrees(psi))
left.set(xlabel="polar angle, degrees", ylabel=r"$\sigma / (\rho g r)$")
right.set(xlabel="polar angle, degrees", ylabel=r"$\psi$, degrees")
left.legend()

# %% [markdown]
# ## How rough may the wall be?
#
# Beyond a largest friction there is no radial solution. Here the limit is a fold: two solutions
# meet.

# %%
limit = hopper.friction_limit(cone)
print(limit)
for one in hopper.radial_solutions(cone, radians(19.5)):
    print(f"{one.branch:9} stress on the axis {one.sigma_axis:.4f}")

# %% [markdown]
# ## The closed form
#
# As the stress on the axis tends to zero, the family tends to $\psi = \gamma - \vartheta$, $\sigma
# = \sin\vartheta / (2 \sin\delta \sin 2\gamma)$ with $\cos(\pi - 2\gamma) = (1 -
# \sin\delta)/(2\sin\delta)$. Members of ever smaller axis stress approach it away from the axis.

# %%
s = np.sin(cone.delta)
gamma = (np.pi - np.arccos((1 - s) / (2 * s))) / 2
outer = np.linspace(radians(10), cone.half_angle, 41)
exact = np.sin(outer) / (2 * s * np.sin(2 * gamma))
differences = []
for sigma_axis in (1e-1, 1e-2, 1e-3):
    member = hopper.solve_radial_family(cone, sigma_axis)
    sigma, psi, _, _ = member.fields(outer)
    differences.append(max(abs(sigma - exact).max(), abs(psi - (gamma - outer)).max()))
    print(
        f"axis stress {sigma_axis:g}: φ = {degrees(member.friction_angle):.4f}°, "
        f"largest difference {differences[-1]:.1e}"
    )
assert differences[2] < differences[1] < differences[0]
