"""What a verb writes beside layers must not take the place of a layer, nor of one another."""

import os
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from pxr import Sdf

from usdmotion.errors import FileError
from usdmotion.usd.layers import require_writable
from usdmotion.usd.stages import open_stage, used_files


def require_apart(layers: Sequence[Path | None], documents: Sequence[str | Path | None]) -> None:
    """Raise if what is to be written would take the place of a layer, or of another output.

    USD reads a file as a layer for its ending alone. So a document that has none of these endings
    is no layer of any stage, and no stage has to be opened to know it.

    Args:
        layers: The layers to be written; None is none.
        documents: What is written beside them: JSON, pages, folders of pictures; None is none, and
            "-" is no file.

    Raises:
        FileError: A document has the ending of a layer, or two outputs are one file.
    """
    beside = [str(each) for each in documents if each is not None and str(each) != "-"]
    for each in beside:
        ending = Path(each).suffix
        if ending and Sdf.FileFormat.FindByExtension(ending.removeprefix(".").lower()):
            raise FileError(
                f"{each}: a file that ends in {ending} is a layer, which nothing else is written "
                "over; give this one another ending"
            )
    outputs = [*(str(each) for each in layers if each is not None), *beside]
    places = Counter(os.path.realpath(each) for each in outputs)
    for each in outputs:
        if places[os.path.realpath(each)] > 1:
            raise FileError(f"{each}: two things are to be written there; name another for one")


def require_unread(output: Path, shots: Sequence[Path]) -> None:
    """Raise if a layer cannot be written to a place, or some stages are made of what is there.

    Args:
        output: Where a layer is to be written.
        shots: The files of the stages.

    Raises:
        FileError: It cannot, they are, or one of them cannot be opened.
    """
    require_writable(output, frozenset().union(*(used_files(open_stage(each)) for each in shots)))
