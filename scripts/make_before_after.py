"""Draw docs/before_after.png: the demo campaign's loops with and without the effect that a diagnosis names.

python scripts/make_before_after.py
"""

from pathlib import Path

from PIL import Image

from slipwise.campaign import load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.view.figures.canvas import save_figure
from slipwise.view.figures.diagnosis_figures import loops_figure
from slipwise.view.figures.style import styled

ROOT = Path(__file__).parents[1]
_COLOURS = 128


def main() -> None:
    """Diagnose the campaign that ships with the package, and draw pad A in a run that no fit has seen."""
    found = diagnose(load_campaign(ROOT / "src" / "slipwise" / "demo_data"), system=False)
    print(found.sentence)
    with styled():
        path = save_figure(loops_figure(found), ROOT / "docs" / "before_after.png")
    with Image.open(path) as picture:  # a third of the size, and nobody sees it
        picture.convert("RGB").quantize(_COLOURS).save(path, optimize=True)


if __name__ == "__main__":
    main()
