"""Small scenes that need no USD: an arm, a humanoid that shifts its weight, and a crowd of them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.cast import Character
from usdmotion.constraints import Constraint, Goal
from usdmotion.kernels import compose, forward, from_vector, multiply, rotate
from usdmotion.motion import Body, Motion, Placement, Skeleton
from usdmotion.scene import Edit, Scene

ARM = "/Arm"
"""Path of the skeleton of `arm_scene`; its joints are base, shoulder, elbow, wrist."""
HUMANOID = "/Humanoid"
"""Path of the skeleton of `humanoid_scene`."""

_Joints = Mapping[str, tuple[tuple[float, float, float], tuple[float, float, float], float]]
"""Path of each joint: rest translation [m], sway of its rotation [rad], mass [kg]."""

_ARM_JOINTS: _Joints = {
    "base": ((0.0, 1.0, 0.0), (0.0, 0.0, 0.0), 20.0),
    "base/shoulder": ((0.0, 0.4, 0.0), (0.3, 0.2, 0.4), 2.0),
    "base/shoulder/elbow": ((0.3, 0.0, 0.0), (0.0, 0.7, 0.0), 1.5),
    "base/shoulder/elbow/wrist": ((0.28, 0.0, 0.0), (0.1, 0.0, 0.2), 0.5),
}


def _side(name: str, x: float) -> _Joints:
    """Return the limbs of one side of the humanoid; x is 1 on its left, -1 on its right."""
    hip = f"pelvis/{name}_hip"
    arm = f"pelvis/spine/chest/{name}_shoulder"
    return {
        hip: ((0.09 * x, -0.05, 0.0), (-0.25, 0.0, 0.1), 7.0),
        f"{hip}/{name}_knee": ((0.0, -0.42, 0.0), (0.5, 0.0, 0.0), 3.0),
        f"{hip}/{name}_knee/{name}_ankle": ((0.0, -0.42, 0.0), (-0.25, 0.0, -0.1), 1.0),
        arm: ((0.18 * x, 0.2, 0.0), (0.2, 0.0, -1.2 * x), 2.0),
        f"{arm}/{name}_elbow": ((0.28 * x, 0.0, 0.0), (0.0, -0.6 * x, 0.0), 1.3),
        f"{arm}/{name}_elbow/{name}_wrist": ((0.26 * x, 0.0, 0.0), (0.1, 0.1, 0.0), 0.6),
    }


_HUMANOID_JOINTS: _Joints = {
    "pelvis": ((0.0, 0.93, 0.0), (0.05, 0.1, 0.0), 10.0),
    "pelvis/spine": ((0.0, 0.1, 0.0), (0.1, 0.0, 0.0), 8.0),
    "pelvis/spine/chest": ((0.0, 0.2, 0.0), (0.05, -0.1, 0.0), 15.0),
    "pelvis/spine/chest/head": ((0.0, 0.3, 0.0), (-0.1, 0.1, 0.0), 5.0),
    **_side("left", 1.0),
    **_side("right", -1.0),
}


def arm_scene(constraints: Sequence[Constraint] = (), *, frame_count: int = 12) -> Scene:
    """Return a scene of one arm on a fixed base, up to 0.58 m long, at 24 frames per second."""
    return _scene(ARM, _ARM_JOINTS, constraints, frame_count)


def humanoid_scene(constraints: Sequence[Constraint] = (), *, frame_count: int = 24) -> Scene:
    """Return a scene of a humanoid of 16 joints with masses, at 24 frames per second."""
    return _scene(HUMANOID, _HUMANOID_JOINTS, constraints, frame_count)


def crowd_scene(
    constraints: Sequence[Constraint] = (), *, count: int = 2, frame_count: int = 24
) -> Scene:
    """Return a scene of humanoids in pairs, half a metre apart, who look at each other.

    Args:
        constraints: What is asked, each of the humanoid that its `skeleton` names.
        count: How many they are; their paths are `member(0)`, `member(1)`, …
        frame_count: At 24 frames per second.
    """
    (alone,) = humanoid_scene(frame_count=frame_count).characters
    round_about = np.array([0.0, 1.0, 0.0, 0.0])
    characters, edits = [], []
    for index in range(count):
        place = Placement.identity(frame_count)
        if index % 2:
            place = Placement(
                np.tile((0.0, 0.0, 0.5), (frame_count, 1)), np.tile(round_about, (frame_count, 1))
            )
        aside = np.array([2.0 * (index // 2), 0.0, 0.0])
        place = Placement(place.translations + aside, place.rotations)
        path = member(index)
        characters.append(replace(alone, path=path, placement=place))
        own = tuple(each for each in constraints if each.skeleton == path)
        edits.append(Edit(f"{path}/Edit", path, own))
    codes = np.arange(1.0, frame_count + 1.0)
    return Scene(tuple(characters), tuple(edits), codes, np.array([0.0, 1.0, 0.0]))


def member(index: int) -> str:
    """Return the path of a skeleton of `crowd_scene`; the first is `HUMANOID`."""
    return f"{HUMANOID}{index or ''}"


def posed(scene: Scene, turns: Mapping[str, tuple[float, float, float]]) -> tuple[Floats, Floats]:
    """Return where the joints of a scene's first character would be in another motion.

    Args:
        scene: The scene.
        turns: Rotation vectors [rad] applied to the joints of some tokens, in their own frames.

    Returns:
        World positions [m], shape (frame_count, joint_count, 3), and orientations.
    """
    cast, path = scene.cast, scene.characters[0].path
    rotations = np.array(cast.rotations)
    for token, turn in turns.items():
        node = cast.index[path, token]
        rotations[:, node] = multiply(rotations[:, node], from_vector(np.array([turn])))
    positions, orientations = forward(cast.parents, cast.translations, rotations)
    joints = slice(1, 1 + len(scene.characters[0].skeleton.joints))
    return positions[:, joints], orientations[:, joints]


def moved(scene: Scene, translation: Floats, rotation: Floats) -> Scene:
    """Return a scene turned by a rotation (xyzw) about the origin, then moved [m], as a whole."""

    def placed(character: Character) -> Character:
        place = character.placement
        frame = compose(translation, rotation[None], place.translations, place.rotations)
        return replace(character, placement=Placement(*frame))

    def aimed(goal: Goal) -> Goal:
        if goal.joint is not None:
            return goal
        shift = translation if goal.mode == "position" else np.zeros(3)
        return replace(
            goal,
            translation=rotate(rotation, goal.translation) + shift,
            rotation=multiply(rotation, goal.rotation),
            axes=multiply(rotation, goal.axes),
        )

    def turned(edit: Edit) -> Edit:
        constraints = (
            replace(each, goals=tuple(map(aimed, each.goals))) for each in edit.constraints
        )
        return replace(edit, constraints=tuple(constraints))

    return replace(
        scene,
        characters=tuple(map(placed, scene.characters)),
        edits=tuple(map(turned, scene.edits)),
        up=rotate(rotation, scene.up),
    )


def _scene(
    path: str, joints: _Joints, constraints: Sequence[Constraint], frame_count: int
) -> Scene:
    tokens = tuple(joints)
    parents = [tokens.index(above) if above else -1 for above in map(_above, tokens)]
    rests = np.array([rest for rest, _, _ in joints.values()])
    sways = np.array([sway for _, sway, _ in joints.values()])
    times = np.arange(frame_count) / 24.0
    # A smooth swing that never passes through a stretched arm or leg.
    swing = 0.75 + 0.25 * np.sin(2.0 * np.pi * times)
    skeleton = Skeleton(
        tokens, np.array(parents), rests, np.tile((0.0, 0.0, 0.0, 1.0), (len(tokens), 1))
    )
    motion = Motion(
        times,
        np.broadcast_to(rests, (frame_count, *rests.shape)),
        from_vector(swing[:, None, None] * sways),
    )
    masses = np.array([mass for _, _, mass in joints.values()])
    body = replace(Body.unknown(len(tokens)), masses=masses)
    character = Character(path, skeleton, body, motion, Placement.identity(frame_count), root=0)
    edit = Edit(f"{path}/Edit", path, tuple(constraints))
    return Scene(
        (character,), (edit,), np.arange(1.0, frame_count + 1.0), np.array([0.0, 1.0, 0.0])
    )


def _above(token: str) -> str:
    return token.rpartition("/")[0]
