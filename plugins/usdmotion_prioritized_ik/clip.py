"""The loop over the frames of a clip (2003, figure 6)."""

from usdmotion import Floats, Ints
from usdmotion.kernels import kernel, reference, shared
from usdmotion_prioritized_ik.convergence import SETTLED, Converge, keep, solve_levels
from usdmotion_prioritized_ik.state import Parts, Work


@kernel
def solve_clip(
    parts: Parts,
    converge: Converge,
    translations: Floats,
    rotations: Floats,
    iterations: Ints,
    stops: Ints,
) -> None:
    """Parts of `Work` into (F, N, 3), (F, N, 4), (F,), (F,): the motion, its cost, why it ended."""
    given, table, settings, pose, saved, carried, asked, stack = parts
    work = Work(
        reference(given),
        reference(table),
        reference(settings),
        reference(pose),
        reference(saved),
        reference(carried),
        reference(asked),
        reference(stack),
    )
    for frame in range(rotations.shape[0]):
        iterations[frame], stops[frame] = _solve_frame(work, converge, frame)
        for node in range(rotations.shape[1]):
            for axis in range(3):
                translations[frame, node, axis] = pose.translations[node, axis]
            for axis in range(4):
                rotations[frame, node, axis] = pose.rotations[node, axis]


@shared
def _solve_frame(work: Work, converge: Converge, frame: int) -> tuple[int, int]:
    """Solve what is fully on, then with it what eases in or out, in rank order.

    An easing task leaves the share 1 − a of the error that it has in the frame solved without it
    (DESIGN, section 6: x_free + a (goal − x_free)).
    """
    asked, activity = work.asked[0], work.table[0].activity[frame]
    _begin(work, frame)
    spent, stop = 0, SETTLED
    count = activity.shape[0]
    for task in range(count + 1):
        final = task == count
        if not final and (asked.on[task] or activity[task] == 0.0):
            continue
        more, stop = solve_levels(work, converge, frame, final)
        spent += more
        if not final:
            keep(work, frame, task, 1.0 - activity[task])
            asked.on[task] = True
    return spent, stop


@shared
def _begin(work: Work, frame: int) -> None:
    """Turn on the tasks that are fully active."""
    asked, activity = work.asked[0], work.table[0].activity[frame]
    for task in range(activity.shape[0]):
        asked.on[task] = activity[task] >= 1.0
        for axis in range(3):
            asked.kept[task, axis] = 0.0
