"""The loop over the frames of a clip (2003, figure 6)."""

from usdmotion.kernels import kernel, reference, shared
from usdmotion_prioritized_ik.convergence import SETTLED, Converge, SolveLevels, keep
from usdmotion_prioritized_ik.state import Parts, Work


@kernel
def solve_clip(parts: Parts, solve_levels: SolveLevels, converge: Converge) -> None:
    """Parts of `Work`, whose motion (F, N, 3), (F, N, 4) becomes the solved one, frame by frame."""
    motion, given, table, settings, pose, saved, carried, asked, stack = parts
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
    )
    for frame in range(motion.stops.shape[0]):
        motion.stops[frame] = _solve_frame(work, solve_levels, converge, frame)
        for node in range(pose.rotations.shape[0]):
            for axis in range(3):
                motion.translations[frame, node, axis] = pose.translations[node, axis]
            for axis in range(4):
                motion.rotations[frame, node, axis] = pose.rotations[node, axis]


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
