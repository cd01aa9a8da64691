"""Which joints and prims are looked at, and what is said where that is not clear."""

import numpy as np
import pytest

from usdmotion import OptionError, SceneError, pipeline
from usdmotion.asking import Example

BOX = """
def Xform "World" {
    def Xform "Cart" {
        double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 12: (4, 0, 0), 24: (4, 0, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Cube "Box" {
            double size = 2
            double3 xformOp:scale = (1, 2, 3)
            double xformOp:rotateY.timeSamples = { 1: 0, 12: 0, 24: 90 }
            uniform token[] xformOpOrder = ["xformOp:rotateY", "xformOp:scale"]
        }
    }
    def Sphere "Still" {}
}
def Cube "Alone" {
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 24: (0, 0, 0) }
    double xformOp:rotateX.spline = { 1: 0; post curve (1, 0), 24: 90 }
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
def Scope "Nothing" {}
"""


def objects(report):
    return [each.object for each in report.objects]


class TestJoints:
    """By token, by last name, by the name of the part of a body."""

    @pytest.mark.parametrize("name", ["hips/hand", "hand", "l_radiocarpal"])
    def test_a_joint_has_several_names(self, shot, detect, name):
        assert objects(detect(shot(), joints=[name])) == ["hips/hand"]

    def test_one_joint_by_two_names_is_looked_at_once(self, shot, detect):
        assert objects(detect(shot(), joints=["hand", "hips/hand", "foot"])) == [
            "hips/hand",
            "hips/foot",
        ]

    def test_nobody_asks_and_the_feet_are_looked_at(self, shot, detect):
        assert objects(detect(shot())) == ["hips/foot"]

    def test_a_joint_that_is_not_there(self, shot, detect):
        with pytest.raises(
            SceneError, match=r"no joint 'fot' on </Man/Bones>; did you mean 'foot'"
        ):
            detect(shot(), joints=["fot"])

    def test_a_last_name_that_several_joints_have(self, shot, detect):
        twins = shot()
        text = twins.read_text().replace("hips/hand", "hips/foot/foot")
        twins.write_text(text)
        with pytest.raises(SceneError, match="has 2 joints called 'foot'; write one of hips/foot,"):
            detect(twins, joints=["foot"])
        assert objects(detect(twins, joints=["hips/foot/foot"])) == ["hips/foot/foot"]

    def test_a_skeleton_that_cannot_be_read_is_in_nobodys_way(self, shot, detect):
        sheared = """def SkelRoot "Bent" {
            float3 xformOp:scale = (1, 2, 1)
            uniform token[] xformOpOrder = ["xformOp:scale"]
            def Skeleton "Bones" (prepend apiSchemas = ["SkelBindingAPI"]) {
                uniform token[] joints = ["root"]
                rel skel:animationSource = </Man/Walk>
            }
        }"""
        assert objects(detect(shot(more=sheared), joints=["foot"])) == ["hips/foot"]
        with pytest.raises(SceneError, match="</Bent/Bones> is scaled unevenly"):
            detect(shot("b.usda", more=sheared), "b.out.usda", joints=["root"])

    def test_nobody_knows_the_feet(self, shot, detect):
        bare = shot()
        bare.write_text(bare.read_text().replace("l_talocrural", ""))
        with pytest.raises(SceneError, match="which joints of </Man/Bones> are feet; name joints"):
            detect(bare)

    def test_there_is_no_skeleton(self, tmp_path, detect):
        empty = tmp_path / "empty.usda"
        empty.write_text('#usda 1.0\ndef Xform "World" {}\n')
        with pytest.raises(SceneError, match="no Skeleton and no MotionDetection; name animated"):
            detect(empty)
        with pytest.raises(SceneError, match="no Skeleton that could have the joint 'foot'"):
            detect(empty, joints=["foot"])

    def test_what_a_detector_gets_of_a_joint(self, shot, detect, still, steps):
        root = """double3 xformOp:translate = (100, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]"""
        detect(shot(root=root, header='metersPerUnit = 0.01\nupAxis = "Y"'), joints=["foot"])
        (search,) = still.seen
        assert search.name == "foot"
        np.testing.assert_allclose(search.times, np.arange(24) / 24.0)
        world = 0.01 * (steps.places() + np.array([100.0, 0.0, 0.0]))
        np.testing.assert_allclose(search.translations, world, atol=1e-6)
        assert search.ground == pytest.approx(0.0)
        assert search.kinds == ("space",)

    def test_far_from_the_origin_nothing_is_lost(self, shot, detect, still, steps):
        root = """double3 xformOp:translate = (10000, 0, -10000)
        uniform token[] xformOpOrder = ["xformOp:translate"]"""
        detect(shot(root=root), joints=["foot"])
        detect(shot("near.usda"), "near.out.usda", joints=["foot"])
        far, near = (search.translations for search in still.seen)
        np.testing.assert_allclose(far - [10000, 0, -10000], near, rtol=0.0, atol=1e-11)

    def test_the_points_of_a_joint_are_its_own_and_where_its_children_are(
        self, shot, detect, still
    ):
        detect(shot(), joints=["hips"])
        assert still.seen[-1].points.shape == (3, 3)


