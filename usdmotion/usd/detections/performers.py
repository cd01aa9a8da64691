"""Skeletons whose joints are looked at, with the motion that their edit starts from."""

from dataclasses import dataclass

import numpy as np
from pxr import Usd

from usdmotion.arrays import Floats
from usdmotion.cast import Cast
from usdmotion.errors import SceneError
from usdmotion.humanoid import PartMap
from usdmotion.quality import ground_height
from usdmotion.usd.characters import Sitting, read_character
from usdmotion.usd.clips import own_times
from usdmotion.usd.concerns import concerns
from usdmotion.usd.detections.trajectories import Trajectory, filled
from usdmotion.usd.origins import source_of
from usdmotion.usd.relations import bound_animation
from usdmotion.usd.roots import parts_of
from usdmotion.usd.shot import Facts
from usdmotion.usd.stages import refuse
from usdmotion.usd.times import solved_times


@dataclass(frozen=True, eq=False)
class Performer:
    """A skeleton in motion."""

    prim: Usd.Prim
    """The Skeleton."""
    edit: Usd.Prim | None
    """The MotionEdit whose source the motion is; None takes what is bound."""
    time_codes: Floats
    """When, shape (frame_count,)."""
    sitting: Sitting
    cast: Cast
    """It alone."""
    ground: float
    """Height of the ground under it, along the up axis [m]."""
    facts: Facts
    """Units and rates of the stage."""

    @property
    def path(self) -> str:
        """Path of the Skeleton."""
        return str(self.prim.GetPath())

    @property
    def tokens(self) -> tuple[str, ...]:
        """Tokens of its joints."""
        return self.sitting.joints.tokens

    @property
    def parts(self) -> PartMap:
        """Which of them are which part of a body, as far as it is known."""
        whole = self.sitting.character.parts
        count = len(self.tokens)
        return whole or PartMap.given(parts_of(self.prim, count), count, who=f"<{self.path}>")

    def trajectory(self, token: str) -> Trajectory:
        """Return how a joint moves in the world."""
        joint = self.tokens.index(token)
        skeleton = self.sitting.character.skeleton
        ends = skeleton.rest_translations[skeleton.parents == joint]
        return Trajectory(
            time_codes=self.time_codes,
            translations=self.cast.positions[:, joint + 1],
            rotations=self.cast.orientations[:, joint + 1],
            points=np.concatenate([np.zeros((1, 3)), ends]),
            units=self.sitting.scaling.of_joints[:, joint],
            ground=self.ground,
        )


def read_performer(
    skeleton: Usd.Prim, edit: Usd.Prim | None, facts: Facts, up: Floats
) -> Performer:
    """Return a skeleton with the motion that an edit of it starts from.

    Raises:
        SceneError: There is no motion, or it cannot be told without guessing.
    """
    refuse(concerns(skeleton))
    source = bound_animation(skeleton) if edit is None else source_of(edit, skeleton)
    if source is None:
        raise SceneError(
            f"<{skeleton.GetPath()}> has no motion to look at; bind a SkelAnimation to it"
        )
    own = solved_times(own_times(source), None, 0.0, facts, f"<{skeleton.GetPath()}>")
    codes = filled(own, facts)
    sitting = read_character(skeleton, source, codes, facts)
    cast = Cast.of([sitting.character])
    ground = ground_height(cast.positions[:, 1:], up)
    return Performer(skeleton, edit, codes, sitting, cast, ground, facts)
