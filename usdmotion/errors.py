"""What usdmotion raises.

    UsdMotionError
    ├── InputError             the input is at fault: one sentence, exit status 2
    │   ├── FileError          a file cannot be read or written: names the file (and the line)
    │   ├── SceneError         a stage says something that cannot be solved: names the prim
    │   └── OptionError        an option has a value that it cannot have: names the option
    └── PluginError            a plugin does not keep its contract: names the plugin

A target that cannot be met is none of these: it is a number in the solution.
"""


class UsdMotionError(Exception):
    """Root of everything that usdmotion raises on purpose."""


class InputError(UsdMotionError):
    """What was given is at fault; the message is one sentence that says what would do."""


class FileError(InputError):
    """A file cannot be read or written."""


class SceneError(InputError):
    """A stage, or the scene read from it, says something that cannot be solved."""


class OptionError(InputError):
    """An option is unknown or has a value that it cannot have."""


class PluginError(UsdMotionError):
    """A plugin does not keep its contract."""
