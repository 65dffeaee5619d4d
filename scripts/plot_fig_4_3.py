"""Figure 4.3 and others of its kind: growth down the hopper between the bounds of (4.11)."""

from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(wedge: str, cone: str) -> Figure:
    """Plot the norm of exp(-t M) over -t with both bounds, wedge left, cone right."""
    figure, axes = plotting.subplots(1, 2, height=3.1)
    for axis, geometry, path in zip(axes, plotting.GEOMETRIES, (wedge, cone), strict=True):
        data = reading.read(path).isel(kept_in=0, norm=0, psi_scale=0).dropna("elapsed")
        abscissa, formulation = float(data.abscissa), str(data.kept_in.item())
        verdict = "stable" if abscissa < 0 else "unstable"
        axis.semilogy(data.elapsed, data.growth, color=plotting.BLUE, linewidth=0.6)
        axis.semilogy(data.elapsed, data.lower_bound, "k--", linewidth=0.9)
        axis.semilogy(data.elapsed, data.upper_bound, "k-", linewidth=0.9)
        alpha = plotting.signed(abscissa, ".3f")
        axis.set_title(rf"{geometry}, {formulation} formulation: {verdict}, $\alpha$ = {alpha}")
        axis.set_xlim(0, float(data.elapsed.max()))
        axis.set_xlabel(r"$-t = -\log r$")
        axis.set_ylabel(r"$\|\exp(-t M)\|$, " + plotting.NORM_NAMES[str(data.norm.item())])
    plotting.below(figure, _KEYS, 3)
    return figure


_KEYS = (
    plotting.key(r"$\|\exp(-t M)\|$", color=plotting.BLUE),
    plotting.key(r"lower bound $e^{-t\alpha}$", color=plotting.BLACK, linestyle="--"),
    plotting.key(r"upper bound $\kappa(V)\,e^{-t\alpha}$", color=plotting.BLACK),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
