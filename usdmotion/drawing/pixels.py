"""Pictures of pixels as small files."""

from io import BytesIO

import numpy as np

_OFTEN, _OTHERS = 16, 24
"""How many colours are kept as they are, and to how many the others are brought."""
_SHARE = 2e-4
"""Kept is what more than this share of a picture has."""
_BASES = np.array((65536, 256, 1))


def of_few_colors(png: bytes) -> bytes:
    """Return a picture with a palette, in less than a fourth of the bytes.

    Areas of one colour keep theirs; the shades between them are brought to few. The same picture
    is the same bytes.
    """
    from PIL import Image

    with Image.open(BytesIO(png)) as opened:
        drawn = opened.convert("RGB")
    pixels = np.asarray(drawn).reshape(-1, 3) @ _BASES
    found, which, counts = np.unique(pixels, return_inverse=True, return_counts=True)
    often = np.argsort(-counts, kind="stable")[:_OFTEN]
    often = often[counts[often] > _SHARE * len(pixels)]
    others = drawn.quantize(_OTHERS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    colors = found[:, None] // _BASES % 256
    more = np.reshape((others.getpalette() or [])[: 3 * _OTHERS], (-1, 3))
    palette = np.concatenate([colors[often], more])
    nearest = ((colors[:, None] - palette) ** 2).sum(axis=2).argmin(axis=1).astype(np.uint8)
    few = Image.fromarray(nearest[which.reshape(drawn.height, drawn.width)])
    few.putpalette(palette.astype(np.uint8).tobytes())
    held = BytesIO()
    few.save(held, format="png", optimize=True)
    return held.getvalue()
