"""The plugin host: finds plugins, checks their contract, sets broken ones aside by name."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any, TypeVar

import pluggy

from usdmotion import hookspecs
from usdmotion.constraints import Constraint, built_in
from usdmotion.contract import (
    check_constraint_kind,
    check_detector_kind,
    check_reader_kind,
    check_schema_folder,
    check_solver_kind,
)
from usdmotion.detecting import Detector
from usdmotion.errors import InputError, OptionError, PluginError
from usdmotion.recording import Reader
from usdmotion.solving import Solver

_Kind = TypeVar("_Kind")

GROUP = "usdmotion"
"""The group of entry points in which plugins declare themselves."""


@dataclass(frozen=True)
class Plugin:
    """One plugin as it was found; what is broken registers nothing and says why."""

    name: str
    """Name of its entry point."""
    distribution: str
    """Name and version of the package that brings it; "" where there is none."""
    module: str
    """What its entry point names."""
    solvers: tuple[type[Solver], ...] = ()
    detectors: tuple[type[Detector], ...] = ()
    readers: tuple[type[Reader], ...] = ()
    constraints: tuple[type[Constraint], ...] = ()
    schemas: tuple[Path, ...] = ()
    fault: str = ""
    """Why it was set aside, in one sentence; "" where it was not."""

    @property
    def names(self) -> tuple[tuple[str, str], ...]:
        """What it registers: kind of thing and name."""
        return (
            *(("solver", solver.name) for solver in self.solvers),
            *(("detector", detector.name) for detector in self.detectors),
            *(("reader", reader.name) for reader in self.readers),
            *(("constraint", kind.schema) for kind in self.constraints),
            *(("schema", str(folder)) for folder in self.schemas),
        )


@dataclass(frozen=True)
class Host:
    """What all plugins offer together, the host's own constraint kinds included."""

    plugins: tuple[Plugin, ...]
    """The healthy and the broken ones, our own first, then by package and name."""

    @cached_property
    def solvers(self) -> dict[str, type[Solver]]:
        """Solver classes by name."""
        return {solver.name: solver for plugin in self.plugins for solver in plugin.solvers}

    @cached_property
    def detectors(self) -> dict[str, type[Detector]]:
        """Detector classes by name."""
        return {each.name: each for plugin in self.plugins for each in plugin.detectors}

    @cached_property
    def readers(self) -> dict[str, type[Reader]]:
        """Reader classes by name."""
        return {reader.name: reader for plugin in self.plugins for reader in plugin.readers}

    @cached_property
    def constraints(self) -> tuple[type[Constraint], ...]:
        """Constraint kinds, the built-in ones first."""
        return (*built_in(), *(kind for plugin in self.plugins for kind in plugin.constraints))

    @cached_property
    def schemas(self) -> tuple[Path, ...]:
        """Folders with a plugInfo.json that plugins bring."""
        return tuple(folder for plugin in self.plugins for folder in plugin.schemas)

    def solver(self, name: str) -> type[Solver]:
        """Return the solver class of a name.

        Raises:
            OptionError: There is none; the sentence lists those that are there.
        """
        return self._named(self.solvers, name, "solver")

    def detector(self, name: str) -> type[Detector]:
        """Return the detector class of a name.

        Raises:
            OptionError: There is none; the sentence lists those that are there.
        """
        return self._named(self.detectors, name, "detector")

    def reader(self, name: str) -> type[Reader]:
        """Return the reader class of a name.

        Raises:
            OptionError: There is none; the sentence lists those that are there.
        """
        return self._named(self.readers, name, "reader")

    def reader_of(self, path: Path) -> type[Reader]:
        """Return the reader class for a file, by the ending of its name.

        Raises:
            InputError: No reader reads such files; the sentence lists what can be read.
        """
        for reader in self.readers.values():
            if path.name.lower().endswith(reader.suffixes):
                return reader
        known = ", ".join(suffix for reader in self.readers.values() for suffix in reader.suffixes)
        raise InputError(f"{path}: no reader for such files; there are readers for: {known}")

    def _named(self, known: Mapping[str, _Kind], name: str, kind: str) -> _Kind:
        if name in known:
            return known[name]
        broken = ", ".join(plugin.name for plugin in self.plugins if plugin.fault)
        raise OptionError(
            f"there is no {kind} '{name}'; there are: {', '.join(known) or 'none'}"
            + (f" ('usdmotion plugins' says why these are set aside: {broken})" if broken else "")
        )


@cache
def host() -> Host:
    """Return the host with every plugin that is installed, loaded once."""
    return gather(entry_points(group=GROUP))


def gather(entries: Iterable[EntryPoint]) -> Host:
    """Return the host of some entry points; of two equal names the first found is kept."""
    ordered = sorted(entries, key=lambda entry: (not _ours(entry), _package(entry), entry.name))
    plugins: list[Plugin] = []
    taken = {("constraint", kind.schema): "usdmotion itself" for kind in built_in()}
    for entry in ordered:
        plugin = _load(entry)
        fault = _clash(plugin, taken)
        if fault:
            plugin = Plugin(plugin.name, plugin.distribution, plugin.module, fault=fault)
        taken |= {name: f"the plugin '{plugin.name}'" for name in plugin.names}
        plugins.append(plugin)
    return Host(tuple(plugins))


def _clash(plugin: Plugin, taken: Mapping[tuple[str, str], str]) -> str:
    for index, (kind, name) in enumerate(plugin.names):
        twice = (kind, name) in plugin.names[:index]
        owner = "it" if twice else taken.get((kind, name), "")
        if owner:
            return f"its {kind} '{name}' has the name of one that {owner} brings already"
    return ""


def _load(entry: EntryPoint) -> Plugin:
    plugin = Plugin(entry.name, _package(entry), entry.value)
    try:
        return replace(plugin, **_registered(entry.load()))
    except PluginError as error:
        fault = str(error)
    except (Exception, SystemExit) as error:  # a stranger's code may raise anything
        fault = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return replace(plugin, fault=fault)


def _registered(module: object) -> dict[str, Any]:
    """Return what a plugin registers, checked, by the fields of `Plugin`."""
    manager = pluggy.PluginManager("usdmotion")
    manager.add_hookspecs(hookspecs)
    manager.register(module)
    manager.check_pending()
    if not manager.get_hookcallers(module):
        raise PluginError("it has no hook; mark its functions with usdmotion.hookimpl")
    found: dict[str, Any] = {}
    for field, check in _CHECKS.items():
        hook = f"register_{field}"
        found[field] = tuple(_returned(hook, getattr(manager.hook, hook)()))
        for each in found[field]:
            check(each)
    return found


def _returned(hook: str, results: Iterable[object]) -> Iterable[object]:
    for result in results:
        if isinstance(result, (str, type)) or not isinstance(result, Iterable):
            raise PluginError(f"{hook} returns {result!r}, which is not a list")
        yield from result


_CHECKS: dict[str, Callable[[object], None]] = {
    "solvers": check_solver_kind,
    "detectors": check_detector_kind,
    "readers": check_reader_kind,
    "constraints": check_constraint_kind,
    "schemas": check_schema_folder,
}


def _package(entry: EntryPoint) -> str:
    return f"{entry.dist.name} {entry.dist.version}" if entry.dist else ""


def _ours(entry: EntryPoint) -> bool:
    return entry.dist is not None and entry.dist.name == "usdmotion"
