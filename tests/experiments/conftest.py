"""What every experiment measures: composed stages, through UsdSkel, never the solver's word."""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom, UsdSkel
from scipy.spatial.transform import Rotation

from usdmotion import demos, pipeline, usd
from usdmotion.arrays import Floats
from usdmotion.constraints import Constraint
from usdmotion.demos.walker import SKELETON
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
        world, local = [], []
        for time in times:
            code = Usd.TimeCode(time)
            place = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code)
            world.append(np.array(query.ComputeJointSkelTransforms(code)) @ np.array(place))
            local.append(np.array(query.ComputeJointLocalTransforms(code)))
        matrices = np.array(world)
        matrices[..., 3, :3] *= UsdGeom.GetStageMetersPerUnit(stage)
        axes = np.array(local)[..., :3, :3]
        turns = Rotation.from_matrix(axes.reshape(-1, 3, 3).swapaxes(1, 2)).as_quat()
        return cls(tuple(query.GetJointOrder()), times, matrices, turns.reshape(*axes.shape[:2], 4))

    def part(self, frames: slice) -> "Take":
        """Return some of its frames."""
        return Take(self.joints, self.times[frames], self.world[frames], self.local[frames])

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

    def seen_from(self, frame: str, name: str) -> Floats:
        """Return the trajectory of a joint in the frame of another [m], (F, 3)."""
        places = np.concatenate([self.point(name), np.ones((len(self.times), 1))], axis=1)
        inverse = np.linalg.inv(self.world[:, self.index(frame)])
        return np.einsum("fi,fij->fj", places, inverse)[:, :3]

    def turn(self, name: str) -> Rotation:
        """Return the rotations of a joint in its parent's frame."""
        return Rotation.from_quat(self.local[:, self.index(name)])

    def speed(self, name: str) -> Floats:
        """Return how far a joint turns from each frame to the next [degrees], (F - 1,)."""
        turn = self.turn(name)
        return np.degrees((turn[:-1].inv() * turn[1:]).magnitude())

    def jolt(self, name: str) -> float:
        """Return how much a joint's turn from frame to frame changes at most [degrees]."""
        turn = self.turn(name)
        steps = (turn[:-1].inv() * turn[1:]).as_rotvec(degrees=True)
        return float(np.linalg.norm(np.diff(steps, axis=0), axis=1).max())

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

    def jolted(self, *names: str) -> float:
        """Return how much more abruptly than in the input some joints, or all, ever turn [deg]."""
        joints = names or self.before.joints
        return max(self.after.jolt(name) - self.before.jolt(name) for name in joints)

    def on(self, frames: tuple[float, ...]) -> NDArray[np.bool_]:
        """Return which samples are on the plateau of four key times [time codes]."""
        return (self.after.times >= frames[1]) & (self.after.times <= frames[2])

    def away(self, frames: tuple[float, ...]) -> NDArray[np.bool_]:
        """Return which samples are before the first or after the last key time [time codes]."""
        return (self.after.times <= frames[0]) | (self.after.times >= frames[-1])

    def apart(self, samples: NDArray[np.bool_]) -> float:
        """Return how far any joint is from where it was, on some samples [mm on 1.7 m]."""
        moved = self.after.world[samples, :, 3, :3] - self.before.world[samples, :, 3, :3]
        return self.millimetres(moved)

    def turned(self, name: str, over: Callable[[Floats], float] = np.max) -> float:
        """Return how far a joint is ever, or on average, turned from what it was [degrees]."""
        turns = self.before.turn(name).inv() * self.after.turn(name)
        return float(np.degrees(over(turns.magnitude())))

    @property
    def mean_change(self) -> str:
        """What was asked, and how far those joints turned on average that turned at all."""
        (edit,) = self.report.edits
        asked = ", ".join(each.path.rsplit("/", 1)[-1] for each in edit.constraints)
        turned = [self.turned(joint, np.mean) for joint in self.before.joints]
        changed = [each for each in turned if each > 0.0]
        mean = np.mean(changed or 0.0)
        return f"<{edit.path}> {asked}: {len(changed)} joints turned by {mean:.2f} degrees"


@dataclass(frozen=True, eq=False)
class Held:
    """A contact as a stage has it, and when."""

    joint: str
    point: Floats
    """In the joint's frame [m]."""
    keys: tuple[float, ...]
    """Its four key times."""

    def during(self, take: Take, before: float = 0.0) -> NDArray[np.bool_]:
        """Return on which samples it holds, or that long before or after [time codes]."""
        first, last = self.keys[1] - before, self.keys[2] + before
        return (take.times >= first - 1e-6) & (take.times <= last + 1e-6)

    def slide(self, take: Take) -> float:
        """Return how far what is held is from its mean place at most while it holds [m]."""
        places = take.point(self.joint, self.point)[self.during(take)]
        return float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())


