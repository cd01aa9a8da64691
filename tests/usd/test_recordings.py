"""Recordings and made-up characters as stages: they move as they should and can be looked at."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSkel

from usdmotion import usd
from usdmotion.errors import FileError, SceneError
from usdmotion.kernels import forward, from_vector
from usdmotion.motion import Body, Motion, Skeleton
from usdmotion.recording import Recording

SKELETON = Skeleton(
    ("Hips", "Hips/Spine", "Hips/Spine/Zero", "Hips/Leg_L", "Hips/Leg_L/Foot_L"),
    np.array((-1, 0, 1, 0, 3)),
    np.array(((0, 1.0, 0), (0, 0.4, 0), (0, 0, 0), (0.1, 0, 0), (0, -0.5, 0.02))),
    from_vector(np.linspace(-0.3, 0.4, 15).reshape(5, 3)),
)


def motion(frame_count=7):
    random = np.random.default_rng(1)
    translations = np.tile(SKELETON.rest_translations, (frame_count, 1, 1))
    translations[:, 0] += random.normal(size=(frame_count, 3))
    turns = from_vector(random.normal(size=(frame_count, 5, 3)))
    return Motion(np.arange(frame_count) / 120, translations, turns)


def recording(**options):
    facts = {
        "name": "walk",
        "skeleton": SKELETON,
        "motion": motion(),
        "frame_rate": 120.0,
        "original_names": ("Hips", "Spine 1", "Zero", "Leg:L", "Foot L"),
        "up": "Z",
        "tip_joints": np.array((2, 4)),
        "tip_points": np.array(((0, 0.3, 0), (0, 0, 0.2))),
    }
    return Recording(**(facts | options))


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a recording and opens its stage."""

    def run(recorded=None, *, frame_rate=None, first=1.0, suffix=".usda"):
        path = tmp_path / f"walk{suffix}"
        usd.write_recording(recorded or recording(), path, frame_rate=frame_rate, first=first)
        return Usd.Stage.Open(str(path))

    return run


@pytest.mark.parametrize("suffix", [".usda", ".usdc"])
def test_usd_shows_what_was_recorded(written, skel, suffix):
    stage = written(suffix=suffix)
    positions, _ = forward(SKELETON.parents, motion().translations, motion().rotations)
    for frame in range(7):
        found = skel.query(stage, "/walk/Skeleton").ComputeJointSkelTransforms(1 + frame)
        np.testing.assert_allclose(np.array(found)[:, 3, :3] * 0.01, positions[frame], atol=1e-6)


def test_the_stage_says_all_that_there_is_to_say(written):
    stage = written(frame_rate=30.0, first=1001)
    layer = stage.GetRootLayer()
    assert (layer.timeCodesPerSecond, layer.framesPerSecond) == (30, 30)
    assert (layer.startTimeCode, layer.endTimeCode) == (1001, 1002.5)
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.01
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert stage.GetDefaultPrim().IsA(UsdSkel.Root)


def test_samples_stand_on_whole_time_codes_whatever_the_rate_rounds(written):
    odd = recording(frame_rate=29.97, motion=Motion(np.arange(7) / 29.97, *moved()))
    stage = written(odd)
    attribute = stage.GetPrimAtPath("/walk/Animation").GetAttribute("rotations")
    assert attribute.GetTimeSamples() == [1, 2, 3, 4, 5, 6, 7]


def moved():
    return motion().translations, motion().rotations


def test_the_names_of_the_file_are_kept(written):
    stage = written()
    prim = stage.GetPrimAtPath("/walk/Skeleton")
    names = ["Hips", "Spine 1", "Zero", "Leg:L", "Foot L"]
    assert list(UsdSkel.Skeleton(prim).GetJointNamesAttr().Get()) == names
    assert list(prim.GetCustomDataByKey("usdmotion:originalNames")) == names


def test_there_is_a_guide_that_moves_with_its_joints(written):
    stage = written()
    root = UsdSkel.Root(stage.GetPrimAtPath("/walk"))
    cache = UsdSkel.Cache()
    cache.Populate(root, Usd.TraverseInstanceProxies())
    (binding,) = cache.ComputeSkelBindings(root, Usd.TraverseInstanceProxies())
    (skinning,) = binding.GetSkinningTargets()
    mesh = UsdGeom.Mesh(skinning.GetPrim())
    assert mesh.ComputePurpose() == "default"
    points = mesh.GetPointsAttr().Get()
    transforms = cache.GetSkelQuery(binding.GetSkeleton()).ComputeSkinningTransforms(4)
    assert skinning.ComputeSkinnedPoints(transforms, points, 4)
    positions, _ = forward(SKELETON.parents, *moved())
    starts = np.asarray(points)[::6] * 0.01  # one octahedron a segment, its start first
    for joint in (0, 3):
        assert np.abs(starts - positions[3, joint]).sum(axis=1).min() < 1e-5


