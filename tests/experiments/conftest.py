"""What every experiment measures: composed stages, through UsdSkel, never the solver's word."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel
from scipy.spatial.transform import Rotation

from usdmotion import demos, pipeline, usd
from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.motion import Body
from usdmotion.report import Report


@dataclass(frozen=True, eq=False)
class Take:
    """A skeleton on a composed stage, sampled at some time codes."""

    joints: tuple[str, ...]
    times: Floats
    world: Floats
    """Joint to world, row vectors, metres, (F, J, 4, 4)."""
    local: Floats
    """Rotations in the parent's frame, xyzw, (F, J, 4)."""

    @classmethod
    def of(cls, stage: Usd.Stage, skeleton: str, times: Floats) -> "Take":
        prim = stage.GetPrimAtPath(skeleton)
        cache = UsdSkel.Cache()
        cache.Populate(UsdSkel.Root.Find(prim), Usd.TraverseInstanceProxies())
        query = cache.GetSkelQuery(UsdSkel.Skeleton(prim))
        unit = UsdGeom.GetStageMetersPerUnit(stage)
        world, local = [], []
        for time in times:
            code = Usd.TimeCode(time)
            place = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code)
            skel = query.ComputeJointSkelTransforms(code)
            matrices = np.array([np.array(Gf.Matrix4d(each) * place) for each in skel])
            matrices[:, 3, :3] *= unit
            world.append(matrices)
            joints = [
                each.ExtractRotationQuat() for each in query.ComputeJointLocalTransforms(code)
            ]
            local.append([(*each.imaginary, each.real) for each in joints])
        return cls(tuple(query.GetJointOrder()), times, np.array(world), np.array(local))

    def index(self, name: str) -> int:
        """Return the index of a joint by its token or the last part of it."""
        return next(
            index
            for index, token in enumerate(self.joints)
            if name in (token, token.rsplit("/", 1)[-1])
        )

    def point(self, name: str, point: Floats | tuple[float, float, float] = (0, 0, 0)) -> Floats:
        """Return the world trajectory of a point of a joint [m], (F, 3)."""
        return (np.array((*point, 1.0)) @ self.world[:, self.index(name)])[:, :3]

    def turn(self, name: str) -> Rotation:
        """Return the rotations of a joint in its parent's frame."""
        return Rotation.from_quat(self.local[:, self.index(name)])

    def speed(self, name: str) -> Floats:
        """Return how far a joint turns from each frame to the next [degrees], (F - 1,)."""
        turn = self.turn(name)
        return np.degrees((turn[:-1].inv() * turn[1:]).magnitude())

    def center_of_mass(self, body: Body) -> Floats:
        """Return the trajectory of the centre of mass of a demo's body [m], (F, 3)."""
        shares = body.masses / body.masses.sum()
        points = zip(shares, self.joints, body.mass_centers, strict=True)
        return np.sum([share * self.point(name, point) for share, name, point in points], axis=0)

    @property
    def height(self) -> float:
        """Height of the body [m]: what the joints span at most, from head to feet."""
        places = self.world[:, :, 3, :3]
        return float((places.max(axis=1) - places.min(axis=1)).max())


@dataclass(frozen=True, eq=False)
class Solved:
    """A stage before and after, at the result's own times."""

    before: Take
    after: Take
    report: Report
    edit_layer: Path

    def millimetres(self, lengths: Floats) -> float:
        """Return the largest of some lengths, on a body of 1.7 m."""
        return float(np.max(np.linalg.norm(lengths, axis=-1)) * 1e3 * 1.7 / self.before.height)

    def moved(self, name: str, point: Floats | tuple[float, float, float] = (0, 0, 0)) -> float:
        """Return how far a point of a joint ever is from where it was [mm on 1.7 m]."""
        return self.millimetres(self.after.point(name, point) - self.before.point(name, point))

    def pops(self, name: str) -> float:
        """Return how much faster a joint ever turns than in the input [degrees a frame]."""
        return float(self.after.speed(name).max() - self.before.speed(name).max())

    def turned(self, name: str) -> float:
        """Return how far a joint is ever turned from what it was [degrees]."""
        turns = self.before.turn(name).inv() * self.after.turn(name)
        return float(np.degrees(turns.magnitude().max()))


Solve = Callable[..., Solved]


