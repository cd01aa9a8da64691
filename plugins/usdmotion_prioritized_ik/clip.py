"""The loop over the frames of a clip (2003, figure 6)."""

from usdmotion import Floats, Ints
from usdmotion.kernels import inlined, kernel
from usdmotion_prioritized_ik.convergence import SETTLED, keep, solve_levels
from usdmotion_prioritized_ik.state import Work


@kernel
def solve_clip(
    work: Work, translations: Floats, rotations: Floats, iterations: Ints, stops: Ints
) -> None:
    """Work into (F, N, 3), (F, N, 4), (F,), (F,): the motion, what it cost, why it ended.

    What is fully on is solved first, then what eases in or out joins in rank order. An easing task
    leaves the share 1 − a of the error that it has in the frame solved without it (DESIGN,
    section 6: x_free + a (goal − x_free)).
    """
    count = work.table.kind.shape[0]
    for frame in range(rotations.shape[0]):
        easing = _begin(work, frame)
        spent, stop = 0, SETTLED
        for task in range(count + 1):
            final = task == count
            if not final and (work.asked.on[task] or work.table.activity[frame, task] == 0.0):
                continue
            if final or easing:
                more, stop = solve_levels(work, frame, final)
                spent += more
            if not final:
                keep(work, frame, task, 1.0 - work.table.activity[frame, task])
                work.asked.on[task] = True
        iterations[frame], stops[frame] = spent, stop
        for node in range(rotations.shape[1]):
            for axis in range(3):
                translations[frame, node, axis] = work.pose.translations[node, axis]
            for axis in range(4):
                rotations[frame, node, axis] = work.pose.rotations[node, axis]


@inlined
def _begin(work: Work, frame: int) -> bool:
    """Turn on the tasks that are fully active; return whether others ease."""
    easing = False
    for task in range(work.table.kind.shape[0]):
        activity = work.table.activity[frame, task]
        work.asked.on[task] = activity >= 1.0
        for axis in range(3):
            work.asked.kept[task, axis] = 0.0
        easing |= 0.0 < activity < 1.0
    return easing
