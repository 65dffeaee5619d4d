"""Figure 4.3: growth of perturbations down the hopper between the bounds of (4.11)."""

from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(wedge: str, cone: str) -> Figure:
    """Plot the norm of exp(-t M) over -t with both bounds, wedge left, cone right."""
    figure, axes = plotting.subplots(1, 2, height=2.8)
    for axis, geometry, path in zip(axes, ("wedge", "cone"), (wedge, cone), strict=True):
        data = artifacts.read(path).isel(kept_in=0, norm=0, psi_scale=0)
        abscissa = float(data.abscissa)
        verdict = "stable" if abscissa < 0 else "unstable"
        axis.semilogy(
            data.elapsed, data.growth, color=plotting.BLUE, linewidth=0.9, label=r"$\|\exp(-t M)\|$"
        )
        axis.semilogy(data.elapsed, data.lower_bound, "k--", linewidth=0.9, label=r"$e^{-t\alpha}$")
        axis.semilogy(
            data.elapsed, data.upper_bound, "k-", linewidth=0.9, label=r"$\kappa(V)\,e^{-t\alpha}$"
        )
        axis.set_title(rf"{geometry}, {verdict}, $\alpha$ = {abscissa:.3f}")
        axis.set_xlim(0, float(data.elapsed.max()))
        axis.set_xlabel(r"$-t = -\log r$")
    axes[0].set_ylabel("norm")
    axes[0].legend(loc="lower right")
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
