"""What can be solved but is probably not meant goes with what was read."""


def test_nothing_is_said_of_a_shot_as_it_should_be(text, save, read):
    assert read(save(text.man(edit=text.edit(text.hold(text.goal()))))).warnings == ()


def test_a_source_that_shows_its_rest_pose_is_said(text, save, read):
    (said,) = read(save(text.man(animation=text.poses(scales=False)))).warnings
    assert said.startswith("</Man/Walk> has no scales, so USD shows the rest pose")


def test_a_property_that_no_schema_has_is_said(text, save, read):
    held = text.hold(attributes="double usdmotion:wieght = 3")
    (said,) = read(save(text.man(edit=text.edit(held)))).warnings
    assert said.startswith("</Man/Bones/Edit/Hold> has usdmotion:wieght")
    assert "usdmotion:weight" in said


def test_only_the_edits_that_are_solved_are_looked_at(text, save, read):
    one = text.man("Ann", animation=text.poses(scales=False))
    path = save(one + text.man("Bob"))
    assert read(path, edits=["/Bob/Bones/Edit"]).warnings == ()
    assert len(read(path).warnings) == 1


def test_a_skeleton_that_starts_from_a_named_source_need_not_be_bound(text, save, read):
    source = text.edit(attributes="rel usdmotion:source = </Man/Walk>")
    assert read(save(text.man(on_skeleton="", edit=source))).warnings == ()


def test_a_resting_skeleton_that_a_goal_follows_is_said_once(text, save, read):
    space = 'rel usdmotion:space = </Bob/Bones>\nuniform token usdmotion:spaceJoint = "hip"'
    follow = text.edit(text.hold(text.goal(space)) + text.hold(text.goal(space), name="More"))
    path = save(text.man("Ann", edit=follow) + text.man("Bob", on_skeleton="", edit=""))
    (said,) = read(path).warnings
    assert said.startswith("</Bob/Bones> has no animation bound, so it rests")


def test_the_recruiting_rule_is_left_to_who_can_mend_it(text, save, read):
    high = text.hold(name="High", attributes='uniform token[] usdmotion:recruits = ["hip/knee"]')
    low = text.hold(name="Low", attributes="uniform int usdmotion:priority = 2")
    assert read(save(text.man(edit=text.edit(high + low)))).warnings == ()
