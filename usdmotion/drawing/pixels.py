"""Pictures of pixels as small files."""

from io import BytesIO

import numpy as np

from usdmotion.arrays import Ints

_COLORS = 36
"""Of a picture at most: the fewer, the smaller its file."""
_BASES = np.array((65536, 256, 1))
_WHITE = int(_BASES.sum()) * 255


def of_few_colors(png: bytes) -> bytes:
    """Return a picture with a palette, in about a fifth of the bytes.

    Areas of one colour keep theirs; the shades at their edges are brought to few. The same picture
    is the same bytes.
    """
    from PIL import Image

    with Image.open(BytesIO(png)) as opened:
        drawn = opened.convert("RGB")
    pixels = np.asarray(drawn).reshape(-1, 3) @ _BASES
    inked = pixels != _WHITE  # Sorting only those is several times as fast.
    found, which, counts = np.unique(pixels[inked], return_inverse=True, return_counts=True)
    colors = np.append(found, _WHITE)[:, None] // _BASES % 256
    palette, nearest = _palette(colors, np.append(counts, len(pixels)))
    told = np.full(len(pixels), nearest[-1], dtype=np.uint8)
    told[inked] = nearest[which]
    few = Image.fromarray(told.reshape(drawn.height, drawn.width))
    few.putpalette(palette.astype(np.uint8).tobytes())
    held = BytesIO()
    few.save(held, format="png", optimize=True)
    return held.getvalue()


def _palette(colors: Ints, counts: Ints) -> tuple[Ints, Ints]:
    """Return a few of some colours, and which of them each is the most like.

    Taken are one by one those of which most is off, so that what is small but of its own colour is
    kept as well as what is large.

    Args:
        colors: Red, green and blue, 0..255, shape (color_count, 3).
        counts: How many pixels have each, shape (color_count,).
    """
    chosen, nearest = [int(counts.argmax())], np.zeros(len(colors), dtype=np.int64)
    off = ((colors - colors[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < _COLORS and off.any():
        chosen.append(int((counts * off).argmax()))
        away = ((colors - colors[chosen[-1]]) ** 2).sum(axis=1)
        nearest[away < off] = len(chosen) - 1
        off = np.minimum(off, away)
    return colors[chosen], nearest
