"""What cannot be right on a stage, or should be known of it, found without solving anything.

One list of plain functions, used by `usdmotion inspect` on every USD and offered to USD's own
validation where that takes validators in Python.
"""

from pxr import Usd

from usdmotion.usd.drawn import without_guides
from usdmotion.usd.faults.arrays import find_wrong_arrays, find_wrong_body_arrays
from usdmotion.usd.faults.balance import find_falls
from usdmotion.usd.faults.composition import find_composition_errors
from usdmotion.usd.faults.detections import find_idle_detections
from usdmotion.usd.faults.fault import Check, Fault, Severity, StageCheck
from usdmotion.usd.faults.grounds import find_wrong_grounds
from usdmotion.usd.faults.joints import (
    find_missing_effectors,
    find_unknown_joints,
    find_unknown_parts,
)
from usdmotion.usd.faults.kinds import (
    find_empty_distances,
    find_lost_goals,
    find_missing_regions,
    find_zero_axes,
)
from usdmotion.usd.faults.normalized import find_partial_motions
from usdmotion.usd.faults.recruits import find_broken_recruiting
from usdmotion.usd.faults.skeletons import (
    find_resting_animations,
    find_unreadable_animations,
    find_unreadable_skeletons,
    find_unsolvable_edits,
    find_unusable_bindings,
)
from usdmotion.usd.faults.targets import find_wrong_targets
from usdmotion.usd.faults.times import (
    find_wrong_key_times,
    find_wrong_ranges,
    find_wrong_trajectories,
)
from usdmotion.usd.faults.values import (
    find_misapplied_apis,
    find_missing_apis,
    find_wrong_values,
)

__all__ = ["CHECKS", "STAGE_CHECKS", "Check", "Fault", "Severity", "StageCheck", "find"]

EDIT = ("UsdMotionEdit",)
CONSTRAINT = ("UsdMotionConstraint",)
GOAL = ("UsdMotionGoal",)
DETECTION = ("UsdMotionDetection",)
NORMALIZED = ("UsdMotionNormalized",)
SKELETON = ("UsdSkelSkeleton",)
ANIMATION = ("UsdSkelAnimation",)
BODY = ("UsdMotionSkeletonAPI",)
RESULT = ("UsdMotionResultAPI",)
OURS = EDIT + CONSTRAINT + GOAL + DETECTION + NORMALIZED

CHECKS = (
    Check("Skeleton", SKELETON, find_unreadable_skeletons),
    Check("Binding", SKELETON, find_unusable_bindings),
    Check("Animation", ANIMATION, find_unreadable_animations),
    Check("RestPose", ANIMATION, find_resting_animations),
    Check("MisappliedAPI", BODY + RESULT, find_misapplied_apis),
    Check("MissingAPI", SKELETON + ANIMATION, find_missing_apis),
    Check("Values", OURS + BODY + RESULT, find_wrong_values),
    Check("BodyArrays", BODY, find_wrong_body_arrays),
    Check("Parts", BODY, find_unknown_parts),
    Check("Edit", EDIT, find_unsolvable_edits),
    Check("Range", EDIT, find_wrong_ranges),
    Check("Targets", OURS, find_wrong_targets),
    Check("Ground", EDIT, find_wrong_grounds),
    Check("Effector", CONSTRAINT, find_missing_effectors),
    Check("JointTokens", CONSTRAINT + GOAL + DETECTION, find_unknown_joints),
    Check("KeyTimes", CONSTRAINT + GOAL, find_wrong_key_times),
    Check("Normalized", NORMALIZED, find_partial_motions),
    Check("Arrays", CONSTRAINT + NORMALIZED, find_wrong_arrays),
    Check("Trajectory", ("UsdMotionTrajectoryConstraint",), find_wrong_trajectories),
    Check("Distance", ("UsdMotionDistanceConstraint",), find_empty_distances),
    Check("Region", ("UsdMotionRegionConstraint",), find_missing_regions),
    Check("Axis", ("UsdMotionAimConstraint", "UsdMotionContactConstraint"), find_zero_axes),
    Check("Goal", GOAL, find_lost_goals),
    Check("Detection", DETECTION, find_idle_detections),
    Check("Recruiting", EDIT, find_broken_recruiting),
    Check("Balance", EDIT, find_falls),
)
"""Every check of a prim, in the order in which a reader of the list would mend things."""
STAGE_CHECKS = (StageCheck("Composition", find_composition_errors),)
"""Every check of a whole stage; what they find is to be mended first."""


def find(stage: Usd.Stage) -> list[Fault]:
    """List the faults of a stage: of the whole, then prim by prim in the order of the stage."""
    checks: dict[tuple[str, ...], list[Check]] = {}
    faults = [fault for check in STAGE_CHECKS for fault in check.find(stage)]
    for prim in without_guides(Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())):
        # Prims of a kind have the same checks, and a shot has many prims of few kinds.
        kind = (str(prim.GetTypeName()), *prim.GetAppliedSchemas())
        if kind not in checks:
            checks[kind] = [check for check in CHECKS if check.concerns(prim)]
        for check in checks[kind]:
            faults.extend(check.find(prim))
    return faults
