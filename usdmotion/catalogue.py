"""What plugins offer, as plain values to show: what can be chosen, and what can be set."""

from dataclasses import dataclass

from usdmotion.options import options
from usdmotion.plugins import Host, Plugin


@dataclass(frozen=True)
class PluginLine:
    """One plugin."""

    name: str
    package: str
    module: str
    registers: tuple[str, ...]
    """Kind and name of each thing, as `solver prioritized_ik`."""
    set_aside: str
    """Why it was set aside; "" where it was not."""


@dataclass(frozen=True)
class OptionLine:
    """One option of a solver, detector or reader."""

    of: str
    option: str
    default: bool | int | float | str
    allowed: str
    """What values it can have."""
    meaning: str


@dataclass(frozen=True)
class Catalogue:
    """Everything that is installed."""

    plugins: tuple[PluginLine, ...]
    options: tuple[OptionLine, ...]

    @classmethod
    def of(cls, host: Host) -> "Catalogue":
        """Return the catalogue of a host."""
        return cls(
            tuple(_plugin_line(plugin) for plugin in host.plugins),
            tuple(
                OptionLine(name, each.name, each.default, each.allowed, each.doc)
                for known in (host.solvers, host.detectors, host.readers)
                for name, offered in known.items()
                for each in options(offered)
            ),
        )


def _plugin_line(plugin: Plugin) -> PluginLine:
    registers = tuple(f"{kind} {name}" for kind, name in plugin.names)
    return PluginLine(plugin.name, plugin.distribution, plugin.module, registers, plugin.fault)
