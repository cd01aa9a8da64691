"""The loop over the frames of a clip (2003, figure 6)."""

from usdmotion.kernels import kernel, reference, shared
from usdmotion_prioritized_ik.continuity import set_course
from usdmotion_prioritized_ik.convergence import SETTLED, Converge, SolveLevels, keep
from usdmotion_prioritized_ik.posture import carry_over, recruit
from usdmotion_prioritized_ik.state import Parts, Work


@kernel
def solve_clip(parts: Parts, solve_levels: SolveLevels, converge: Converge, first: int) -> None:
    """Parts of `Work`, whose motion (F, N, 3), (F, N, 4) becomes the solved one, frame by frame.

    Where the frames before `first` are known, the pose is that of the last of them.
    """
    motion, given, table, settings, pose, saved, carried, asked = parts[:8]
    stack, limits, bounds, holding, descend = parts[8:]
    work = Work(
        reference(motion),
        reference(given),
        reference(table),
        reference(settings),
        reference(pose),
        reference(saved),
        reference(carried),
        reference(asked),
        reference(stack),
        reference(limits),
        reference(bounds),
        reference(holding),
        descend,
    )
    if first > 0:
        _take_up(work, first - 1)
    for frame in range(first, motion.stops.shape[0]):
        motion.stops[frame] = _solve_frame(work, solve_levels, converge, frame)
        for node in range(pose.rotations.shape[0]):
            for axis in range(3):
                motion.translations[frame, node, axis] = pose.translations[node, axis]
            for axis in range(4):
                motion.rotations[frame, node, axis] = pose.rotations[node, axis]
        _hand_on(work, frame)


@shared
def _solve_frame(work: Work, solve_levels: SolveLevels, converge: Converge, frame: int) -> int:
    """Solve what is fully on, then with it what eases in or out, in rank order; say why it ended.

    An easing task leaves the share 1 − a of the error that it has in the frame solved without it
    (DESIGN, section 6: x_free + a (goal − x_free)).
    """
    asked, activity = work.asked[0], work.table[0].activity[frame]
    for task in range(activity.shape[0]):
        asked.on[task] = activity[task] >= 1.0
        for axis in range(3):
            asked.kept[task, axis] = 0.0
    set_course(work, frame)
    stop = SETTLED
    for task in range(activity.shape[0] + 1):
        final = task == activity.shape[0]
        if not final and (asked.on[task] or activity[task] == 0.0):
            continue
        stop = solve_levels(work, converge, frame, final)
        if not final:
            keep(work, frame, task, 1.0 - activity[task])
            asked.on[task] = True
    return stop


@shared
def _take_up(work: Work, frame: int) -> None:
    """Carry over from a frame that is known, as if it had just been solved."""
    carried, known = work.carried[0], work.motion[0].carried
    activity = work.table[0].activity[frame]
    for task in range(activity.shape[0]):
        work.asked[0].on[task] = activity[task] > 0.0
    levels = carried.valid.shape[0]
    recruit(work, levels)
    carry_over(work, frame, levels - 1)
    for level in range(levels - 1):
        for node in range(known.shape[2]):
            for axis in range(3):
                carried.translations[level, node, axis] = known[frame, level, node, axis]
            for axis in range(4):
                turn = known[frame, level, node, axis + 3]
                carried.rotations[level, node, axis] = turn
                carried.valid[level] |= turn != 0.0


@shared
def _hand_on(work: Work, frame: int) -> None:
    """Write down what the frame carries for fewer than all levels: no pose tells that."""
    carried, known = work.carried[0], work.motion[0].carried
    for level in range(carried.valid.shape[0] - 1):
        if carried.valid[level]:
            for node in range(known.shape[2]):
                for axis in range(3):
                    known[frame, level, node, axis] = carried.translations[level, node, axis]
                for axis in range(4):
                    known[frame, level, node, axis + 3] = carried.rotations[level, node, axis]
