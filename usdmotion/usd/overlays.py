"""A layer over a shot while it is being made: a stage that shows both, on disk once it is whole."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Sdf, Usd, Vt

from usdmotion.errors import SceneError
from usdmotion.usd.layers import relative, require_writable, save
from usdmotion.usd.provenance import KEY, own_version, recorded
from usdmotion.usd.stages import open_stage, read_facts, require_composed, used_files
from usdmotion.usd.writing import composed, name_fallbacks


@dataclass(frozen=True, eq=False)
class Overlay:
    """A layer that is read like its shot and has it as its sublayer, under others if need be."""

    shot: Path
    """The file under it."""
    output: Path
    """Where it is to be written."""
    stage: Usd.Stage
    """What both together show; its edit target is the layer."""
    inputs: frozenset[str]
    """Real path of every file that the shot is made of."""
    between: tuple[Path, ...] = ()
    """Layers over the shot and under this one, the strongest first."""

    @classmethod
    def open(cls, shot: Path, output: Path, *, between: Sequence[Path] = ()) -> "Overlay":
        """Begin a layer over a shot.

        Args:
            shot: The file under it.
            output: Where it is to be written.
            between: Layers that go over the shot and under this one, the strongest first.

        Raises:
            FileError: A file cannot be opened, or the layer must not be written there.
            SceneError: The shot does not compose.
        """
        beneath = open_stage(shot)
        files = [os.path.realpath(each) for each in (*between, shot)]
        layer = composed(read_facts(beneath), files)
        name_fallbacks(layer)
        stage = Usd.Stage.Open(layer)
        try:
            require_composed(stage)
        except SceneError as error:
            raise SceneError(f"{shot}: {error}") from error
        inputs = used_files(stage)
        require_writable(output, inputs)
        return cls(shot, output, stage, inputs, tuple(between))

    def remember(self, **said: Any) -> None:
        """Let the layer say of itself how it was made, on top of what it says already."""
        layer = self.stage.GetRootLayer()
        plain = {
            name: Vt.StringArray(list(value)) if isinstance(value, tuple) else value
            for name, value in said.items()
        }
        told = {**recorded(layer), "version": own_version(), **plain}
        layer.customLayerData = {**layer.customLayerData, KEY: told}

    def write(self) -> None:
        """Write the layer, whole or not at all.

        Raises:
            FileError: It cannot be written.
        """
        written = Sdf.Layer.CreateAnonymous(".usda")
        written.TransferContent(self.stage.GetRootLayer())
        for number, path in enumerate((*self.between, self.shot)):
            written.subLayerPaths[number] = relative(path, self.output.parent)
        save(written, self.output)
