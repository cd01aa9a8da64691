"""Characters that are solved together."""

import pytest

from usdmotion.errors import SceneError


def joint_goal(text, who, joint="hip"):
    return text.goal(
        f'rel usdmotion:space = </{who}/Bones>\nuniform token usdmotion:spaceJoint = "{joint}"'
    )


def test_a_goal_in_the_joint_of_another_makes_it_a_character_of_the_scene(text, save, check):
    ann = text.man("Ann", edit=text.edit(text.hold(joint_goal(text, "Bob"))))
    bob = text.man("Bob", edit="", animation=text.poses((1, 9), seed=4), xform=text.SCALED)
    shot = check(save(ann + bob))
    (scene,) = shot.scenes
    assert [each.path for each in scene.characters] == ["/Ann/Bones", "/Bob/Bones"]
    assert len(scene.edits) == 1


def test_edits_coupled_through_a_joint_share_a_scene_and_their_times(text, save, check):
    ann = text.man("Ann", edit=text.edit(text.hold(joint_goal(text, "Bob"))))
    bob = text.man("Bob", animation=text.poses((2, 3.5, 9), seed=4))
    eve = text.man("Eve")
    shot = check(save(eve + ann + bob), law=False)
    assert [[each.path for each in scene.edits] for scene in shot.scenes] == [
        ["/Eve/Bones/Edit"],
        ["/Ann/Bones/Edit", "/Bob/Bones/Edit"],
    ]
    assert shot.scenes[1].time_codes.tolist() == [1, 2, 3, 3.5, 4, 5, 9]


def test_edits_that_look_at_the_same_bystander_are_still_solved_alone(text, save, read):
    ann, eve = (
        text.man(name, edit=text.edit(text.hold(joint_goal(text, "Bob"))))
        for name in ("Ann", "Eve")
    )
    assert len(read(save(ann + eve + text.man("Bob", edit=""))).scenes) == 2


def test_a_joint_that_its_skeleton_does_not_have_is_refused(text, save, read):
    ann = text.man("Ann", edit=text.edit(text.hold(joint_goal(text, "Bob", "tail"))))
    with pytest.raises(SceneError, match=r"'tail'.*</Bob/Bones> does not have"):
        read(save(ann + text.man("Bob")))
