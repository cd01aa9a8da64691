"""The body that other libraries read moves and weighs as ours does."""

from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from compare import NAMES
from comparison.bodies import Point, mjcf
from comparison.exchange import given
from comparison.rounds import Task
from reaching import character, reaching
from scipy.spatial.transform import Rotation

from usdmotion import Character
from usdmotion.arrays import Floats
from usdmotion.demos.gait import Walk
from usdmotion.kernels import residuals
from usdmotion.testing import arm_scene


def numbers(node: Element, name: str, default: str) -> Floats:
    return np.array(node.get(name, default).split(), dtype=float)


class Reading:
    """The kinematics of a model's file by itself, at one frame of a motion."""

    def __init__(self, text: str, root: Floats, turns: Floats) -> None:
        self.sites: dict[str, Floats] = {}
        self.bodies: dict[int, Floats] = {}
        self.weights: list[float] = []
        self.centers: list[Floats] = []
        self.root, self.turns = np.array(root), Rotation.from_quat(turns)
        world = ElementTree.fromstring(text).find("worldbody")
        assert world is not None
        self.descend(world, np.zeros(3), Rotation.identity())

    def descend(self, above: Element, place: Floats, turn: Rotation) -> None:
        for node in above.findall("body"):
            joint = int(node.attrib["name"].removeprefix("body"))
            free = node.find("freejoint") is not None
            wxyz = numbers(node, "quat", "1 0 0 0")
            here = place + turn.apply(self.root if free else numbers(node, "pos", "0 0 0"))
            faces = turn * Rotation.from_quat(np.roll(wxyz, -1)) * self.turns[joint]
            weight = node.find("inertial")
            assert weight is not None
            self.bodies[joint] = here
            self.weights.append(float(weight.attrib["mass"]))
            self.centers.append(here + faces.apply(numbers(weight, "pos", "0 0 0")))
            for site in node.findall("site"):
                self.sites[site.attrib["name"]] = here + faces.apply(numbers(site, "pos", ""))
            self.descend(node, here, faces)

    @property
    def center_of_mass(self) -> Floats:
        return np.average(self.centers, axis=0, weights=self.weights)


def test_points_and_the_centre_of_mass_are_where_our_kinematics_has_them(
    task: Task,
) -> None:
    text = (task.folder / "model.xml").read_text()
    before, table = given(task.problem), task.problem.table
    for frame in (0, 7, 24):
        body = Reading(text, before.root[frame], before.turns[frame])
        cast = task.problem.cast
        assert np.allclose(list(body.bodies.values()), cast.positions[frame, 1:], atol=1e-12)
        ours = residuals(table, cast.positions, cast.orientations)[frame]
        places = np.array([*(body.sites[name] for name in NAMES[:-1]), body.center_of_mass])
        away = np.linalg.norm(table.target[frame] - places, axis=1)
        assert np.allclose(away, ours, atol=1e-8)


def test_joints_turn_from_a_rest_that_is_not_upright() -> None:
    (arm,) = arm_scene().characters
    turned = Rotation.from_rotvec(np.outer([1, 2, 3, 4], [0.3, -0.2, 0.1])).as_quat()
    skeleton = type(arm.skeleton)(
        arm.skeleton.joints, arm.skeleton.parents, arm.skeleton.rest_translations, turned
    )
    character = Character(arm.path, skeleton, arm.body, arm.motion, arm.placement, arm.root)
    text = mjcf(character, {"palm": Point(3, np.array((0.1, 0.0, 0.0)))})
    body = Reading(text, np.zeros(3), np.tile((0.0, 0.0, 0.0, 1.0), (4, 1)))
    turn = Rotation.identity()
    place = np.zeros(3)
    for joint in range(4):
        if joint:
            place = place + turn.apply(np.array(skeleton.rest_translations[joint]))
        turn = turn * (Rotation.from_quat(turned[joint]) if joint else Rotation.identity())
    assert np.allclose(body.sites["palm"], place + turn.apply((0.1, 0.0, 0.0)))


def test_the_body_weighs_what_ours_weighs(walking: Walk, task: Task) -> None:
    before = given(task.problem)
    text = (task.folder / "model.xml").read_text()
    weights = Reading(text, before.root[0], before.turns[0]).weights
    assert np.allclose(weights, character(walking).body.masses, atol=1e-8)
    assert min(weights) > 0.0
    assert reaching(walking).cast.masses.min() == 0.0
