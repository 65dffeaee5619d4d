"""Layer 3: each figure as an image. pytest-mpl draws, compares, and writes the HTML report."""

import pytest

from tests.figures import images, registry


def pytest_generate_tests(metafunc):
    if "picture" in metafunc.fixturenames:
        pictures = registry.plots().items()
        marked = [
            pytest.param(plot, id=name, marks=images.comparison(name)) for name, plot in pictures
        ]
        metafunc.parametrize("picture", marked)


def test_image(picture, pytestconfig, storing):
    if not (pytestconfig.getoption("--mpl") or storing):
        pytest.fail("nothing is compared without --mpl: run `make check`", pytrace=False)
    return picture.draw()


def test_images_were_drawn_by_this_renderer(storing):
    if storing:
        images.store_renderer()
    elif images.renderer() != images.stored_renderer():
        pytest.fail(
            f"the stored images were drawn by {images.stored_renderer()}, these by "
            f"{images.renderer()}: use the locked environment, or run `make references`",
            pytrace=False,
        )