def test_octahedra_are_closed_and_face_outwards(written):
    stage = written()
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/walk/Guide"))
    points = np.asarray(mesh.GetPointsAttr().Get(), dtype=float)
    faces = np.asarray(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 8, 3)
    assert len(faces) == 5  # three segments between joints that are apart, and two tips
    for octahedron in faces:
        corners = points[octahedron] - points[octahedron].mean(axis=(0, 1))
        volumes = np.einsum("fi,fi->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
        assert (volumes > 0).all()
        edges = {(face[i], face[i - 2]) for face in octahedron.tolist() for i in range(3)}
        assert {(b, a) for a, b in edges} == edges


def test_the_extent_holds_the_body_on_every_frame(written):
    stage = written()
    low, high = np.asarray(UsdSkel.Root(stage.GetPrimAtPath("/walk")).GetExtentAttr().Get()) * 0.01
    positions, _ = forward(SKELETON.parents, *moved())
    assert (positions > low).all()
    assert (positions < high).all()


def test_a_recording_can_be_edited_at_once(written, read, tmp_path):
    stage = written()
    usd.author_edit(stage, "/walk/Skeleton/Edit")
    stage.Save()
    del stage
    scene = read(tmp_path / "walk.usda").scenes[0]
    np.testing.assert_allclose(scene.characters[0].motion.translations, moved()[0], atol=1e-6)
    np.testing.assert_allclose(scene.characters[0].motion.times, motion().times, atol=1e-9)
    rest = scene.characters[0].skeleton
    np.testing.assert_allclose(rest.rest_translations, SKELETON.rest_translations, atol=1e-12)
    np.testing.assert_allclose(rest.rest_rotations, SKELETON.rest_rotations, atol=1e-9)


def test_the_same_recording_is_the_same_bytes(written, tmp_path):
    written()
    first = (tmp_path / "walk.usda").read_bytes()
    written()
    assert (tmp_path / "walk.usda").read_bytes() == first


def test_a_skeleton_of_one_joint_has_nothing_to_look_at_and_is_written(written):
    one = Skeleton(("Prop",), np.array((-1,)), np.zeros((1, 3)), np.array(((0, 0, 0, 1.0),)))
    still = Motion(np.zeros(1), np.zeros((1, 1, 3)), np.array((((0, 0, 0, 1.0),),)))
    bare = {"tip_joints": np.zeros(0), "tip_points": np.zeros((0, 3)), "original_names": ("Prop",)}
    stage = written(recording(skeleton=one, motion=still, **bare))
    assert not stage.GetPrimAtPath("/walk/Guide")


def test_a_recording_is_not_written_where_it_cannot_be(tmp_path):
    with pytest.raises(FileError, match="there is no folder"):
        usd.write_recording(recording(), tmp_path / "none" / "walk.usda")


# Characters ---------------------------------------------------------------------------------------

BODY = Body(
    masses=np.array((10.0, 20.0, 0.0, 8.0, 4.0)),
    mass_centers=np.linspace(-0.1, 0.1, 15).reshape(5, 3),
    limits_min=np.where(np.arange(15).reshape(5, 3) < 9, -np.inf, -20.0),
    limits_max=np.where(np.arange(15).reshape(5, 3) < 9, np.inf, 60.0),
    stiffness=np.array((0.0, 0.5, 0.0, 0.0, 0.25)),
)
PARTS = ("humanoid_root", "vl5", "", "l_hip", "l_talocrural")


def test_a_body_is_read_as_it_was_authored(tmp_path, read):
    stage = Usd.Stage.CreateNew(str(tmp_path / "shot.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    codes = np.arange(7.0)
    path = usd.author_character(stage, "/Ann", SKELETON, BODY, motion(), PARTS, time_codes=codes)
    usd.author_edit(stage, f"{path}/Edit")
    stage.Save()
    del stage
    character = read(tmp_path / "shot.usda").scenes[0].characters[0]
    for name in ("masses", "mass_centers", "limits_min", "limits_max", "stiffness"):
        np.testing.assert_allclose(getattr(character.body, name), getattr(BODY, name), atol=1e-7)
    assert character.root == 0


def test_of_a_body_that_is_not_known_nothing_is_said():
    stage = Usd.Stage.CreateInMemory()
    codes = np.arange(7.0)
    usd.author_character(stage, "/Ann", SKELETON, Body.unknown(5), motion(), time_codes=codes)
    prim = stage.GetPrimAtPath("/Ann/Skeleton")
    assert not prim.HasAPI("MotionSkeletonAPI")
    assert not [name for name in prim.GetAuthoredPropertyNames() if "usdmotion" in name]


def test_what_does_not_fit_together_is_refused():
    stage = Usd.Stage.CreateInMemory()
    for options, why in (
        ({"time_codes": np.arange(3.0)}, "3 time codes for 7 samples"),
        ({"time_codes": np.arange(7.0), "parts": ("vl5",)}, "1 parts for 5 joints"),
    ):
        with pytest.raises(SceneError, match=f"</Ann> is given {why}"):
            usd.author_character(stage, "/Ann", SKELETON, BODY, motion(), **options)


def test_usd_finds_nothing_wrong_with_a_character(written):
    validation = pytest.importorskip("pxr.UsdValidation")
    try:
        every = validation.ValidationRegistry().GetOrLoadAllValidators()
    except Exception as error:  # some wheels come without the libraries of their validators
        pytest.skip(str(error).splitlines()[0] or "no validators")
    errors = validation.ValidationContext(every).Validate(written())
    assert [error.GetMessage() for error in errors] == []
