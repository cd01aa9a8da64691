"""The surfaces of a stage are a ground, whatever they are made of and wherever they stand."""

import numpy as np
import pytest

from usdmotion.errors import SceneError

CENTIMETRES = 'metersPerUnit = 0.01\nupAxis = "Y"\ntimeCodesPerSecond = 24'
QUAD = """def Mesh "{name}" {{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = {points}
    {more}
}}
"""
FLAT = "[(-200, 30, -200), (-200, 30, 200), (200, 30, 200), (200, 30, -200)]"


def quad(name="Floor", points=FLAT, more=""):
    return QUAD.format(name=name, points=points, more=more)


@pytest.fixture
def ground(text, save, read):
    """Return what reads the ground that an edit names."""

    def run(body, targets="</Floor>", header=CENTIMETRES, **options):
        edit = text.edit(attributes=f"rel usdmotion:ground = {targets}")
        (scene,) = read(save(text.man(edit=edit) + body, header=header), **options).scenes
        return scene.edits[0].ground

    return run


def height(ground, x, z, frame=0, above=0.0):
    point = np.array([x, above, z])
    return ground.under(point[None, None], np.array([frame / 24.0]))[0][0, 0]


def test_a_mesh_is_read_in_metres(ground):
    floor = ground(quad())
    assert height(floor, 0.0, 1.9) == pytest.approx(0.3)
    assert np.isnan(height(floor, 0.0, 2.1))


def test_an_edit_without_a_ground_has_none(text, save, read):
    (scene,) = read(save(text.man())).scenes
    assert scene.edits[0].ground is None


SHAPES = {
    "Plane": ('uniform token axis = "Y"', 20, 0.2),
    "Cube": ("double size = 60", 10, 0.4),
    "Sphere": ("double radius = 30", 10, 0.4),
    "Cylinder": ('uniform token axis = "X"\ndouble height = 100\ndouble radius = 30', 10, 0.4),
    "Capsule": ('uniform token axis = "Y"\ndouble height = 20\ndouble radius = 30', 0, 0.4),
}


@pytest.mark.parametrize("kind", SHAPES)
def test_shapes_are_as_high_as_they_are(ground, kind):
    sizes, rise, top = SHAPES[kind]
    shape = f"""def {kind} "Floor" {{
    {sizes}
    double3 xformOp:translate = (0, {rise}, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
    assert height(ground(shape), 0.0, 0.0) == pytest.approx(top, abs=5e-4)


def test_several_prims_and_what_is_below_one_count_together(ground):
    low, high = quad("Low"), quad("High", FLAT.replace("30", "50"))
    hills = f'def Xform "Hills"\n{{\n{low}\ndef Scope "More"\n{{\n{high}\n}}\n}}\n'
    assert height(ground(hills, "</Hills>"), 0.0, 0.0) == pytest.approx(0.5)
    both = low + high
    assert height(ground(both, "[</Low>, </High>]"), 0.0, 0.0) == pytest.approx(0.5)


def test_instances_stand_where_they_are_put(ground):
    body = f"""
class Xform "Stone" {{ {quad("Top")} }}
def Xform "Here" (instanceable = true
 prepend inherits = </Stone>) {{
    double3 xformOp:translate = (1000, 20, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
    floor = ground(body, "</Here>")
    assert height(floor, 10.0, 0.0) == pytest.approx(0.5)
    assert np.isnan(height(floor, 0.0, 0.0))


def test_what_moves_is_where_it_is_on_each_frame(ground):
    lifted = FLAT.replace("30", "78")
    points = quad(more=f"point3f[] points.timeSamples = {{ 1: {FLAT}, 5: {lifted} }}")
    rising = quad(
        more="double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 5: (0, 48, 0) }\n"
        'uniform token[] xformOpOrder = ["xformOp:translate"]'
    )
    for floor in (ground(points), ground(rising)):
        found = [height(floor, 0.0, 0.0, frame, above=0.5) for frame in range(5)]
        np.testing.assert_allclose(found, [0.3, 0.42, 0.54, 0.66, 0.78], atol=1e-6)


def test_polygons_are_fans_and_holes_are_none(ground):
    hole = quad(more="int[] holeIndices = [0]")
    assert np.isnan(height(ground(hole), 0.0, 0.0))
    five = (
        quad(points="[(0, 0, 0), (0, 0, 200), (100, 0, 200), (200, 0, 100), (200, 0, 0)]")
        .replace("[4]", "[5]")
        .replace("[0, 1, 2, 3]", "[0, 1, 2, 3, 4]")
    )
    floor = ground(five)
    for x, z in ((0.1, 1.9), (1.9, 0.1), (1.3, 1.3)):
        assert height(floor, x, z) == 0.0
    assert np.isnan(height(floor, 1.8, 1.8))


def test_the_axis_that_is_up_is_the_stages(ground):
    upright = "[(-200, -200, 30), (-200, 200, 30), (200, 200, 30), (200, -200, 30)]"
    floor = ground(quad(points=upright), header=CENTIMETRES.replace('"Y"', '"Z"'))
    heights, normals = floor.under(np.array([[[0.5, -0.5, 0.0]]]), np.zeros(1))
    assert heights[0, 0] == pytest.approx(0.3)
    np.testing.assert_allclose(normals[0, 0], (0.0, 0.0, 1.0), atol=1e-12)


def test_the_ground_that_is_asked_for_goes_before_the_one_of_the_edit(ground):
    other = quad("Other", FLAT.replace("30", "10"))
    assert height(ground(quad() + other, ground=["/Other"]), 0.0, 0.0) == pytest.approx(0.1)
    assert ground(quad(), ground=[]) is None


@pytest.mark.parametrize(
    ("body", "targets", "why"),
    [
        ("", "</Nowhere>", "which is not on the stage"),
        ('def Camera "Floor" {}', "</Floor>", "is a Camera; name a Mesh, Plane, Cube"),
        ('def Xform "Floor"\n{\ndef Camera "Eye" {}\n}', "</Floor>", "is a Xform without a surf"),
        (quad(more="int[] primvars:skel:jointIndices = [0]"), "</Floor>", "is the skin of a body"),
        (quad().replace("[4]", "[5]"), "</Floor>", "</Floor> has 4 faceVertexIndices where"),
        (quad().replace("2, 3]", "2, 9]"), "</Floor>", "</Floor> has faces with corners that are"),
        (
            'def Plane "Floor"\n{\nuniform token axis = "X"\n}',
            "</Floor>",
            "</Floor>: a plane is up",
        ),
    ],
)
def test_what_nobody_can_stand_on_is_refused(ground, body, targets, why):
    with pytest.raises(SceneError, match=why):
        ground(body, targets)


@pytest.mark.parametrize("path", ["/Nowhere", "Floor"])
def test_a_ground_that_is_asked_for_and_is_not_there_is_refused(ground, path):
    with pytest.raises(SceneError, match=f"there is no prim <{path}> to stand on"):
        ground(quad(), ground=[path])


@pytest.mark.parametrize(
    "body", ['def Mesh "Floor" {}', 'def Mesh "Floor" {\n    point3f[] points = []\n}']
)
def test_a_mesh_of_nothing_is_nothing_to_stand_on(ground, body):
    assert np.isnan(height(ground(body), 0.0, 0.0))
