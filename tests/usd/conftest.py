"""Small stages, and what UsdSkel itself says of them."""

from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import usd
from usdmotion.constraints import built_in
from usdmotion.kernels import rotate

IDENTITY = "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )"
JOINTS = ("hip", "hip/knee", "hip/knee/ankle", "hip/head")
OFFSETS = ((0, 10, 0), (1, -4, 0), (0, -5, 0.5), (0, 6, -1))


def at(x, y, z):
    """Return a matrix that moves, as usda has it."""
    return f"( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), ({x}, {y}, {z}, 1) )"


def listed(values):
    return "[" + ", ".join(str(value) for value in values) + "]"


def quoted(values):
    return "[" + ", ".join(f'"{value}"' for value in values) + "]"


def sampled(values_by_time):
    rows = "".join(f"{time}: {values},\n" for time, values in values_by_time.items())
    return "{\n" + rows + "}"


REST = f"uniform matrix4d[] restTransforms = {listed(at(*offset) for offset in OFFSETS)}"
BIND = "uniform matrix4d[] bindTransforms = " + listed(
    at(*np.sum([OFFSETS[i] for i in chain], axis=0)) for chain in ([0], [0, 1], [0, 1, 2], [0, 3])
)


def poses(times=(1, 2, 3, 4, 5), joints=JOINTS, *, seed=0, scales=True, travel=1.0):
    """Return the body of a SkelAnimation that turns everything and moves the hip."""
    random = np.random.default_rng(seed)
    count = len(joints)
    turns = random.normal(size=(len(times), count, 4)) + np.array((4, 0, 0, 0))
    turns /= np.linalg.norm(turns, axis=-1, keepdims=True)
    offsets = [OFFSETS[JOINTS.index(joint)] if joint in JOINTS else (1, 1, 1) for joint in joints]
    moves = np.tile(np.array(offsets, dtype=float), (len(times), 1, 1))
    if "hip" in joints:
        moves[:, joints.index("hip")] += travel * random.normal(size=(len(times), 3))
    rows = [
        f"uniform token[] joints = {quoted(joints)}",
        "float3[] translations.timeSamples = "
        + sampled({t: listed(map(tuple, m.tolist())) for t, m in zip(times, moves, strict=True)}),
        "quatf[] rotations.timeSamples = "
        + sampled({t: listed(map(tuple, q.tolist())) for t, q in zip(times, turns, strict=True)}),
    ]
    if scales:
        rows.append(f"half3[] scales = {listed([(1, 1, 1)] * count)}")
    return "\n".join(rows)


def man(
    name="Man", *, animation=None, on_root="", on_skeleton=None, joints=JOINTS, inside="", **kw
):
    """Return a SkelRoot with a Skeleton, its SkelAnimation, and an edit of it."""
    binding = f"rel skel:animationSource = </{kw.get('home', name)}/Walk>"
    api = '(prepend apiSchemas = ["SkelBindingAPI"])'
    on_skeleton = binding if on_skeleton is None else on_skeleton
    on_root = binding if on_root is True else on_root
    edit = kw.get("edit", 'def MotionEdit "Edit" {}')
    return f"""
def SkelRoot "{name}" {api if on_root else ""}
{{
    {kw.get("xform", "")}
    {on_root}
    def Skeleton "Bones" {api if on_skeleton else ""}
    {{
        uniform token[] joints = {quoted(joints)}
        {kw.get("rest", REST)}
        {kw.get("bind", BIND)}
        {on_skeleton}
        {kw.get("skeleton", "")}
        {edit}
    }}
    def SkelAnimation "Walk" {{
        {poses() if animation is None else animation}
    }}
    {inside}
}}
"""


def edit(inside="", name="Edit", attributes=""):
    return f'\ndef MotionEdit "{name}" {{\n{attributes}\n{inside}\n}}\n'


def hold(inside="", name="Hold", kind="MotionPositionConstraint", attributes=""):
    return (
        f'\ndef {kind} "{name}" {{\nuniform token usdmotion:joint = "hip/knee/ankle"\n'
        f"{attributes}\n{inside}\n}}\n"
    )


def goal(attributes="", name="Goal", translate="(1, 2, 3)"):
    return f"""
    def MotionGoal "{name}" {{
        double3 xformOp:translate = {translate}
        uniform token[] xformOpOrder = ["xformOp:translate"]
        {attributes}
    }}
    """


CENTIMETRES = "timeCodesPerSecond = 24\nmetersPerUnit = 0.01"
SCALED = """float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:scale"]"""


MOVING = """
    double xformOp:rotateY.timeSamples = { 1: 0, 5: 90 }
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (10, 1, 2) }
    float3 xformOp:scale.timeSamples = { 1: (2, 2, 2), 5: (3, 3, 3) }
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY", "xformOp:scale"]
"""


@pytest.fixture(scope="session")
def text():
    """Return what builds the text of small stages."""

    class Text:
        IDENTITY, JOINTS, OFFSETS, REST, BIND = IDENTITY, JOINTS, OFFSETS, REST, BIND
        at, listed, quoted, sampled = map(staticmethod, (at, listed, quoted, sampled))
        poses, man = staticmethod(poses), staticmethod(man)
        edit, hold, goal = map(staticmethod, (edit, hold, goal))
        CENTIMETRES, SCALED, MOVING = CENTIMETRES, SCALED, MOVING

    return Text


