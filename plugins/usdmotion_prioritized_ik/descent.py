"""One step down a stack: each level moves only where no level above it is disturbed.

Last moves the posture. Nothing crosses a bound that stands above it.
"""

from collections.abc import Callable

from usdmotion.kernels import Reference, shared
from usdmotion_prioritized_ik.bounds import Bounds
from usdmotion_prioritized_ik.holding import Holding, find_directions, let_go, most_crossed
from usdmotion_prioritized_ik.rows import add, dot, remove
from usdmotion_prioritized_ik.stack import (
    Stack,
    clear,
    orthogonalize,
    remove_spanned,
    solve,
    subtract_done,
    unfold,
)

Descend = Callable[
    [Reference[Stack], Reference[Bounds], Reference[Holding], int, bool, float, float, float], None
]
"""`descend`, handed over."""
MOST_DROPS = 20
"""So often a level lets bounds go; all but the last digits would end this by itself."""


def descend(
    stacked: Reference[Stack],
    bounded: Reference[Bounds],
    holder: Reference[Holding],
    levels: int,
    posture: bool,
    damping: float,
    curvature: float,
    rank: float,
) -> None:
    """Write the step of the first levels.

    Args:
        stacked: Its rows and errors are consumed.
        bounded: What no level may cross.
        holder: Scratch.
        levels: How many levels take part.
        posture: Whether the pull does, in what the levels leave free.
        damping: Smallest damping λ₀ [m].
        curvature: What the squared damping grows by, per metre of error [m].
        rank: Shortest projected row that counts as independent [m].
    """
    stack = stacked[0]
    clear(stack.step)
    for level in range(levels + 1 if posture else levels):
        clear(stack.trial)
        squared_damping = 0.0
        if level < levels:
            error = subtract_done(stacked, bounded, level)
            squared_damping = damping * damping + curvature * error
            start = stack.spans[level]
            stack.spans[level + 1] = orthogonalize(stacked, level, start, rank)
            solve(stacked, level, start, squared_damping)
            unfold(stacked, level, start, stack.trial)
        else:
            remove_spanned(stacked, bounded, levels, stack.pull)
            add(stack.trial, stack.pull, 1.0, stack.pull.shape[0])
        if bounded[0].size[0] > 0:
            _stay_within(stacked, bounded, holder, level, level == levels, squared_damping, rank)
        add(stack.step, stack.trial, 1.0, stack.trial.shape[0])
    if posture:
        for column in range(stack.pull.shape[0]):
            stack.pull[column] = stack.trial[column]


@shared
def _stay_within(
    stacked: Reference[Stack],
    bounded: Reference[Bounds],
    holder: Reference[Holding],
    level: int,
    posture: bool,
    squared_damping: float,
    rank: float,
) -> None:
    """Solve a level again with the bounds held that its trial would cross.

    They are held for all levels below as well. Where the level is out of reach it stands against
    them, so that what is below cannot leave them without disturbing it; where it is within reach,
    the next iteration does not touch them.
    """
    stack, holding = stacked[0], holder[0]
    holding.size[0], drops = 0, 0
    for index in range(bounded[0].size[0]):
        holding.taken[index] = False
    if not _take(stacked, bounded, holder, level):
        return
    if not posture:
        first, start = stack.first_row[level], stack.spans[level]
        for row in range(first, stack.first_row[level + 1]):
            stack.asked[row] = stack.errors[row]
            clear(stack.plain[row])
            for index in range(start, stack.spans[level + 1]):
                factor = stack.factor[index - start, row - first]
                add(stack.plain[row], stack.basis[index], factor, stack.widths[level])
    changed = True
    while changed:
        find_directions(bounded, holder, stack.step)
        if posture:
            _pull_held(stacked, holder)
        else:
            _solve_held(stacked, holder, level, squared_damping, rank)
        if drops < MOST_DROPS and let_go(holder):
            drops += 1
        else:
            changed = _take(stacked, bounded, holder, level)


@shared
def _take(
    stacked: Reference[Stack], bounded: Reference[Bounds], holder: Reference[Holding], level: int
) -> bool:
    """Let the bound hold the level that it would cross most; return whether there is one."""
    stack, bounds, holding = stacked[0], bounded[0], holder[0]
    crossed = most_crossed(bounded, holding.taken, level, stack.step, stack.trial)
    if crossed < 0:
        return False
    place = holding.size[0]
    way, above = holding.ways[place], 0.0
    clear(way)
    for column in range(bounds.first[crossed], bounds.last[crossed]):
        way[column] = bounds.rows[crossed, column]
        above += way[column] * (stack.step[column] + stack.trial[column])
    remove_spanned(stacked, bounded, level, way)
    holding.taken[crossed] = True
    holding.held[place] = crossed
    holding.side[place] = 1.0 if above > bounds.high[crossed] else -1.0
    holding.size[0] = place + 1
    return True


@shared
def _solve_held(
    stacked: Reference[Stack],
    holder: Reference[Holding],
    level: int,
    squared_damping: float,
    rank: float,
) -> None:
    """Write as trial what the level moves where it ends at the bounds that hold it."""
    stack, holding = stacked[0], holder[0]
    first, last, width = stack.first_row[level], stack.first_row[level + 1], stack.widths[level]
    start, held = stack.spans[level], holding.size[0]
    for row in range(first, last):
        stack.errors[row] = stack.asked[row]
        for column in range(width):
            stack.rows[row, column] = stack.plain[row, column]
        for place in range(held):
            along = remove(stack.rows[row], holding.basis[place], width)
            stack.errors[row] -= along * holding.moved[place]
    for place in range(held):
        for column in range(width):
            stack.basis[start + place, column] = holding.basis[place, column]
        holding.push[place] = -squared_damping * holding.moved[place]
    stack.spans[level + 1] = orthogonalize(stacked, level, start + held, rank)
    solve(stacked, level, start + held, squared_damping)
    clear(stack.trial)
    unfold(stacked, level, start + held, stack.trial)
    for row in range(first, last):
        left = stack.errors[row] - dot(stack.plain[row], stack.trial, width)
        for place in range(held):
            holding.push[place] += left * dot(stack.plain[row], holding.basis[place], width)
    for place in range(held):
        add(stack.trial, holding.basis[place], holding.moved[place], width)


@shared
def _pull_held(stacked: Reference[Stack], holder: Reference[Holding]) -> None:
    """Write as trial the step nearest to the pull that ends at the bounds that hold it."""
    stack, holding = stacked[0], holder[0]
    width = stack.pull.shape[0]
    for column in range(width):
        stack.trial[column] = stack.pull[column]
    for place in range(holding.size[0]):
        along = dot(stack.pull, holding.basis[place], width)
        holding.push[place] = along - holding.moved[place]
        add(stack.trial, holding.basis[place], -holding.push[place], width)
