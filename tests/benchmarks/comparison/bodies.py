"""A character as MJCF, which MuJoCo and Pinocchio both read: ball joints under a free root."""

from collections.abc import Mapping
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

import numpy as np

from usdmotion import Character
from usdmotion.arrays import Floats

LEAST = 1e-9
"""MuJoCo has no massless bodies: what a joint without a mass weighs [kg], and its inertia."""
ROOT = "root_joint"
"""Name of the first joint, which has six degrees of freedom; by it pink knows a floating base."""


@dataclass(frozen=True, eq=False)
class Point:
    """A point fixed to a joint."""

    joint: int
    place: Floats
    """In the joint's frame [m], shape (3,)."""


def mjcf(character: Character, points: Mapping[str, Point]) -> str:
    """Return the text of a model whose centre of mass is the character's, with named points.

    Every joint turns from its rest orientation but the first one, which is free. Bodies and joints
    are named by their index, because a token may have slashes.
    """
    skeleton, body = character.skeleton, character.body
    model = Element("mujoco", model="body")
    SubElement(model, "compiler", angle="radian")
    nodes = {-1: SubElement(model, "worldbody")}
    for joint, parent in enumerate(skeleton.parents.tolist()):
        place, turn = skeleton.rest_translations[joint], skeleton.rest_rotations[joint]
        node = nodes[joint] = SubElement(nodes[parent], "body", name=f"body{joint}")
        if joint == 0:
            SubElement(node, "freejoint", name=ROOT)
        else:
            # MuJoCo's quaternions are wxyz.
            node.attrib |= {"pos": _words(place), "quat": _words(np.roll(turn, 1))}
            SubElement(node, "joint", name=f"joint{joint}", type="ball")
        _weigh(node, float(body.masses[joint]), body.mass_centers[joint])
        for name, point in points.items():
            if point.joint == joint:
                SubElement(node, "site", name=name, pos=_words(point.place))
    ElementTree.indent(model)
    return ElementTree.tostring(model, encoding="unicode") + "\n"


def _weigh(node: Element, mass: float, center: Floats) -> None:
    """Give a body its mass; its inertia is made up, because no kinematics asks for it."""
    inertia = np.full(3, max(0.01 * mass, LEAST))
    weight = {"pos": _words(center), "mass": repr(max(mass, LEAST))}
    SubElement(node, "inertial", weight, diaginertia=_words(inertia))


def _words(values: Floats) -> str:
    return " ".join(repr(float(value)) for value in values)
