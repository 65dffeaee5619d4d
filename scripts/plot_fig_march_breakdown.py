"""A stress that breaks down: its characteristics, and psi over depth and angle."""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading
from hopper_cli import drawing


def draw(artifact: str) -> Figure:
    """Plot the net of characteristics and psi, with the first crossing."""
    data = reading.read(artifact)
    fields = {name: data[name].to_numpy() for name in ("tau", "theta", "psi")}
    end = np.nan, np.nan
    if "breakdown_tau" in data:
        end = float(data.breakdown_x * data.theta[-1]), float(data.breakdown_tau)
    figure, (net, plane) = plotting.subplots(1, 2, height=3.6, sharey=True)
    pieces = np.stack([data.line_theta.to_numpy(), data.line_tau.to_numpy()], axis=2)
    for family, color in (("plus", plotting.BLUE), ("minus", "0.65")):
        chosen = pieces[data.line_family.to_numpy() == family]
        net.add_collection(LineCollection(list(chosen), colors=color, linewidths=0.5))
    net.set_xlim(fields["theta"][0], fields["theta"][-1])
    drawing.mark_breakdown(net, end, max(fields["tau"][-1], np.nan_to_num(end[1])))
    net.set_title("characteristics C+ (dark) and C\N{MINUS SIGN} (light)")
    drawn = drawing.draw_depth_plane(plane, fields, end)
    plane.set_ylabel("")
    plane.set_title(r"angle $\psi$, and the first crossing ($\times$)")
    figure.colorbar(drawn, ax=plane, label=r"$\psi$ (degrees)")
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
