"""What several tests need."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from usdmotion import Constraint, Goal, Motion, PositionConstraint, guiding
from usdmotion.arrays import Floats
from usdmotion.humanoid import recognize
from usdmotion.kernels import from_vector, multiply
from usdmotion.outcome import Outcome, Record
from usdmotion.testing import HUMANOID, arm_scene, humanoid_scene


@pytest.fixture(scope="session")
def mocap() -> Path:
    """Return the folder of captured clips, which are not part of the project."""
    named = os.environ.get("USDMOTION_MOCAP")
    places = [Path(named)] if named else [up / "shared/mocap" for up in Path(__file__).parents]
    for place in places:
        if place.is_dir():
            return place
    pytest.skip("the captured clips are not here; USDMOTION_MOCAP may name their folder")


ArmShot = Callable[..., Path]


@pytest.fixture
def arm_shot(tmp_path: Path) -> ArmShot:
    """Return what writes a stage whose edit </Arm/Skeleton/Edit> lifts a wrist by so much [m]."""
    from pxr import Usd, UsdGeom

    from usdmotion.usd import author, author_character, author_edit

    def write(lift: float = 0.05, *, name: str = "arm.usda", solver: str = "") -> Path:
        stage = Usd.Stage.CreateNew(str(tmp_path / name))
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        stage.SetTimeCodesPerSecond(24.0)
        stage.SetStartTimeCode(1.0)
        scene = arm_scene()
        (arm,) = scene.characters
        codes = scene.time_codes
        path = author_character(stage, "/Arm", arm.skeleton, arm.body, arm.motion, time_codes=codes)
        stage.SetEndTimeCode(codes[-1])
        author_edit(stage, f"{path}/Edit", solver=solver)
        wrist = PositionConstraint(
            path="",
            skeleton=path,
            joint="base/shoulder/elbow/wrist",
            recruits=("base/shoulder", "base/shoulder/elbow"),
            goals=(Goal(mode="offset", translation=np.array([0.0, lift, 0.0])),),
        )
        author(stage, f"{path}/Edit/Wrist", wrist)
        stage.GetRootLayer().Save()
        return tmp_path / name

    return write


Turns = Mapping[str, tuple[float, float, float]]


@dataclass(frozen=True)
class Outcomes:
    """Makes outcomes without USD, and knows the tokens of the humanoid's joints."""

    def __call__(
        self,
        constraints: Sequence[Constraint] = (),
        *,
        turns: Turns | None = None,
        lift: float = 0.0,
        frame_count: int = 24,
        **said: object,
    ) -> Outcome:
        """Return an outcome whose result has some joints turned [rad], and the root lifted [m]."""
        scene = humanoid_scene(constraints, frame_count=frame_count)
        (character,) = scene.characters
        given = character.motion
        skeleton = character.skeleton
        rotations, translations = np.array(given.rotations), np.array(given.translations)
        for name, turn in (turns or {}).items():
            joint = skeleton.index[self.token(name)]
            rotations[:, joint] = multiply(rotations[:, joint], from_vector(np.array([turn])))
        translations[:, 0, 1] += lift
        whole = replace(character, parts=recognize(skeleton))
        scene = replace(scene, characters=(whole,))
        record = {
            "edit": scene.edits[0].path,
            "solver": "by_hand",
            "version": "7.8.9",
            "options": {"patience": 3},
            "input_hash": "abc",
            "hash_now": "abc",
            "shown": True,
        }
        motion = Motion(given.times, translations, rotations)
        return Outcome(scene, {HUMANOID: motion}, (Record(**(record | said)),), ("beware <this>",))

    def token(self, name: str) -> str:
        """Return the token of a joint by its last name."""
        return next(token for token in self.joints if token.rsplit("/", 1)[-1] == name)

    @property
    def joints(self) -> tuple[str, ...]:
        return humanoid_scene().characters[0].skeleton.joints


@pytest.fixture
def outcome() -> Outcomes:
    return Outcomes()


@dataclass(frozen=True, eq=False)
class Drawn:
    """The guides of a stage, in the world and in metres."""

    stage: Any

    def points(self, path: str, code: float = 0.0) -> Floats:
        """Return the points of a guide at a time code."""
        from pxr import UsdGeom

        prim = self.stage.GetPrimAtPath(path)
        points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(code))
        matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code))
        unit = UsdGeom.GetStageMetersPerUnit(self.stage)
        return (points @ matrix[:3, :3] + matrix[3, :3]) * unit

    def off(self, path: str, places: Floats) -> Floats:
        """Return how far each of some places is from a curve [m]."""
        curve = self.points(path)
        starts, along = curve[:-1], np.diff(curve, axis=0)
        squares = np.maximum((along**2).sum(axis=1), 1e-30)
        shares = ((places[:, None] - starts) * along).sum(axis=2) / squares
        nearest = starts + np.clip(shares, 0.0, 1.0)[..., None] * along
        return np.linalg.norm(nearest - places[:, None], axis=2).min(axis=1)

    @property
    def size(self) -> int:
        """Of its file, in bytes."""
        return Path(self.stage.GetRootLayer().realPath).stat().st_size


@pytest.fixture(scope="session")
def drawn() -> Callable[[Path, Path], Drawn]:
    """Return what draws guides over a stage into a file."""

    def run(shot: Path, output: Path) -> Drawn:
        from pxr import Usd

        guiding.guides(shot, output)
        return Drawn(Usd.Stage.Open(str(output)))

    return run
