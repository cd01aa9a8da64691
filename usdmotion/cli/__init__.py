"""The command line: one verb a file, over the pipeline.

Rooms that are slow to import are imported in the verb that needs them.
"""

import sys

from usdmotion.cli.application import app, schema
from usdmotion.errors import InputError

# Help lists the verbs in this order, which is the way of the data.
# isort: off
from usdmotion.cli import import_, inspect  # noqa: F401
from usdmotion.cli import detect, solve, clean, report  # noqa: F401
from usdmotion.cli import normalize, retarget  # noqa: F401
from usdmotion.cli import guides, picture  # noqa: F401
from usdmotion.cli import plugins, demo, schemas  # noqa: F401

__all__ = ["app", "main", "schema"]


def main() -> None:
    """Run the command line; the exit status is 0 done, 1 a bug, 2 the input is at fault.

    With `--strict` it is 3 where a constraint was not met.
    """
    try:
        app()
    except InputError as error:
        print(f"usdmotion: {error}", file=sys.stderr)
        raise SystemExit(2) from None
