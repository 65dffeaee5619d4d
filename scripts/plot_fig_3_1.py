"""Figure 3.1 and others of its kind: average stress and velocity over the polar angle."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str) -> Figure:
    """Plot sigma and u over the polar angle for every model and wall friction."""
    data = reading.read(artifact)
    figure, axes = plotting.subplots(1, 2, height=3.2)
    looks = plotting.series(data.sizes["mu"])
    for axis, name in zip(axes, ("sigma", "u"), strict=True):
        for model in data.model.values:
            for mu, look in zip(data.mu.values, looks, strict=True):
                style = plotting.MODEL_STYLES[model]["linestyle"]
                axis.plot(data.theta, data[name].sel(model=model, mu=mu), linestyle=style, **look)
        plotting.degree_ticks(axis, float(data.theta.max()), 10)
        axis.set_xlabel(r"angle $\vartheta$ (degrees)")
        axis.set_ylim(bottom=0)
        _say_what_is_hidden(axis, data, name)
    axes[0].set_ylabel(r"average stress $\sigma/(\rho g r)$")
    axes[1].set_ylabel(r"velocity $u(\vartheta)/u(0)$")
    plotting.letter(axes)
    figure.suptitle(plotting.hopper_of(data), fontsize=8)
    frictions = [
        plotting.key(rf"$\mu$ = {mu:g}", color=look["color"], marker=look["marker"])
        for mu, look in zip(data.mu.values, looks, strict=True)
    ]
    models = [plotting.key(**plotting.MODEL_STYLES[model]) for model in data.model.values]
    plotting.below(figure, [*frictions, *models], 5)
    return figure


def _say_what_is_hidden(axis: Axes, data: xr.Dataset, name: str) -> None:
    """Name the frictions at which the curves of the models lie on each other."""
    spread = data[name].max("model") - data[name].min("model")
    scale = float(data[name].max())
    hidden = [f"{mu:g}" for mu in data.mu.values if float(spread.sel(mu=mu).max()) < 2e-3 * scale]
    if data.sizes["model"] > 1 and hidden:
        words = rf"both models coincide at $\mu$ = {', '.join(hidden)}"
        axis.text(0.5, 0.05, words, transform=axis.transAxes, ha="center", fontsize=plotting.SMALL)


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
