"""The usdMotion schema: the scene description of usdmotion, usable without the rest of it.

The folder of this package is a codeless USD plugin. Add `plugin_path()` to PXR_PLUGINPATH_NAME, or
hand it to `Plug.Registry().RegisterPlugins` before the first stage is opened. Nothing here imports
`pxr`, so it can be asked before the environment of a USD process is complete.
"""

import os
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path

PLUGIN_PATH_VARIABLE = "PXR_PLUGINPATH_NAME"
"""The environment variable in which USD looks for folders of plugins."""


def plugin_path() -> Path:
    """Return the folder that holds `plugInfo.json` and `generatedSchema.usda`."""
    return Path(__file__).resolve().parent


def validation_path() -> Path | None:
    """Return the folder of the validators, which come with usdmotion; None without it."""
    return _in_usdmotion("usd", "validation")


def usdview_path() -> Path | None:
    """Return the folder of the plugin of usdview, which comes with usdmotion; None without it."""
    return _in_usdmotion("usdview")


def environment(extra: Iterable[Path] = ()) -> list[str]:
    """Return the lines NAME=VALUE of an environment in which any USD process knows the schema.

    Where usdmotion is there, its validators and its plugin of usdview are among them. What the
    variable holds already comes after ours, so that it stays in force.

    Args:
        extra: Folders of third-party plugins that are to be known as well.
    """
    own = (plugin_path(), validation_path(), usdview_path())
    values = [str(folder) for folder in own if folder is not None]
    values += [str(Path(folder).resolve()) for folder in extra]
    known = os.environ.get(PLUGIN_PATH_VARIABLE, "").split(os.pathsep)
    values += [value for value in known if value and value not in values]
    return [f"{PLUGIN_PATH_VARIABLE}={os.pathsep.join(values)}"]


def _in_usdmotion(*names: str) -> Path | None:
    """Return a folder of usdmotion that holds a plugInfo.json."""
    usdmotion = find_spec("usdmotion")  # a top package is found without being imported
    if usdmotion is None or usdmotion.origin is None:
        return None
    folder = Path(usdmotion.origin).resolve().parent.joinpath(*names)
    return folder if (folder / "plugInfo.json").is_file() else None