class TestProps:
    """Anything that has a transform, whatever is above it."""

    @pytest.fixture
    def box(self, shot):
        return shot(more=BOX)

    def test_it_is_looked_at_in_the_world_without_its_scale(self, box, detect, still):
        report = detect(box, prims=["/World/Cart/Box"])
        assert report.objects[0].path == "/World/Detections/Box"
        (search,) = still.seen
        assert search.name == "/World/Cart/Box"
        assert search.translations[-1].tolist() == [4.0, 0.0, 0.0]
        half = np.sqrt(0.5)
        np.testing.assert_allclose(np.abs(search.rotations[-1]), [0, half, 0, half], atol=1e-12)
        assert sorted(map(tuple, np.abs(search.points).tolist())) == [(1.0, 2.0, 3.0)] * 8

    def test_what_usd_shows_between_its_samples_is_looked_at_too(self, box, detect, still):
        detect(box, prims=["/World/Cart/Box"])
        (search,) = still.seen
        np.testing.assert_allclose(search.times, np.arange(24) / 24.0)
        np.testing.assert_allclose(search.translations[:12, 0], np.linspace(0.0, 4.0, 12))

    def test_a_spline_moves_as_well(self, box, detect, still):
        report = detect(box, prims=["/Alone"])
        assert report.objects[0].path == "/Detections/Alone"
        assert len(still.seen[-1].times) == 24

    def test_its_contacts_are_data_that_say_where_it_is(self, box, detect, opened):
        detect(box, prims=["/World/Cart/Box"], options={"slack": "0.001"})
        contact = opened().GetPrimAtPath("/World/Detections/Box/Contact01")
        assert [str(each) for each in contact.GetRelationship("usdmotion:object").GetTargets()] == [
            "/World/Cart/Box"
        ]
        # The point is told in the prim's own, scaled frame.
        np.testing.assert_allclose(contact.GetAttribute("usdmotion:point").Get(), (0, 0, 0.5 / 3))
        assert contact.GetAttribute("usdmotion:joint").Get() == ""

    def test_several_objects_in_one_run(self, box, detect):
        report = detect(box, joints=["foot"], prims=["/World/Cart/Box", "/Alone"])
        assert objects(report) == ["hips/foot", "/World/Cart/Box", "/Alone"]

    def test_what_was_looked_at_is_looked_at_again(self, box, detect, tmp_path):
        detect(box, "first.usda", prims=["/World/Cart/Box"], joints=["hand"])
        report = detect(tmp_path / "first.usda", "second.usda")
        assert sorted(objects(report)) == ["/World/Cart/Box", "hips/hand"]

    @pytest.mark.parametrize(
        ("path", "sentence"),
        [
            ("/World/Bix", "there is no prim </World/Bix>"),
            ("/World//Box", "there is no prim </World//Box>"),
            ("World/Box", "there is no prim <World/Box>"),
            ("/Nothing", "</Nothing> is a Scope, which has no transform"),
            ("/World/Still", "</World/Still> does not move; name a prim that is animated"),
        ],
    )
    def test_what_cannot_be_looked_at(self, box, detect, path, sentence):
        with pytest.raises(SceneError, match=sentence):
            detect(box, prims=[path])


