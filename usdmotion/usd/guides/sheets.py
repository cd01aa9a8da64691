"""The layer that guides are drawn in, and what is drawn on the stage already."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from pxr import Sdf, Usd

from usdmotion.arrays import Floats
from usdmotion.usd.drawn import GUIDES, is_home, is_home_spec, is_owner
from usdmotion.usd.guides.prims import guide, make
from usdmotion.usd.layers import over
from usdmotion.usd.relations import is_a

SHAPE = "Shape"
"""What the name begins with of a class that shows what an object of contacts looks like."""
OF_CONTACT = ("Held", "Number", "Axis", "Way", "Sole", "Ghost", "Trajectory")
"""Names of the guides of a contact and of a detection."""
_OURS = {*OF_CONTACT, "Before", "After", "Missed", "CenterOfMass", "World"}
"""By one of these guides are told where nothing is left of what they are below."""
_EVERYTHING = Usd.PrimIsDefined & ~Usd.PrimIsAbstract
"""What is switched off too."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """The edit target of a stage, to be drawn in."""

    stage: Usd.Stage

    @property
    def layer(self) -> Sdf.Layer:
        """Where guides are written."""
        return self.stage.GetEditTarget().GetLayer()

    def own_codes(self, codes: Floats) -> Floats:
        """Return time codes of the stage as those of the layer, which may be under an offset."""
        offset = self.stage.GetEditTarget().GetMapFunction().timeOffset
        return np.asarray((codes - offset.offset) / offset.scale)

    def home(self, owner: str) -> str:
        """Return the path below a prim where its guides are, or are to be: none of anybody else's.

        Args:
            owner: Path of an edit, a constraint or a detection.
        """
        number, path = 1, f"{owner}/{GUIDES}"
        while (there := self.stage.GetPrimAtPath(path)) and not is_home(there):
            number += 1
            path = f"{owner}/{GUIDES}{number}"
        return path

    def homes(self) -> dict[str, Usd.Prim]:
        """Return the owners of guides that are on the stage or in the layer, by their paths.

        One that is gone is an invalid prim.
        """
        prims = Usd.PrimRange.Stage(self.stage, _EVERYTHING)
        found = {str(prim.GetPath()): prim.GetParent() for prim in prims if is_home(prim)}

        # What stands below a prim that is switched off is not on the stage.
        def look(path: Sdf.Path) -> None:
            spec = self.layer.GetPrimAtPath(path) if path.IsPrimPath() else None
            if spec is not None and str(path) not in found and is_home_spec(spec):
                owner = self.stage.GetPrimAtPath(path.GetParentPath())
                gone = not owner or not owner.IsDefined()
                if is_owner(owner):
                    found[str(path)] = owner
                elif gone and _OURS & set(spec.nameChildren.keys()):
                    found[str(path)] = Usd.Prim()

        self.layer.Traverse(Sdf.Path.absoluteRootPath, look)
        return found

    def items(self, home: str) -> list[str]:
        """Return the paths of the guides that stand below a prim, in the layer or on the stage."""
        prim, spec = self.stage.GetPrimAtPath(home), self.layer.GetPrimAtPath(home)
        names = [child.GetName() for child in prim.GetAllChildren()] if prim else []
        names += list(spec.nameChildren.keys()) if spec else []
        return [f"{home}/{name}" for name in dict.fromkeys(names)]


def author_home(sheet: Sheet, path: str) -> Sdf.PrimSpec:
    """Make the prim below which guides are drawn."""
    home = over(sheet.layer, path)
    make(home, "Xform")
    guide(home)
    return home


def is_of_contact(path: str, owner: Usd.Prim) -> bool:
    """Tell whether a guide is one that contacts are drawn with, and not what is asked of an edit.

    Args:
        path: Path of the guide.
        owner: What it stands below.
    """
    name = path.rsplit("/", 1)[-1]
    return name.startswith(SHAPE) or (name in OF_CONTACT and not is_a(owner, "UsdMotionEdit"))


@contextmanager
def redrawn(sheet: Sheet, guides: Sequence[str]) -> Iterator[None]:
    """Take out what was drawn before, let it be drawn anew, and hide the rest of it.

    Nothing can be read from the stage meanwhile.

    Args:
        sheet: Where.
        guides: Paths of the guides that were drawn before, or of all that stand together.
    """
    behind = {path: seen for each in guides for path, seen in _behind(sheet, each)}
    with Sdf.ChangeBlock():
        for each in guides:
            _remove(sheet.layer.GetPrimAtPath(each))
        yield
        hidden: list[Sdf.Path] = []
        for path, seen in behind.items():
            if not any(path.HasPrefix(each) for each in hidden):
                if _settle(sheet.layer, path, seen):
                    hidden.append(path)
        for home in {Sdf.Path(each).GetParentPath() for each in guides}:
            spec = sheet.layer.GetPrimAtPath(home)
            if is_home_spec(spec) and not spec.nameChildren:
                _remove(spec)


@dataclass(frozen=True, eq=False)
class _Behind:
    """What weaker layers say of a guide."""

    properties: Mapping[str, Any]
    """Type and variability of each attribute, by its name."""
    active: bool


def _behind(sheet: Sheet, home: str) -> Iterator[tuple[Sdf.Path, _Behind]]:
    """Yield what weaker layers say of what is drawn below a prim, from above down."""
    prim = sheet.stage.GetPrimAtPath(home)
    for each in Usd.PrimRange(prim, Usd.PrimAllPrimsPredicate) if prim else ():
        specs = [spec for spec in _own_specs(each, home) if spec.layer != sheet.layer]
        if specs:
            known = {
                name: (attribute.typeName, attribute.variability)
                for spec in reversed(specs)
                for name, attribute in spec.attributes.items()
            }
            said = [spec.GetInfo("active") for spec in specs if spec.HasInfo("active")]
            yield each.GetPath(), _Behind(known, not said or bool(said[0]))


def _own_specs(prim: Usd.Prim, home: str) -> Iterator[Sdf.PrimSpec]:
    """Yield the specs of a guide that are not those of what guides refer to, strongest first."""
    depth = Sdf.Path(home).pathElementCount
    waiting = [prim.GetPrimIndex().rootNode]
    while waiting:
        node = waiting.pop(0)
        specs = (layer.GetPrimAtPath(node.path) for layer in node.layerStack.layers)
        yield from (spec for spec in specs if spec)
        waiting += [each for each in node.children if each.namespaceDepth < depth]


def _settle(layer: Sdf.Layer, path: Sdf.Path, seen: _Behind) -> bool:
    """Let weaker layers say nothing more of a guide than is drawn; tell whether it is hidden."""
    spec = layer.GetPrimAtPath(path)
    if spec is None or spec.specifier == Sdf.SpecifierOver:
        if seen.active:
            over(layer, str(path)).SetInfo("active", False)
        return True
    if not seen.active:
        spec.SetInfo("active", True)
    for name, (kind, variability) in seen.properties.items():
        if name not in spec.attributes:
            Sdf.AttributeSpec(spec, name, kind, variability).default = Sdf.ValueBlock()
    return False


def _remove(spec: Sdf.PrimSpec | None) -> None:
    """Remove a spec, and those above it that say nothing without it."""
    while spec:
        above = spec.realNameParent
        del above.nameChildren[spec.name]
        spec = None if above.path.IsAbsoluteRootPath() or not _is_idle(above) else above


def _is_idle(spec: Sdf.PrimSpec) -> bool:
    return spec.specifier == Sdf.SpecifierOver and bool(spec.IsInert(ignoreChildren=False))
