"""A notebook shows what `.plot()` gives as a picture, without matplotlib being told to."""

import slipwise as sw


def test_a_figure_is_a_picture_in_a_notebook():
    figure = sw.load_motion("sine:2Hz,0.3g,cycles=9").plot()
    assert figure._repr_png_().startswith(b"\x89PNG")
