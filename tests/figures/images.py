"""Layer 3: figures as pixels against stored images, in the style of the paper."""

from pathlib import Path
from typing import Any

import matplotlib
import pytest
from matplotlib import ft2font

from hopper_workflow import plotting

BASELINE = Path(__file__).with_name("baseline")
STYLE = str(plotting.STYLE)
SAVING: dict[str, Any] = {"dpi": 80}
# RMS over all pixels, on a scale of 255. Between artifacts made with other BLAS kernels (see
# tolerances.yaml) it is at most 0.023, in the map, and 0 in most figures; the least visible change
# of colour, the dashed part of a curve in Figure 4.4, makes 0.28, a thin curve 0.6 to 2.
TOLERANCE = 0.2
_RENDERER = BASELINE / "renderer.txt"


def comparison(name: str) -> pytest.MarkDecorator:
    """Return the mark by which pytest-mpl compares what a test returns with a stored image."""
    return pytest.mark.mpl_image_compare(
        filename=f"{name}.png", style=STYLE, savefig_kwargs=SAVING, tolerance=TOLERANCE
    )


def renderer() -> str:
    """Return what places letters: another release moves all of them, by an RMS of 8 to 55."""
    return f"Matplotlib {matplotlib.__version__}, FreeType {ft2font.__freetype_version__}"


def stored_renderer() -> str:
    return _RENDERER.read_text(encoding="utf-8").strip()


def store_renderer() -> None:
    _RENDERER.parent.mkdir(exist_ok=True)
    _RENDERER.write_text(renderer() + "\n", encoding="utf-8")
