"""`make figures` draws the picture of the front page and the papers' figures from our models, and compares the claims.

Each module covers one or two papers. They write reports/figures and the claims on the pages of their models.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterable
from pathlib import Path

import matplotlib
from PIL import Image
from PIL.PngImagePlugin import PngInfo
from quadrance.cores import ROOT

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402

FOLDER = ROOT / "reports" / "figures"


def shrunk(image: Image.Image, colours: int = 48) -> Image.Image:
    """The picture in few colours: a fraction of the bytes."""
    return image.convert("RGB").quantize(colours, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)


def drawn(figure: pyplot.Figure, dpi: int) -> Image.Image:
    """The figure as a picture, and closed."""
    stream = io.BytesIO()
    figure.savefig(stream, dpi=dpi, metadata={"Software": None})
    pyplot.close(figure)
    return Image.open(stream)


def write(figure: pyplot.Figure, name: str, dpi: int = 90, shows: str = "") -> None:
    """The figure as a file of `FOLDER`; what it `shows` stands in the file too, so that a test sees a stale one."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    said = PngInfo()
    if shows:
        said.add_text("Shows", shows)
    shrunk(drawn(figure, dpi)).save(FOLDER / name, optimize=True, pnginfo=said)


def table(rows: Iterable[tuple[str, str, str]]) -> str:
    """Claims as a Markdown table: what, the paper's, ours."""
    return "\n".join(["| | paper | ours |", "|---|---|---|", *(f"| {' | '.join(row)} |" for row in rows)]) + "\n"


def fill(page: Path, block: str, text: str) -> None:
    """Put `text` between the comments <!-- block --> and <!-- /block --> of a page."""
    pattern = re.compile(rf"(<!-- {block} -->\n)(.*?)(<!-- /{block} -->)", re.S)
    old = page.read_text(encoding="utf-8")
    if not pattern.search(old):
        raise ValueError(f"{page.name}: no block {block}")
    page.write_text(pattern.sub(lambda match: match[1] + text + match[3], old), encoding="utf-8")
