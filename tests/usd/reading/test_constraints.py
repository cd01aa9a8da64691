"""Constraints of any kind, in our units."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from usdmotion import usd
from usdmotion.constraints import Constraint, attribute, built_in
from usdmotion.errors import SceneError


def test_every_attribute_of_a_constraint_is_read_in_our_units(text, first):
    held = first(
        text.hold(
            attributes="""uniform int usdmotion:priority = 3
            double usdmotion:weight = 0.5
            double usdmotion:activity.timeSamples = { 1: 0, 5: 1 }
            uniform timecode[] usdmotion:times = [1, 2, 4, 5]
            uniform point3d usdmotion:point = (1, 2, 3)
            uniform token[] usdmotion:recruits = ["hip/knee", "hip"]
            uniform double usdmotion:tolerance = 0.5
            uniform token usdmotion:axes = "xz"
        """
        )
    )
    assert (held.priority, held.weight, held.axes) == (3, 0.5, "xz")
    np.testing.assert_allclose(held.activity, (0, 0.25, 0.5, 0.75, 1))
    np.testing.assert_allclose(held.times, (0, 1 / 24, 3 / 24, 4 / 24))
    np.testing.assert_allclose(held.point, (0.01, 0.02, 0.03))
    assert held.recruits == ("hip/knee", "hip")
    assert held.tolerance == pytest.approx(0.005)
    assert held.path == "/Man/Bones/Edit/Hold"
    assert held.skeleton == "/Man/Bones"


def test_a_tolerance_of_a_rotation_stays_in_degrees_and_quaternions_become_xyzw(text, first):
    held = first(
        text.hold(
            kind="MotionOrientationConstraint",
            attributes="""uniform double usdmotion:tolerance = 0.5
            uniform quatf usdmotion:rotation = (0.8, 0, 0.6, 0)
            uniform vector3f usdmotion:freeAxis = (0, 1, 0)
        """,
        )
    )
    assert held.tolerance == 0.5
    np.testing.assert_allclose(held.rotation, (0, 0.6, 0, 0.8), rtol=1e-6)
    assert held.free_axis.tolist() == [0, 1, 0]


def test_an_activity_may_be_a_spline(text, first):
    held = first(text.hold(attributes="double usdmotion:activity.spline = { 1: 0, 3: 1 }"))
    assert np.shape(held.activity) == (5,)
    assert held.activity[0] == 0.0
    assert held.activity[-1] == 1.0


def test_what_is_animated_but_does_not_change_is_one_value(text, first):
    held = first(text.hold(attributes="double usdmotion:activity.timeSamples = { 1: 0.5, 5: 0.5 }"))
    assert held.activity == 0.5


def test_key_times_follow_the_offsets_of_layers(text, save, read):
    times = "uniform timecode[] usdmotion:times = [1, 2]"
    save(text.man(edit=text.edit(text.hold(attributes=times))), "asset.usda", "metersPerUnit = 1")
    body = 'def "Man" (references = @./asset.usda@</Man> (offset = 10; scale = 3)) {}'
    (scene,) = read(save(body)).scenes
    assert scene.constraints[0].times == (0, 3 / 24)


def test_a_point_in_a_scaled_joint_is_in_metres(text, save, read):
    point = text.hold(attributes="uniform point3d usdmotion:point = (1, 0, 0)")
    animation = (
        text.poses(scales=False)
        + """
    half3[] scales = [(2, 2, 2), (1, 1, 1), (3, 1, 1), (1, 1, 1)]"""
    )
    man = text.man(edit=text.edit(point), xform=text.SCALED, animation=animation)
    (scene,) = read(save(man, header=text.CENTIMETRES)).scenes
    np.testing.assert_allclose(scene.constraints[0].point, (0.01 * 2 * 2 * 3, 0, 0))


def test_constraints_are_read_at_any_depth_in_the_order_of_the_stage(text, save, read):
    inside = (
        text.hold(name="B")
        + f'def Scope "Feet" {{\n{text.hold(name="A")}\n}}'
        + text.hold(name="C")
    )
    (scene,) = read(save(text.man(edit=text.edit(inside)))).scenes
    assert [each.path.rsplit("/", 1)[1] for each in scene.constraints] == ["B", "A", "C"]


@pytest.mark.parametrize("kind", ["MotionStudioConstraint", "MotionSomethingConstraint"])
def test_a_constraint_that_nobody_can_solve_is_refused_by_name(text, save, read, kind):
    path = save(text.man(edit=text.edit(text.hold(kind=kind))))
    with pytest.raises(SceneError, match=f"</Man/Bones/Edit/Hold> is a {kind}, which nothing"):
        read(path)


def test_a_constraint_that_is_not_active_may_be_anything(text, save, read):
    off = 'def MotionStudioConstraint "Off" (active = false) {}'
    assert read(save(text.man(edit=text.edit(off)))).scenes[0].constraints == ()


@pytest.mark.parametrize(
    ("attribute", "why"),
    [
        ('uniform token[] usdmotion:recruits = ["hip", "nose"]', "'nose'"),
        ('uniform token usdmotion:axes = "w"', "'w' in usdmotion:axes"),
        ("uniform timecode[] usdmotion:times = [3, 2]", "sort them"),
    ],
)
def test_a_constraint_at_fault_is_refused_in_the_words_of_its_fault(
    text, save, read, attribute, why
):
    with pytest.raises(SceneError, match=rf"shot.usda: </Man/Bones/Edit/Hold>.*{why}"):
        read(save(text.man(edit=text.edit(text.hold(attributes=attribute)))))


def test_a_value_that_is_blocked_for_a_while_is_refused(text, first):
    with pytest.raises(SceneError, match="Edit/Hold> has nan in usdmotion:weight at 2"):
        first(text.hold(attributes="double usdmotion:weight.timeSamples = { 1: 3, 2: None, 4: 5 }"))


@dataclass(frozen=True, eq=False, kw_only=True)
class StudioConstraint(Constraint):
    """A kind that some plugin brings."""

    schema: ClassVar[str] = "MotionStudioConstraint"
    strength: float = attribute(2.0, animated=True)
    reach: float = attribute(0.0, unit="length")
    names: tuple[str, ...] = attribute(())


def test_a_kind_of_a_plugin_is_read_like_our_own(text, save):
    attributes = """custom double usdmotion:strength.timeSamples = { 1: 0, 5: 4 }
    custom double usdmotion:reach = 50
    custom token[] usdmotion:names = ["a", "b"]"""
    body = text.man(edit=text.edit(text.hold(kind="MotionStudioConstraint", attributes=attributes)))
    shot = usd.read(save(body, header=text.CENTIMETRES), kinds=[*built_in(), StudioConstraint])
    (held,) = shot.scenes[0].constraints
    assert isinstance(held, StudioConstraint)
    np.testing.assert_allclose(held.strength, (0, 1, 2, 3, 4))
    assert (held.reach, held.names, held.joint) == (0.5, ("a", "b"), "hip/knee/ankle")