@pytest.fixture
def save(tmp_path):
    """Return a function that writes the text of a layer and returns its path."""

    def write(body, name="shot.usda", header='metersPerUnit = 1\nupAxis = "Y"'):
        path = tmp_path / name
        path.write_text(f"#usda 1.0\n(\n{header}\n)\n{body}")
        return path

    return write


def query(stage, skeleton):
    return UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(stage.GetPrimAtPath(skeleton)))


def truth(path, skeleton, time_codes, animation=None):
    """Return world positions [m] and axes of all joints, as UsdSkel computes them."""
    stage = Usd.Stage.Open(str(path))
    found = query(stage, skeleton)
    cache = UsdGeom.XformCache()
    matrices = []
    for code in time_codes:
        cache.SetTime(code)
        world = np.array(cache.GetLocalToWorldTransform(stage.GetPrimAtPath(skeleton)))
        matrices.append(np.array(found.ComputeJointSkelTransforms(code)) @ world)
    matrices = np.array(matrices)
    axes = matrices[..., :3, :3]
    # A frame that is mirrored through a point has the rotation of the one that is not.
    axes = axes * np.sign(np.linalg.det(axes))[..., None, None]
    axes = axes / np.linalg.norm(axes, axis=-1, keepdims=True)
    return matrices[..., 3, :3] * UsdGeom.GetStageMetersPerUnit(stage), axes


@pytest.fixture(scope="session")
def skel():
    """Return functions that ask UsdSkel."""

    class Skel:
        query, truth = staticmethod(query), staticmethod(truth)

    return Skel


def agrees(shot, atol=1e-5):
    """Check every character of a shot against UsdSkel."""
    for scene in shot.scenes:
        cast = scene.cast
        for character in scene.characters:
            tokens = character.skeleton.joints
            nodes = [cast.index[(character.path, token)] for token in tokens]
            positions, axes = truth(shot.path, character.path, scene.time_codes)
            size = max(1.0, np.abs(positions).max())
            np.testing.assert_allclose(cast.positions[:, nodes], positions, atol=atol * size)
            for axis in range(3):
                turned = rotate(cast.orientations[:, nodes], np.eye(3)[axis])
                np.testing.assert_allclose(turned, axes[..., axis, :], atol=atol)


def unchanged(shot):
    """Return results that leave every motion as it was read."""
    return [
        usd.Result(edit.path, scene.character(edit.skeleton).motion, "nobody", {"gain": 0.5})
        for scene in shot.scenes
        for edit in scene.edits
    ]


def lasts(shot, folder, **options):
    """Check the law: written back unchanged, a motion is what it was, on every layer of it."""
    before = {name: Path(name).read_bytes() for name in shot.layers}
    layer, again, composed = (folder / f"{n}.usda" for n in ("edit", "again", "composed"))
    usd.write(shot, unchanged(shot), layer)
    usd.write(shot, unchanged(shot), again)
    assert layer.read_bytes() == again.read_bytes()
    usd.compose(shot, layer, composed)
    old, new = Usd.Stage.Open(str(shot.path)), Usd.Stage.Open(str(composed))
    assert not new.GetCompositionErrors()
    for scene in shot.scenes:
        codes = scene.time_codes
        between = (codes[1:] + codes[:-1]) / 2.0
        for edit in scene.edits:
            one, other = query(old, edit.skeleton), query(new, edit.skeleton)
            assert other.GetAnimQuery().GetPrim().GetName() == edit.path.split("/")[-1] + "_result"
            own = next(take.own for take in shot.takes if take.edit == edit.path)
            kept = np.isin(codes, own.time_codes).all()
            for code in (*codes, *between, codes[0] - 3.0, codes[-1] + 3.0):
                np.testing.assert_allclose(
                    np.array(one.ComputeJointSkelTransforms(code)),
                    np.array(other.ComputeJointSkelTransforms(code)),
                    rtol=0.0,
                    # Between samples that an offset has rounded USD comes as near as this.
                    atol=0.0 if kept and code in codes else 1e-5,
                )
    # What was read does not hold the result, so reading it with its result gives the same again.
    reread = usd.read(composed, kinds=built_in(), **options)
    usd.write(reread, unchanged(reread), again)
    assert layer.read_bytes() == again.read_bytes()
    assert {name: Path(name).read_bytes() for name in shot.layers} == before


@pytest.fixture
def check(tmp_path):
    """Return a function that reads a stage, compares it with UsdSkel, and writes it back."""

    def run(path, *, law=True, atol=1e-5, **options):
        shot = usd.read(path, kinds=built_in(), **options)
        agrees(shot, atol)
        if law:
            folder = tmp_path / "written"
            folder.mkdir(exist_ok=True)
            lasts(shot, folder, **options)
        return shot

    return run


@pytest.fixture
def read():
    """Return a function that reads a stage with the built-in kinds."""

    def run(path, **options):
        return usd.read(path, kinds=built_in(), **options)

    return run


@pytest.fixture
def leave():
    """Return a function that makes results that change nothing."""
    return unchanged