@pytest.fixture
def solve(tmp_path: Path) -> Solve:
    """Return what solves a stage and looks at the composed answer."""

    def run(shot: Path, skeleton: str, **options: object) -> Solved:
        edit, composed = tmp_path / f"{shot.stem}.edit.usda", tmp_path / f"{shot.stem}.shot.usda"
        report = pipeline.solve(shot, edit, compose=composed, **options)
        layer = Sdf.Layer.FindOrOpen(str(edit))
        stage = Usd.Stage.Open(str(composed))
        result = UsdSkel.BindingAPI(stage.GetPrimAtPath(skeleton)).GetAnimationSource()
        times = np.array(layer.ListTimeSamplesForPath(result.GetPath().AppendProperty("rotations")))
        return Solved(
            Take.of(Usd.Stage.Open(str(shot)), skeleton, times),
            Take.of(stage, skeleton, times),
            report,
            edit,
        )

    return run


@pytest.fixture
def demo(tmp_path: Path) -> Callable[[str], Path]:
    """Return what builds the stage of a demo."""
    return lambda name: demos.build(name, tmp_path)


@pytest.fixture
def asked(tmp_path: Path) -> Callable[..., Path]:
    """Return what puts a layer with an edit over a stage: constraints under its Skeleton."""

    def run(shot: Path, skeleton: str, constraints: list[Constraint]) -> Path:
        source = Usd.Stage.Open(str(shot))
        output = tmp_path / f"{shot.stem}.asked.usda"
        layer = Sdf.Layer.CreateNew(str(output))
        layer.subLayerPaths.append(str(shot))
        stage = Usd.Stage.Open(layer)
        for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
            stage.SetMetadata(name, source.GetMetadata(name))
        start, end = source.GetStartTimeCode(), source.GetEndTimeCode()
        stage.SetStartTimeCode(start)
        stage.SetEndTimeCode(end)
        usd.author_edit(stage, f"{skeleton}/Edit")
        for each in constraints:
            usd.author(stage, f"{skeleton}/Edit/{each.path}", each, time_codes=[start])
        layer.Save()
        return output

    return run


@dataclass(frozen=True)
class Clip:
    """A captured clip, and what the joints that the experiments need are called in it."""

    path: str
    feet: tuple[str, ...]
    wrist: str
    elbow: str
    head: str
    skip: int = 0
    """Samples at the start that are no part of the motion."""


CLIPS = (
    Clip(
        "cmu/iclone/007_12.bvh",
        ("CC_Base_L_Foot", "CC_Base_R_Foot", "CC_Base_L_ToeBase", "CC_Base_R_ToeBase"),
        "CC_Base_L_Hand",
        "CC_Base_L_Forearm",
        "CC_Base_Head",
        skip=1,
    ),
    Clip(
        "cmu/daz/08_01_trimmed.bvh",
        ("lFoot", "rFoot"),
        "lHand",
        "lForeArm",
        "head",
    ),
    Clip(
        "other/mocapbank_crouch.bvh",
        ("LeftAnkle", "RightAnkle"),
        "LeftWrist",
        "LeftElbow",
        "Head",
    ),
    Clip(
        "other/rokoko_jesse_dance.bvh",
        ("LeftFoot", "RightFoot"),
        "LeftHand",
        "LeftForeArm",
        "Head",
    ),
)


@dataclass(frozen=True, eq=False)
class Captured:
    """An imported clip."""

    shot: Path
    skeleton: str
    clip: Clip
    take: Take

    def token(self, name: str) -> str:
        return self.take.joints[self.take.index(name)]

    def frames(self) -> tuple[float, float]:
        return float(self.take.times[0]), float(self.take.times[-1])


@pytest.fixture(params=CLIPS, ids=lambda clip: Path(clip.path).stem)
def captured(request: pytest.FixtureRequest, mocap: Path, tmp_path: Path) -> Captured:
    """Return a captured clip as a stage at 30 per second."""
    clip: Clip = request.param
    shot = tmp_path / "captured.usda"
    recording = pipeline.import_motion(mocap / clip.path, shot, fps=30)
    skeleton = f"/{recording.name}/Skeleton"
    stage = Usd.Stage.Open(str(shot))
    times = np.arange(stage.GetStartTimeCode() + clip.skip, stage.GetEndTimeCode() + 0.5)
    return Captured(shot, skeleton, clip, Take.of(stage, skeleton, times))
