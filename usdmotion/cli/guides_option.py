"""The option `--guides [FILE]`, whose file may be left out."""

import itertools
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from usdmotion.errors import OptionError

_NAME = "--guides"
Guides = Annotated[
    str | None,
    typer.Option(
        _NAME,
        metavar="[FILE]",
        help="Draw what there is to see, in the layer that is written, or in FILE over it.",
    ),
]


class WithGuides(TyperCommand):
    """A verb that has the option."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words of a command line, on which the option may stand alone.

        Raises:
            OptionError: The option has taken the word that an argument is missing.
        """
        taken = _taken(args)
        try:
            return super().parse_args(ctx, _filled(args))
        except typer.BadParameter as error:
            if taken and getattr(error.param, "param_type_name", "") == "argument":
                raise OptionError(
                    f"{_NAME} {taken} names the file of the guides, and then the file to read is "
                    f"missing; write that before {_NAME}"
                ) from error
            raise


def guides_of(text: str | None) -> bool | Path:
    """Return whether guides are asked for in the layer that is written, or the file for them."""
    return Path(text) if text else text is not None


def file_of(text: str | None) -> Path | None:
    """Return the file that is asked for, None for none."""
    return Path(text) if text else None


def _filled(args: Sequence[str]) -> list[str]:
    """Return words in which the option has a value, which is empty where it stands alone."""
    return [f"{_NAME}=" if _is_alone(args, place) else each for place, each in enumerate(args)]


def _taken(args: Sequence[str]) -> str:
    """Return the word after the option that is its value, "" where there is none."""
    after = itertools.pairwise(args)
    return next((word for name, word in after if name == _NAME and not _is_flag(word)), "")


def _is_alone(args: Sequence[str], place: int) -> bool:
    return args[place] == _NAME and (place + 1 == len(args) or _is_flag(args[place + 1]))


def _is_flag(word: str) -> bool:
    return word.startswith("-")
