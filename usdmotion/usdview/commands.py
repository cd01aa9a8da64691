"""The commands: each does one thing on the stage that is open, and says in a sentence what it did.

What they do is `usdmotion.onstage`; here it is found out what is meant, and where results go.
"""

import tempfile
import webbrowser
from dataclasses import replace
from pathlib import Path

from usdmotion import onstage
from usdmotion.asking import Asked
from usdmotion.errors import SceneError
from usdmotion.report.wording import amount
from usdmotion.terminal import rendered, table, tables
from usdmotion.usd.drafts import called
from usdmotion.usd.layers import SUFFIXES
from usdmotion.usd.relations import joints_of
from usdmotion.usdview import destinations, telling
from usdmotion.usdview.here import Here
from usdmotion.usdview.joints import labels, nearest_joint
from usdmotion.usdview.telling import leaf


def inspect(here: Here) -> str:
    """Show what is on the stage, and every fault found."""
    with here.window.busy():
        found = onstage.inspect(here.selection.stage)
    told = telling.of_inspection(found)
    faults = [table("faults", found.faults)] if found.faults else []
    rest = tables(replace(found, faults=()))
    here.window.show("what is on the stage", rendered(told, *faults, *rest))
    return told


def report(here: Here) -> str:
    """Open the report of the edits that are on the stage."""
    stage = here.selection.stage
    name = Path(stage.GetRootLayer().GetDisplayName()).stem or "stage"
    output = Path(tempfile.mkdtemp(prefix="usdmotion-")) / f"{name}.html"
    with here.window.busy() as say:
        onstage.report(stage, output, say=say)
    opened = webbrowser.open(output.as_uri())
    return f"the report is {output}" + ("" if opened else "; there is no browser to open it")


def detect(here: Here) -> str:
    """Find the contacts of the selected skeletons; of the selected props where none is selected."""
    selection = here.selection
    if selection.characters or (selection.anybody and not selection.props):
        asked = Asked(skeletons=selection.skeletons)
    else:
        asked = Asked(prims=selection.props)
    with here.writing() as (say, place):
        found = onstage.detect(selection.stage, asked, say=say)
    here.show_guides()
    return telling.of_detection(found, place)


def make_template(here: Here) -> str:
    """Make the selected contacts templates."""
    contacts = here.selection.contacts
    with here.writing() as (_, place):
        onstage.make_template(here.selection.stage, contacts)
    names = telling.listed(telling.told_apart(contacts))
    return f"the next detection learns from {names}; in {place}"


def add_position_constraint(here: Here) -> str:
    """Hold a joint of the selected skeleton, or that which is nearest to the prim beside it."""
    selection = here.selection
    stage, time = selection.stage, selection.time_code
    skeleton, prop = selection.skeleton, selection.prop
    if prop:
        prims = stage.GetPrimAtPath(skeleton), stage.GetPrimAtPath(prop)
        joint = nearest_joint(*prims, time)
    else:
        joint = _asked_joint(here, skeleton)
    with here.writing() as (_, place):
        path = onstage.add_position_constraint(
            stage, selection.within or skeleton, joint, time_code=time, space=prop
        )
    here.select(path)
    how = f"it follows {leaf(prop)}" if prop else "move its goal"
    return f"{leaf(path)} holds {leaf(joint)} around {time:g}: {how}, and solve; in {place}"


def solve(here: Here) -> str:
    """Solve the selected edits."""
    edits = here.selection.edits
    with here.writing() as (say, place):
        solved = onstage.solve(here.selection.stage, edits, say=say)
    return telling.of_report(solved, place)


def show(here: Here) -> str:
    """Show the result of the selected edits, or their sources where that is what is shown."""
    stage, edits = here.selection.stage, here.selection.edits
    on = not all(onstage.shown(stage, edit) for edit in edits)
    with here.writing() as (_, place):
        onstage.show(stage, edits, on)
    names = telling.listed(telling.told_apart(edits))
    return f"{'the result' if on else 'the source'} of {names} is shown; in {place}"


def jump(here: Here) -> str:
    """Go to the time at which the selected constraint is missed by most."""
    path = here.selection.constraint
    with here.window.busy():
        worst = onstage.worst(here.selection.stage, path)
    here.window.go_to(worst.time_code)
    verdict = "met" if worst.met else "missed"
    return f"{leaf(path)}: {amount(worst.error, worst.unit)} at {worst.time_code:g}, {verdict}"


def guides(here: Here) -> str:
    """Draw what was detected, asked, met and missed."""
    with here.writing() as (say, place):
        drawn = onstage.guides(here.selection.stage, say=say)
    here.show_guides()
    return telling.of_guides(drawn, place)


def to_session(here: Here) -> str:
    """Let results go to the session layer."""
    here.desk.destination = destinations.TO_SESSION
    return "results go to the session layer"


def to_target(here: Here) -> str:
    """Let results go to the edit target that is set."""
    here.desk.destination = destinations.TO_TARGET
    stage = here.selection.stage
    target = called(stage.GetEditTarget().GetLayer(), stage)
    return f"results go to the edit target, which is {target} now"


def to_layer(here: Here) -> str:
    """Let results go to a file, and those that are there as well.

    It is put over the stage, unless it is one of the stage's own layers.
    """
    stage = here.selection.stage
    beside = Path(here.desk.layer or stage.GetRootLayer().realPath or "shot.usda").parent
    path = here.window.choose_file("Results go to", str(beside), SUFFIXES)
    path = path if Path(path).suffix else f"{path}.usda"
    layer = destinations.choose(stage, here.desk, path)
    along = bool(stage.GetSessionLayer().rootPrims) and here.window.confirm(
        "The session layer may hide what goes to the file. Move all that it says of prims there?"
    )
    if along:
        destinations.take_along(stage, layer)
    more = ", with what the session layer had" if along else ""
    within = layer in stage.GetLayerStack(includeSessionLayers=False)
    where = "a layer of the stage itself" if within else "over the stage"
    return f"results go to {layer.realPath}, which is {where}{more}"


def _asked_joint(here: Here, skeleton: str) -> str:
    """Return the joint that somebody chooses, beginning with that of the selected constraint."""
    tokens = joints_of(here.selection.stage.GetPrimAtPath(skeleton))
    if not tokens:
        raise SceneError(f"<{skeleton}> has no joints")
    held = here.selection.joint
    chosen = here.window.choose(
        f"Which joint of {skeleton} is to be held where it is?",
        labels(tokens),
        tokens.index(held) if held in tokens else 0,
        "select a prim beside the Skeleton; the joint that is nearest to it is held there",
    )
    return tokens[chosen]
