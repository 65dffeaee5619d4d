# %% [markdown]
# # The pseudospectrum of a matrix of one's own
#
# `hopper.spectral` knows nothing of hoppers: it takes any dense matrix. The matrix here is Grcar's,
# whose eigenvalues tell little about how it behaves; put your own in its place.

# %%
import matplotlib.pyplot as plt
import numpy as np

import hopper

n = 48
matrix = -np.eye(n, k=-1) + sum(np.eye(n, k=k) for k in range(4))
form = hopper.schur_form(matrix)
print(form)

# %% [markdown]
# The smallest singular value of $zI - M$ on a grid; where it is below $\varepsilon$, a disturbance
# of the matrix of that size makes $z$ an eigenvalue.

# %%
grid = hopper.pseudospectrum(form, np.linspace(-1.5, 3.5, 80), np.linspace(-3.5, 3.5, 80))
fig, axes = plt.subplots(figsize=(3.4, 3.6), layout="constrained")
lines = axes.contour(grid.real, grid.imag, np.log10(grid.sigma_min), levels=range(-6, 1))
axes.clabel(lines, fontsize=7)
values = np.linalg.eigvals(matrix)
axes.plot(values.real, values.imag, "k.", markersize=3)
axes.set(xlabel="Re z", ylabel="Im z")

# %% [markdown]
# ## What it says
#
# How far right do eigenvalues come if the matrix is off by $10^{-3}$? How small a disturbance makes
# $M - 3I$, which is stable, unstable?

# %%
abscissa, place = hopper.pseudospectral_abscissa(form, 1e-3)
print(f"eigenvalues reach Re z = {values.real.max():.4f}; off by 1e-3 they reach {abscissa:.4f}")
distance, frequency = hopper.distance_to_instability(hopper.schur_form(matrix - 3 * np.eye(n)))
print(f"M - 3 I is {distance:.4f} from an unstable matrix, by way of z = {frequency:.2f} i")
direct = np.linalg.svd(matrix - 3 * np.eye(n) - 1j * frequency * np.eye(n), compute_uv=False)[-1]
assert abs(direct - distance) < 1e-9 * max(direct, 1)
