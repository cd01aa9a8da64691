"""Makes USD know the schema, and says so out loud when that comes too late.

USD builds its registry of schemas once, on first use. A plugin registered afterwards is accepted
without a word and its prim types stay unknown, so the registry is asked for them at once.
"""

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import usdmotion_schemas
from pxr import Plug, Usd
from usdmotion_schemas import PLUGIN_PATH_VARIABLE

from usdmotion.errors import InputError

_USDVIEW = "usdmotion.usdview.container"
"""Name of the plugin of usdview."""


class RegistrationError(InputError):
    """USD does not know a schema, and cannot learn it any more."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that `check` looked at."""

    what: str
    """What was looked at, in a word or two, or the folder."""
    ok: bool
    """Whether it is as it should be."""
    sentence: str
    """What was found and, where it is at fault, what would do."""


def register(extra: Iterable[Path] = ()) -> None:
    """Make USD know our schema, our validators, and the schemas of third parties.

    It may be called again. All folders have to be there in the first call, before anything else in
    the process opens a stage, because asking for a prim type closes the registry.

    Args:
        extra: Folders of third parties that hold a plugInfo.json.

    Raises:
        RegistrationError: A folder is not a plugin, or USD built its registry before it was known.
    """
    folders = [usdmotion_schemas.plugin_path(), *(Path(folder).resolve() for folder in extra)]
    described = [(folder, _describe(folder)) for folder in folders]
    for folder in folders:
        Plug.Registry().RegisterPlugins(str(folder))
    validators = usdmotion_schemas.validation_path()
    if validators is not None and has_python_validators():
        Plug.Registry().RegisterPlugins(str(validators))
    for folder, plugins in described:
        _ask(folder, plugins)


def has_python_validators() -> bool:
    """Tell whether this USD takes validators written in Python, which came with 26.5."""
    try:
        from pxr import UsdValidation
    except ImportError:  # some hosts are built without it
        return False
    return hasattr(UsdValidation.ValidationRegistry, "RegisterPluginPrimValidator")


def check(extra: Iterable[Path] = ()) -> list[Finding]:
    """Register everything and list what came of it; never raises for what it finds."""
    ours = usdmotion_schemas.plugin_path()
    folders = [Path(folder).resolve() for folder in extra]
    findings = [_try(ours, ())]
    findings += [_try(folder, (folder,)) for folder in folders]
    findings.append(_fallbacks())
    findings += [_validators(), _usdview()]
    return findings


def _describe(folder: Path) -> list[dict[str, Any]]:
    """Return what the plugInfo.json of a folder declares."""
    path = folder / "plugInfo.json"
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        # usdGenSchema heads the file with comments, which USD allows and JSON does not.
        text = "\n".join(line for line in lines if not line.lstrip().startswith("#"))
        plugins = json.loads(text)["Plugins"]
        return [dict(plugin) for plugin in plugins]
    except OSError as error:
        raise RegistrationError(
            f"{folder} holds no readable plugInfo.json; name a folder that usdGenSchema has written"
        ) from error
    except (ValueError, KeyError, TypeError) as error:
        raise RegistrationError(
            f"{path} is not a plugInfo.json ({error}); generate it again with usdGenSchema"
        ) from error


def _ask(folder: Path, plugins: Iterable[dict[str, Any]]) -> None:
    """Raise if the schema registry does not know a prim type or an API of these plugins."""
    registry = Usd.SchemaRegistry()
    for identifier, kind in _declared(plugins):
        if kind == "concreteTyped":
            known = registry.FindConcretePrimDefinition(identifier)
        else:
            known = registry.FindAppliedAPIPrimDefinition(identifier)
        if not known:
            raise RegistrationError(
                f"USD does not know the schema {identifier} of {folder} because it was registered "
                f"after USD had built its schema registry (or its generatedSchema.usda is missing);"
                f" import usdmotion.usd before a stage is opened, or set {PLUGIN_PATH_VARIABLE} to "
                f"hold {folder} before the process starts"
            )


def _declared(plugins: Iterable[dict[str, Any]]) -> Iterator[tuple[str, str]]:
    """Yield name and kind of what has a definition of its own; abstract types have none."""
    for plugin in plugins:
        for name, details in plugin.get("Info", {}).get("Types", {}).items():
            kind = details.get("schemaKind")
            if kind in ("concreteTyped", "singleApplyAPI"):
                alias = details.get("alias", {}).get("UsdSchemaBase", name)
                yield details.get("schemaIdentifier", alias), kind


def _try(folder: Path, extra: tuple[Path, ...]) -> Finding:
    try:
        register(extra)
        names = [name for name, _ in _declared(_describe(folder))]
    except RegistrationError as error:
        return Finding(str(folder), False, str(error))
    return Finding(str(folder), True, f"USD knows its {len(names)} schemas")


def _fallbacks() -> Finding:
    known = Usd.SchemaRegistry().GetFallbackPrimTypes()
    if "MotionEdit" in known:
        return Finding("fallback types", True, "stages we write open without our schema too")
    return Finding("fallback types", False, "USD has none of ours; generate the schema again")


def _validators() -> Finding:
    if not has_python_validators():
        version = ".".join(str(number) for number in Usd.GetVersion()[1:])
        return Finding(
            "validators",
            True,
            f"absent: validators in Python need USD 26.5 and this is {version}; "
            "usdmotion inspect makes the same checks",
        )
    from pxr import UsdValidation

    names = UsdValidation.ValidationRegistry().GetValidatorMetadataForKeyword("UsdMotion")
    if names:
        return Finding("validators", True, f"USD knows {len(names)}, by the keyword UsdMotion")
    return Finding("validators", False, "USD knows none of ours; install usdmotion again")


def _usdview() -> Finding:
    folder = usdmotion_schemas.usdview_path()
    if folder is None:
        return Finding("usdview", False, "its plugin is not there; install usdmotion again")
    plugin = Plug.Registry().GetPluginWithName(_USDVIEW)
    if plugin is None:
        return Finding(
            "usdview",
            True,
            f"the menu is in {folder}, which {PLUGIN_PATH_VARIABLE} does not hold here; set what "
            "`usdmotion schema env` prints for it to be found",
        )
    found = Path(plugin.resourcePath).resolve()
    if found != folder:
        return Finding(
            "usdview", False, f"it finds the menu of another usdmotion in {found}, not of {folder}"
        )
    return Finding("usdview", True, f"it finds the menu in {folder}")
