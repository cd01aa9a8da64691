"""Contacts in the world are told in the frame that they are in, and read back as they were."""

import dataclasses

import numpy as np
import pytest
from pxr import Usd

from usdmotion import usd
from usdmotion.constraints import ContactConstraint, Space
from usdmotion.errors import SceneError
from usdmotion.kernels import multiply, rotate

EDIT = "/Man/Bones/Edit"
CODES = np.arange(1.0, 6.0)
TURNED = """double3 xformOp:translate = (50, -20, 10)
    double3 xformOp:rotateXYZ = (20, 50, -70)
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]"""
MOVING = """double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (50, 0, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]"""
CONTACT = ContactConstraint(
    path="",
    skeleton="/Man/Bones",
    joint="hip",
    kind="plane",
    point=np.array((0.1, 0.2, 0.3)),
    orientation=np.array((0.0, 0.6, 0.0, 0.8)),
    axis=np.array((0.6, 0.0, 0.8)),
    residual=0.01,
)


def in_world(contact):
    """Return location, orientation and axis of a contact in the world, for each frame."""
    space = contact.space
    turns = np.broadcast_to(space.rotation, (len(CODES), 4))
    places = space.translation + rotate(turns, contact.location)
    return places, multiply(turns, contact.orientation), rotate(turns, contact.axis)


@pytest.mark.parametrize("location", [(1.0, 2.0, 3.0), (0.0, 0.0, 0.0)])
def test_a_contact_in_the_world_is_read_as_such_under_a_parent_that_is_turned_and_scaled(
    text, save, read, location
):
    path = save(text.man(edit="", xform=TURNED), header="metersPerUnit = 0.01")
    stage = Usd.Stage.Open(str(path))
    usd.author_edit(stage, EDIT)
    contact = dataclasses.replace(CONTACT, location=np.array(location))
    usd.author(stage, f"{EDIT}/It", contact, time_codes=CODES)
    stage.Save()
    del stage
    (found,) = read(path).scenes[0].constraints
    for there, wanted in zip(in_world(found), in_world(contact), strict=True):
        np.testing.assert_allclose(there, wanted, atol=1e-6)
    assert (found.kind, found.residual) == ("plane", pytest.approx(0.01))


def test_a_contact_in_the_world_is_told_in_the_prim_that_its_space_names(text, save, read):
    there = f'def Xform "Place" {{ {TURNED}\n }}'
    path = save(text.man(edit="", xform=MOVING) + there, header="metersPerUnit = 0.01")
    stage = Usd.Stage.Open(str(path))
    usd.author_edit(stage, EDIT)
    contact = dataclasses.replace(CONTACT, location=np.array((1.0, 2.0, 3.0)))
    with pytest.raises(SceneError, match="in a frame that moves"):
        usd.author(stage, f"{EDIT}/It", contact, time_codes=CODES)
    stage.GetPrimAtPath(f"{EDIT}/It").GetRelationship("usdmotion:space").SetTargets(["/Place"])
    usd.author(stage, f"{EDIT}/It", contact, time_codes=CODES)
    stage.Save()
    del stage
    (found,) = read(path).scenes[0].constraints
    for there, wanted in zip(in_world(found), in_world(contact), strict=True):
        np.testing.assert_allclose(there, wanted, atol=1e-6)


def test_a_contact_in_the_frame_of_a_joint_cannot_be_authored(text, save):
    stage = Usd.Stage.Open(str(save(text.man(edit=""))))
    held = ContactConstraint(
        path="", skeleton="/Man/Bones", joint="hip", space=Space(joint=("/Man/Bones", "hip/head"))
    )
    usd.author_edit(stage, EDIT)
    with pytest.raises(SceneError, match="which a MotionContactConstraint cannot"):
        usd.author(stage, f"{EDIT}/It", held)
