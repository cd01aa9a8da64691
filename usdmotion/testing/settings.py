"""What any plugin promises of its options."""

from collections.abc import Callable

import numpy as np

from usdmotion.errors import OptionError, PluginError
from usdmotion.options import configured, options


def check_limits(kind: type, check_kind: Callable[[object], None]) -> None:
    """Check that the options of a class say what they are and hold to their limits.

    Args:
        kind: The class.
        check_kind: Raises PluginError unless the class is what it is registered as.

    Raises:
        AssertionError: A promise is not kept; the sentence says which.
    """
    try:
        check_kind(kind)
    except PluginError as error:
        raise AssertionError(str(error)) from error
    for option in options(kind):
        for limit, beyond in ((option.minimum, -1.0), (option.maximum, 1.0)):
            if not np.isfinite(limit):
                continue
            try:
                configured(kind, {option.name: limit + beyond})
            except OptionError:
                continue
            raise AssertionError(f"the option '{option.name}' must not go beyond {limit:g}")
