"""A scene as a strip of poses, before and after."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from usdmotion.drawing.bodies import Kind
from usdmotion.drawing.eyes import Camera
from usdmotion.drawing.mannequin import Mannequin, facing
from usdmotion.drawing.strips import Body, Panel, Row, Strip
from usdmotion.quality import ground_height
from usdmotion.showing.marking import marks
from usdmotion.showing.shown import Actor, ShownEdit, ShownScene

_TURN, _RISE = -42.0, 14.0
"""From where bodies are seen: whoever walks goes to the right [degrees]."""
_NEAR = 2.5
"""Somebody farther away than this is not in the picture, in heights of the body."""


def poses(shown: ShownScene, edit: ShownEdit, frames: Sequence[int]) -> Strip:
    """Return a strip of some frames of a scene around the body of one edit.

    Args:
        shown: What there is to see of a scene.
        edit: Whom to look at.
        frames: Numbers of the frames.
    """
    stage = _Stage.of(shown, edit)
    whole = {"before": False, "after": True} if edit.solved else {"": False}
    rows = tuple(
        Row(title, tuple(stage.panel(frame, after) for frame in frames))
        for title, after in whole.items()
    )
    return Strip(
        rows,
        "The input above, the result below, its right side darker. Crossed circles are goals, as "
        "strong as they are on; lines are trajectories, strong where the effector was; the green "
        "area is what the centre of mass should be over; red crosses are what is missed.",
    )


@dataclass(frozen=True, eq=False)
class _Stage:
    """Who is looked at, and from where."""

    shown: ShownScene
    own: Actor
    mannequins: Mapping[str, Mannequin]
    """By the paths of the skeletons."""
    eye: Camera
    ground: float

    @classmethod
    def of(cls, shown: ShownScene, edit: ShownEdit) -> "_Stage":
        up = shown.scene.up
        own = next(each for each in shown.actors if each.character.path == edit.skeleton)
        ahead = facing(own.character, own.before[0][len(own.before[0]) // 2], up)
        return cls(
            shown,
            own,
            {each.character.path: Mannequin.of(each.character) for each in shown.actors},
            Camera.at(ahead, up, _TURN, _RISE),
            ground_height(own.before[0], up),
        )

    def panel(self, frame: int, after: bool) -> Panel:
        """Return one frame with those who are near then, and what is asked of them."""
        shown, up = self.shown, self.shown.scene.up
        bodies = dict(self.bodies(frame, after))
        edits = tuple(each for each in shown.edits if each.skeleton in bodies)
        return Panel(
            title=f"{shown.scene.time_codes[frame]:g}",
            eye=self.eye,
            bodies=tuple(bodies.values()),
            marks=marks(replace(shown, edits=edits), frame, after=after),
            ground=self.ground,
            up=(float(up[0]), float(up[1]), float(up[2])),
        )

    def bodies(self, frame: int, after: bool) -> Iterator[tuple[str, Body]]:
        """Yield the bodies of those who are near, by their skeletons, results each in a colour."""
        middle = self.own.before[0][frame].mean(axis=0)
        reach = _NEAR * self.mannequins[self.own.character.path].height
        number = 0
        for actor in self.shown.actors:
            path, solved = actor.character.path, actor.after is not None
            poses = actor.after if after and actor.after is not None else actor.before
            pose = poses[0][frame], poses[1][frame]
            kind: Kind = "other" if not solved else "after" if after else "before"
            if np.linalg.norm(pose[0].mean(axis=0) - middle) < reach:
                yield path, Body(self.mannequins[path], pose, kind, number)
            number += solved
