"""2006, figures 8 and 9: the residuals of a walk, at the origin of a stage and 10 km away."""

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.projection import project

from usdmotion import pipeline, usd
from usdmotion.asking import Asked
from usdmotion.kernels import conjugate, multiply, rotate

JOINTS = ("l_talocrural", "r_talocrural", "l_radiocarpal")
FAR = np.array((1e4, 0.0, -1e4))
"""Where the other stage has the walk [m]."""


@pytest.fixture(scope="module")
def walks(mocap, tmp_path_factory):
    """Return joints of a walk, read from its stage and from one that references it far away."""
    folder = tmp_path_factory.mktemp("walk")
    near, far = folder / "near.usda", folder / "far.usda"
    recording = pipeline.import_motion(mocap / "cmu/daz/08_01_trimmed.bvh", near)
    stage = Usd.Stage.CreateNew(str(far))
    for name in ("metersPerUnit", "upAxis", "timeCodesPerSecond", "framesPerSecond"):
        stage.SetMetadata(name, Usd.Stage.Open(str(near)).GetMetadata(name))
    offset = stage.DefinePrim("/Set", "Xform")
    UsdGeom.Xformable(offset).AddTranslateOp(precision=UsdGeom.XformOp.PrecisionDouble).Set(
        tuple(FAR / UsdGeom.GetStageMetersPerUnit(stage))
    )
    body = Sdf.Path("/Set").AppendChild(recording.name)
    stage.DefinePrim(body).GetReferences().AddReference(str(near))
    return [
        [each.search for each in usd.read_searches(shot, Asked(joints=JOINTS))]
        for shot in (Usd.Stage.Open(str(near)), stage)
    ]


def test_residuals_are_the_same(walks) -> None:
    for near, far in zip(*walks, strict=True):
        assert np.linalg.norm(far.translations[0] - near.translations[0]) > 1e4
        here, there = (project(displacements(each)) for each in (near, far))
        for name in ("sigma_3", "epsilon_1", "epsilon_3"):
            one, other = getattr(here, name), getattr(there, name)
            assert np.abs(other - one).max() < 1e-6 * one.max()


def test_the_global_formulation_knows_where_it_is(walks) -> None:
    """Appendix A: ε = t' − R' Rᵀ t grows with the distance, so what is measured matters."""

    def residuals(search):
        turn = multiply(search.rotations[1:], conjugate(search.rotations[:-1]))
        moved = search.translations[1:] - rotate(turn, search.translations[:-1])
        return np.linalg.norm(moved, axis=1)

    near, far = (each[0] for each in walks)
    assert residuals(far).max() > 100.0 * residuals(near).max()
