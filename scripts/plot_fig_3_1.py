"""Figure 3.1: average stress and velocity, Mohr-Coulomb against von Mises."""

from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(artifact: str) -> Figure:
    """Plot sigma and u over the polar angle for every model and wall friction."""
    data = artifacts.read(artifact)
    figure, axes = plotting.subplots(1, 2)
    for axis, name in zip(axes, ("sigma", "u"), strict=True):
        for model in data.model.values:
            for mu, color in zip(data.mu.values, _COLORS, strict=False):
                curve = data[name].sel(model=model, mu=mu)
                style = plotting.MODEL_STYLES[model]
                label = rf"{style['label']}, $\mu$ = {mu:g}"
                axis.plot(data.theta, curve, color=color, linestyle=style["linestyle"], label=label)
        plotting.degree_ticks(axis, float(data.theta.max()), 10)
        axis.set_xlabel(r"angle $\vartheta$ (degrees)")
        axis.set_ylim(bottom=0)
    axes[0].set_ylabel(r"average stress $\sigma/(\rho g r)$")
    axes[1].set_ylabel(r"velocity $u(\vartheta)/u(0)$")
    axes[1].legend(loc="lower center")
    plotting.letter(axes)
    return figure


_COLORS = (plotting.BLUE, plotting.ORANGE, plotting.GREEN, plotting.PURPLE)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
