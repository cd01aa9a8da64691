"""The only reader and writer of USD.

Importing it makes USD know the schema and those of plugins, so do it before opening a stage.
"""

from usdmotion.plugins import host
from usdmotion.usd.registration import register

register(host().schemas)

from usdmotion.usd.authoring import author, author_edit  # noqa: E402
from usdmotion.usd.character_authoring import author_character  # noqa: E402
from usdmotion.usd.inspection import Inspection, inspect  # noqa: E402
from usdmotion.usd.new_stages import new_stage  # noqa: E402
from usdmotion.usd.reading import read  # noqa: E402
from usdmotion.usd.recordings import write_recording  # noqa: E402
from usdmotion.usd.shot import Result, Shot  # noqa: E402
from usdmotion.usd.writing import compose, write  # noqa: E402

__all__ = [
    "Inspection",
    "Result",
    "Shot",
    "author",
    "author_character",
    "author_edit",
    "compose",
    "inspect",
    "new_stage",
    "read",
    "write",
    "write_recording",
]
