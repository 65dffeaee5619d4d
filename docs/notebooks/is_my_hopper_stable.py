# %% [markdown]
# # Is my hopper stable?
#
# A disturbance of the radial field changes down the hopper as $r^{-\lambda}$: it dies out where the
# real part of every $\lambda$ is negative. We ask for one hopper, and then how far its numbers may
# be off before the answer changes.

# %%
from math import atan, degrees, radians

import matplotlib.pyplot as plt
import numpy as np

import hopper

cone = hopper.Hopper("cone", delta=radians(40), half_angle=radians(20))
wall = atan(0.3)
print(hopper.assess(cone, wall))

# %% [markdown]
# The parts of the answer: the low modes, the line that modes of high frequency tend to, and the
# supremum of both. Every number comes with its error.

# %%
stability = hopper.linear_stability(hopper.solve_radial(cone, wall))
print(stability)
print("verdict:", stability.verdict)

# %% [markdown]
# ## Ranges
#
# Friction is seldom known to a degree. For walls between 10° and 18° we look how far internal
# friction may fall.

# %%
frictions = np.radians(np.linspace(10, 18, 5))
least = []
for phi in frictions:
    stable = hopper.stable_deltas("cone", cone.half_angle, float(phi))
    interval = stable.intervals[0]
    least.append(interval.lower)
    print(f"φ = {degrees(phi):4.1f}°: stable from δ = {degrees(interval.lower):.3f}°")

# %%
fig, axes = plt.subplots(figsize=(3.4, 2.8), layout="constrained")
axes.plot(np.degrees(least), np.degrees(frictions), "o-")
axes.plot(degrees(cone.delta), degrees(wall), "k*", label="our hopper")
axes.set(xlabel="δ, degrees", ylabel="φ, degrees")
axes.legend()
assert all(delta < cone.delta for delta in least)

# %% [markdown]
# ## The verdict over internal friction
#
# The same as a curve: the supremum of the real parts over δ, at the wall friction we have.

# %%
deltas = np.radians(np.linspace(24, 45, 22))
suprema = []
for delta in deltas:
    try:
        radial = hopper.solve_radial(hopper.Hopper("cone", float(delta), cone.half_angle), wall)
        suprema.append(hopper.linear_stability(radial).abscissa)
    except hopper.HopperError:
        suprema.append(np.nan)
fig, axes = plt.subplots(figsize=(3.4, 2.8), layout="constrained")
axes.plot(np.degrees(deltas), suprema)
axes.axhline(0, color="grey")
axes.set(xlabel="δ, degrees", ylabel="sup Re λ")