@pytest.fixture(scope="session")
def contacts_on() -> Callable[[Path], list[Held]]:
    """Return what reads the contacts that are on a stage and switched on."""

    def run(path: Path) -> list[Held]:
        stage = Usd.Stage.Open(str(path))
        unit = UsdGeom.GetStageMetersPerUnit(stage)
        return [
            Held(
                prim.GetAttribute("usdmotion:joint").Get(),
                unit * np.array(prim.GetAttribute("usdmotion:point").Get()),
                tuple(float(code) for code in prim.GetAttribute("usdmotion:times").Get()),
            )
            for prim in stage.Traverse()
            if prim.GetTypeName() == "MotionContactConstraint"
        ]

    return run


Solve = Callable[..., Solved]


@pytest.fixture(scope="session")
def taken() -> Callable[[Usd.Stage, str, Floats], Take]:
    """Return what samples the skeleton of a composed stage."""
    return Take.of


@pytest.fixture(scope="session")
def solve(tmp_path_factory: pytest.TempPathFactory, tell: Callable[[str], None]) -> Solve:
    """Return what solves a stage and looks at the composed answer, at the solved times."""

    def run(shot: Path, skeleton: str, **options: object) -> Solved:
        folder = tmp_path_factory.mktemp("solved")
        edit, composed = folder / f"{shot.stem}.edit.usda", folder / f"{shot.stem}.shot.usda"
        report = pipeline.solve(shot, edit, compose=composed, **options)
        layer = Sdf.Layer.FindOrOpen(str(edit))
        stage = Usd.Stage.Open(str(composed))
        result = UsdSkel.BindingAPI(stage.GetPrimAtPath(skeleton)).GetAnimationSource()
        times = np.array(layer.ListTimeSamplesForPath(result.GetPath().AppendProperty("rotations")))
        if "frames" in options:
            first, last = options["frames"]
            times = times[(times >= first) & (times <= last)]
        before = Take.of(Usd.Stage.Open(str(shot)), skeleton, times)
        solved = Solved(before, Take.of(stage, skeleton, times), report, edit)
        tell(solved.mean_change)
        return solved

    return run


@pytest.fixture
def demo(tmp_path: Path) -> Callable[[str], Path]:
    """Return what builds the stage of a demo."""
    return lambda name: demos.build(name, tmp_path)


@pytest.fixture(scope="session")
def shown(tmp_path_factory: pytest.TempPathFactory, solve: Solve) -> Callable[..., Solved]:
    """Return what solves a demo with chosen variants of its prims, once."""
    done: dict[tuple[object, ...], Solved] = {}

    def run(name: str, **variants: str) -> Solved:
        key = (name, *variants.items())
        if key not in done:
            stage = Usd.Stage.Open(str(demos.build(name, tmp_path_factory.mktemp(name))))
            prims = [prim for prim in stage.Traverse() if prim.HasVariantSets()]
            for prim, (variant_set, chosen) in itertools.product(prims, variants.items()):
                prim.GetVariantSets().SetSelection(variant_set, chosen)
            stage.Save()
            done[key] = solve(Path(stage.GetRootLayer().realPath), SKELETON)
        return done[key]

    return run


@pytest.fixture(scope="session")
def asked(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Return what puts a layer with an edit over a stage: constraints under its Skeleton."""

    def run(
        shot: Path, skeleton: str, constraints: Sequence[Constraint], time_codes: Floats
    ) -> Path:
        output = tmp_path_factory.mktemp("asked") / "asked.usda"
        layer = Sdf.Layer.CreateNew(str(output))
        layer.subLayerPaths.append(str(shot))
        source, stage = Usd.Stage.Open(str(shot)), Usd.Stage.Open(layer)
        for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
            stage.SetMetadata(name, source.GetMetadata(name))
        first, last = float(time_codes[0]), float(time_codes[-1])
        stage.SetStartTimeCode(first)
        stage.SetEndTimeCode(last)
        usd.author_edit(stage, f"{skeleton}/Edit", frames=(first, last))
        for each in constraints:
            usd.author(stage, f"{skeleton}/Edit/{each.path}", each, time_codes=time_codes)
        layer.Save()
        return output

    return run


TOLD = pytest.StashKey[list[str]]()
"""What there is to tell at the end of a run."""


@pytest.fixture(scope="session")
def tell(request: pytest.FixtureRequest) -> Callable[[str], None]:
    """Return what keeps a line for the end of a run, for whoever asks for details."""
    return request.config.stash.setdefault(TOLD, []).append


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """Tell it."""
    if config.get_verbosity() > 0:
        for line in config.stash.get(TOLD, []):
            terminalreporter.write_line(line)
