"""Scenes as there is something to see of them, solved or not."""

import numpy as np

from usdmotion.arrays import Floats
from usdmotion.motion import WorldPose
from usdmotion.outcome import Outcome
from usdmotion.report.balance import Balance, balance_of, balancing, mass_center
from usdmotion.report.feet import footings
from usdmotion.report.findings import EditFindings, Findings, findings_of
from usdmotion.scene import Edit, Scene
from usdmotion.showing.effectors import courses, links, misses
from usdmotion.showing.goals import goal_marks
from usdmotion.showing.shown import Actor, BalanceMark, ShownEdit, ShownScene


def shown(outcome: Outcome, findings: Findings | None = None) -> ShownScene:
    """Return what there is to see of a scene that is solved.

    Args:
        outcome: The scene beside its results.
        findings: What there is to tell of it, where that was measured already.
    """
    findings = findings or findings_of(outcome)
    scene = outcome.scene
    edits = tuple(_solved(findings, each) for each in findings.edits)
    actors = _actors(scene, findings.before, findings.after, set(outcome.motions))
    return ShownScene(scene, actors, edits)


def shown_before(scene: Scene) -> ShownScene:
    """Return what there is to see of a scene that nobody solved.

    Raises:
        SceneError: A constraint names a joint that is not there, or asks for what cannot be.
    """
    before = (scene.cast.positions, scene.cast.orientations)
    edits = tuple(_asked(scene, each, before) for each in scene.edits)
    return ShownScene(scene, _actors(scene, before, None, set()), edits)


def _solved(findings: Findings, found: EditFindings) -> ShownEdit:
    scene, edit, after = findings.scene, found.edit, findings.after
    return ShownEdit(
        path=edit.path,
        skeleton=edit.skeleton,
        solved=True,
        courses=tuple(courses(scene, edit, after)),
        goals=tuple(goal_marks(scene, edit, after)),
        links=tuple(links(scene, edit, after)),
        misses=tuple(misses(scene, found.traces, after)),
        balance=_balance(scene, edit, found.balance, after, solved=True),
    )


def _asked(scene: Scene, edit: Edit, before: WorldPose) -> ShownEdit:
    found = balance_of(scene, edit, footings(scene, edit, before), before)
    return ShownEdit(
        path=edit.path,
        skeleton=edit.skeleton,
        solved=False,
        courses=tuple(courses(scene, edit, None)),
        goals=tuple(goal_marks(scene, edit, before)),
        links=tuple(links(scene, edit, None)),
        misses=(),
        balance=_balance(scene, edit, found, before, solved=False),
    )


def _balance(
    scene: Scene, edit: Edit, found: Balance | None, pose: WorldPose, *, solved: bool
) -> BalanceMark | None:
    """Return the mark of a balance; without supports where a constraint asks for none."""
    asking = balancing(edit)
    path = edit.path if asking is None else asking.path
    if found is not None:
        supports = found.supports
        after = found.after if solved else None
        there, bearing = (supports.after, supports.before), supports.bearing
        return BalanceMark(path, found.before, after, *there, bearing)
    if asking is None:
        return None
    cast = scene.cast
    before = mass_center(scene, edit.skeleton, (cast.positions, cast.orientations))
    nothing = np.zeros((cast.frame_count, 0, 3))
    after = mass_center(scene, edit.skeleton, pose) if solved else None
    return BalanceMark(path, before, after, nothing, nothing, nothing[:, :, 0] > 0.0)


def _actors(
    scene: Scene, before: WorldPose, after: WorldPose | None, solved: set[str]
) -> tuple[Actor, ...]:
    """Return who takes part; those that nothing solves have no pose after."""

    def own(pose: WorldPose, path: str) -> tuple[Floats, Floats]:
        joints = scene.nodes(path)
        return pose[0][:, joints], pose[1][:, joints]

    return tuple(
        Actor(
            each,
            own(before, each.path),
            own(after, each.path) if after is not None and each.path in solved else None,
        )
        for each in scene.characters
    )
