"""A layer for a stage that is open, while it is being made."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any

from pxr import Sdf, Usd

from usdmotion.errors import SceneError
from usdmotion.usd.drafts.hiding import refuse_hidden, refuse_hidden_guides
from usdmotion.usd.drafts.merging import merge, whole_or_not
from usdmotion.usd.drafts.retiming import retime
from usdmotion.usd.drafts.targets import offset_of, target_of
from usdmotion.usd.layers import new_layer
from usdmotion.usd.provenance import KEY, joined, recorded
from usdmotion.usd.stages import Stage, name_of, read_facts

_VARIABLES = "expressionVariables"
"""What is read of the strongest layer alone."""


class Draft:
    """A layer over an open stage, in memory until `put` gives the stage's edit target all of it.

    Nobody sees anything of it before, and nothing of the stage is changed.
    """

    def __init__(self, stage: Stage) -> None:
        """Begin.

        Args:
            stage: The stage that is open.

        Raises:
            SceneError: Its edit target cannot be written to.
        """
        self._stage = stage
        with _named(stage):
            self._target = target_of(stage)
        self.layer = new_layer(read_facts(stage))
        """What is made, in time codes of the stage."""

    @cached_property
    def stage(self) -> Stage:
        """A stage that shows the draft over the open one; its edit target is the draft."""
        opened, layer = self._stage, self.layer
        if opened.HasAuthoredMetadata(_VARIABLES):
            layer.pseudoRoot.SetInfo(_VARIABLES, opened.GetMetadata(_VARIABLES))
        for each in (opened.GetSessionLayer(), opened.GetRootLayer()):
            if each:
                layer.subLayerPaths.append(each.identifier)
                layer.subLayerOffsets[len(layer.subLayerPaths) - 1] = self._beneath(each)
        context, mask = opened.GetPathResolverContext(), opened.GetPopulationMask()
        shown = Usd.Stage.OpenMasked(layer, None, context, mask, Usd.Stage.LoadNone)
        shown.MuteAndUnmuteLayers(opened.GetMutedLayers(), [])
        shown.SetInterpolationType(opened.GetInterpolationType())
        shown.SetLoadRules(opened.GetLoadRules())
        return shown

    @property
    def folder(self) -> Path | None:
        """The folder in which the edit target lies, None where it is in memory only."""
        path = self._target.layer.realPath
        return Path(os.path.realpath(path)).parent if path else None

    def put(self, *, whole: Sequence[str] = (), **said: Any) -> None:
        """Give the edit target of the open stage what was made, in one change.

        The draft is of no use after that.

        Args:
            whole: Paths of prims that take the place of what is there, with all below them.
            said: What the layer is to say of itself, on top of what it says already.

        Raises:
            SceneError: A stronger layer would hide it; nothing is written.
        """
        target, layer = self._target, self.layer
        retime(layer, target.offset.GetInverse())
        with _named(self._stage):
            refuse_hidden(layer, target)
        with whole_or_not(target.layer), Sdf.ChangeBlock():
            merge(layer, target.layer, {Sdf.Path(path) for path in whole})
            if said:
                data = target.layer.customLayerData
                target.layer.customLayerData = data | {KEY: joined(recorded(target.layer), said)}

    def _beneath(self, layer: Sdf.Layer) -> Sdf.LayerOffset:
        """Return the offset under the draft of a layer of the stage, with which it stays itself."""
        own = offset_of(self._stage, layer)
        rates = layer.timeCodesPerSecond / self._stage.GetTimeCodesPerSecond()
        return Sdf.LayerOffset(own.offset, own.scale * rates)


@contextmanager
def drawn_on(stage: Stage) -> Iterator[None]:
    """Let guides be drawn on an open stage, in its edit target: all of them, or none.

    What is drawn anew takes the place of what was drawn there before, which a draft cannot do.

    Raises:
        SceneError: The edit target cannot be written to, or a stronger layer has other guides.
    """
    with _named(stage):
        target = target_of(stage)
    own = stage.GetEditTargetForLocalLayer(target.layer)
    with whole_or_not(target.layer), Usd.EditContext(stage, own):
        yield  # what draws names the stage itself
        with _named(stage):
            refuse_hidden_guides(target)


@contextmanager
def _named(stage: Stage) -> Iterator[None]:
    """Let errors name the stage that they are about."""
    try:
        yield
    except SceneError as error:
        raise SceneError(f"{name_of(stage)}: {error}") from error