class TestExamples:
    """Templates that are told in words."""

    def test_an_example_is_what_the_detector_learns_from_and_stays_on_the_stage(
        self, shot, detect, still, opened, tmp_path, steps
    ):
        examples = [Example("foot", 12, 15), Example("foot", 2, 5)]
        report = detect(shot(), "first.usda", templates=examples)
        spans = [(each.start * 24, each.end * 24) for each in still.seen[-1].templates]
        np.testing.assert_allclose(spans, [(1, 4), (11, 14)])
        assert [each.state for each in report.objects[0].contacts] == [
            "template",
            "template",
            "detected",
        ]
        # The method corrects the label, and remembers what it was.
        contact = opened("first.usda").GetPrimAtPath(f"{steps.detection}/Contact02")
        assert [float(code) for code in contact.GetAttribute("usdmotion:times").Get()[1:3]] == [
            11.0,
            16.0,
        ]
        again = detect(tmp_path / "first.usda", "second.usda", templates=examples)
        assert len(still.seen[-1].templates) == 2
        assert len(again.objects[0].contacts) == 3

    def test_an_example_where_nothing_is_found_is_a_contact_all_the_same(
        self, shot, detect, opened, tmp_path, steps
    ):
        report = detect(shot(), "first.usda", templates=[Example("foot", 8, 9)])
        told = [(each.state, each.start, each.end) for each in report.objects[0].contacts]
        assert told[1] == ("template", 8.0, 9.0)
        assert (
            "nothing was found where a space contact from 8 to 9 is a template" in report.notes[0]
        )
        contact = opened("first.usda").GetPrimAtPath(f"{steps.detection}/Contact02")
        location = contact.GetAttribute("usdmotion:location").Get()
        # Of the frames 8 and 9 the first is as near to the middle as the other.
        np.testing.assert_allclose(location, steps.places()[7], rtol=1e-6)
        again = detect(tmp_path / "first.usda", "second.usda")
        assert [each.state for each in again.objects[0].contacts].count("template") == 1

    def test_an_example_of_a_line_has_lines_looked_for(self, shot, detect, still):
        detect(shot(), templates=[Example("foot", 2, 5, "line")])
        assert still.seen[-1].kinds == ("space", "line")

    def test_an_example_of_what_is_not_looked_for_is_told_of(self, shot, detect):
        examples = [Example("foot", 2, 5, "line"), Example("foot", 12, 15)]
        notes = detect(shot(), templates=examples, kinds=["space"]).notes
        (note,) = [each for each in notes if "not looked for" in each]
        assert note.startswith("the example of 'foot' from 2 to 5 is of the kind 'line', which")
        asked = detect(shot(), templates=examples, kinds=["space", "line"]).notes
        assert not [each for each in asked if "not looked for" in each]

    def test_an_example_that_teaches_nothing_is_told_of_in_time_codes(self, shot, tmp_path, steps):
        def found(*examples):
            return pipeline.detect(
                shot(), tmp_path / "out.usda", joints=["foot"], templates=examples
            )

        short, long = Example("foot", 12, 12), Example("foot", 11, 16)
        report = found(short)
        (note,) = [each for each in report.notes if "nothing is learnt" in each]
        assert f"<{steps.detection}>: nothing is learnt from the example from 12 to 12" in note
        assert report.objects[0].pattern.given_by == "estimate"
        assert found(short, long).objects[0].pattern.given_by == "templates"

    def test_a_pattern_of_the_stage_is_what_counts_where_an_example_teaches_nothing(
        self, shot, tmp_path, over, steps
    ):
        pipeline.detect(shot(), tmp_path / "first.usda", joints=["foot"])
        body = "double usdmotion:sigmaMax = 0.3\ndouble usdmotion:epsilonMax = 0.2"
        for name in reversed(steps.detection.strip("/").split("/")):
            body = f'over "{name}" {{\n{body}\n}}'
        person = over("first.usda", body)
        short = Example("foot", 12, 12)
        report = pipeline.detect(person, tmp_path / "out.usda", templates=[short])
        assert report.objects[0].pattern.given_by == "prim"
        assert report.objects[0].pattern.sigma == pytest.approx((0.3, 0.3))

    def test_an_example_of_a_prop(self, shot, detect, still):
        detect(shot(more=BOX), templates=[Example("/Alone", 2, 5)])
        assert [search.name for search in still.seen] == ["/Alone"]

    @pytest.mark.parametrize(
        ("example", "sentence"),
        [
            (Example("foot", 20, 30), "foot:20:30 is outside of the motion of hips/foot"),
            (Example("foot", 5, 3), "foot:5:3 ends before it starts"),
            (Example("foot", 2, 5, "flat"), "foot:2:5:flat is of no kind; it may be space, line"),
        ],
    )
    def test_an_example_that_cannot_be(self, shot, detect, example, sentence):
        with pytest.raises(OptionError, match=sentence):
            detect(shot(), templates=[example])
