"""What planting feet tells to look at: contacts that are not held, and those that do not stand."""

import pytest
from pxr import Gf, Usd

from usdmotion import demos, pipeline

EDIT = "/Walker/Skeleton/Contacts"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a walk whose feet skate, and the same walk cleaned."""
    folder = tmp_path_factory.mktemp("cautions")
    demos.build("skating", folder)
    return folder


@pytest.fixture(scope="module")
def cleaned(folder):
    """Return what is told of that walk."""
    return pipeline.clean(folder / "skating.usda", folder / "clean.usda")


def test_where_feet_stand_there_is_nothing_to_look_at(cleaned):
    assert not any("contacts hold" in note or "not held" in note for note in cleaned.notes)


def test_contacts_that_are_out_of_reach_are_named_with_what_is_left(folder, cleaned, tmp_path):
    stage = Usd.Stage.Open(str(folder / "clean.usda"))
    person = tmp_path / "person.usda"
    stage.SetEditTarget(stage.GetSessionLayer())
    contact = stage.GetPrimAtPath(f"{EDIT}/RightToeBase/Contact01")
    location = contact.GetAttribute("usdmotion:location")
    location.Set(location.Get() + Gf.Vec3d(0, 500, 0))
    layer = stage.GetSessionLayer()
    layer.subLayerPaths.append(str(folder / "clean.usda"))
    layer.Export(str(person))
    told = pipeline.clean(person, tmp_path / "clean.usda")
    missed = [each for each in told.edits[0].constraints if "Contact0" in each.path]
    missed = [each for each in missed if not each.met]
    worst = max(missed, key=lambda each: each.max)
    assert str(contact.GetPath()) in {each.path for each in missed} and worst.max > 1.0
    (note,) = [each for each in told.notes if "not held" in each]
    assert note.startswith(f"{EDIT}: {len(missed)} of 12 ") and "RightToeBase/Contact01" in note
    assert f"the worst by {worst.max * 1e3:.0f} mm at {worst.worst_time:g}" in note


def test_contacts_that_hold_what_moves_are_named(folder, tmp_path):
    """The rule of height and speed holds ankles while they roll over the ball."""
    told = pipeline.clean(
        folder / "skating.usda", tmp_path / "clean.usda", detector="height_and_speed"
    )
    worst = max(told.feet, key=lambda each: each.worst_before)
    assert worst.worst_before > 0.05
    (note,) = [each for each in told.notes if "contacts hold" in each]
    assert f"up to {worst.worst_before * 1e3:.1f} mm" in note
    assert f": {worst.joint.rsplit('/', 1)[-1]}/Contact" in note
