"""Regions authored from Python are read back as they were."""

import dataclasses

import numpy as np
import pytest
from pxr import Usd

from usdmotion import usd
from usdmotion.constraints import Region, RegionConstraint
from usdmotion.errors import SceneError
from usdmotion.kernels import Shape

EDIT = "/Man/Bones/Edit"
CODES = np.arange(1.0, 6.0)
REGIONS = {
    "Sphere": Region(margin=0.2),
    "Capsule": Region(margin=0.2, extent=np.array((0.0, 0.0, 0.3))),
    "Cube": Region(extent=np.array((0.1, 0.2, 0.3))),
    "Cylinder": Region(shape=Shape.CYLINDER, extent=np.array((0.1, 0.1, 0.3))),
    "Plane": Region(shape=Shape.HALF_SPACE),
}


@pytest.mark.parametrize("kind", REGIONS)
@pytest.mark.parametrize("parent", ["/World", "/Man"])
def test_a_region_is_read_as_it_was_authored_wherever_it_hangs(text, save, read, kind, parent):
    path = save(
        text.man(edit="", xform=text.MOVING) + 'def Xform "World" {}', header=text.CENTIMETRES
    )
    stage = Usd.Stage.Open(str(path))
    region = dataclasses.replace(
        REGIONS[kind],
        path=f"{parent}/Rock",
        translation=np.linspace((0.0, 1.0, 2.0), (1.0, 1.0, 0.0), 5),
        rotation=np.array((0.6, 0.0, 0.0, 0.8)),
    )
    usd.author_region(stage, region, time_codes=CODES)
    usd.author_edit(stage, EDIT)
    constraint = RegionConstraint(path="", skeleton="/Man/Bones", joint="hip", region=region)
    usd.author(stage, f"{EDIT}/It", constraint)
    assert stage.GetPrimAtPath(f"{parent}/Rock").GetTypeName() == kind
    stage.Save()
    del stage
    back = read(path).scenes[0].constraints[0].region
    assert back.shape == region.shape
    for name in ("extent", "margin", "translation", "rotation"):
        found, wanted = getattr(back, name), getattr(region, name)
        np.testing.assert_allclose(found, np.broadcast_to(wanted, np.shape(found)), atol=1e-7)


def test_a_region_that_is_no_shape_of_usd_cannot_be_authored(text, save):
    stage = Usd.Stage.Open(str(save(text.man())))
    for region, why in (
        (Region(path="/It", extent=np.ones(3), margin=1.0), "is like no shape of USD"),
        (Region(path="/It", extent=np.ones((5, 3))), "changes its size over time"),
    ):
        with pytest.raises(SceneError, match=why):
            usd.author_region(stage, region)
