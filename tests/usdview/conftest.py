"""usdview without its window: what loads plugins is a stand-in, Plug and Tf are real."""

import sys
from pathlib import Path

import pxr
import pytest
import usdmotion_schemas
from pxr import Plug, Sdf, Usd

from usdmotion.usdview import windows

STANDIN = Path(__file__).with_name("standin")
STAGES = Path(__file__).parents[2] / "stages"


@pytest.fixture(scope="session")
def usdview():
    """Let `pxr.Usdviewq` be the stand-in, and Plug know our plugin; return the loading module."""
    pxr.__path__.insert(0, str(STANDIN))
    Plug.Registry().RegisterPlugins(str(usdmotion_schemas.usdview_path()))
    from pxr.Usdviewq import plugin

    return plugin


class Seat:
    """Somebody before usdview: a stage is open, the plugins are loaded."""

    def __init__(self, plugin, stage):
        from pxr.Usdviewq.usdviewApi import UsdviewApi

        stage.SetEditTarget(stage.GetSessionLayer())  # as usdview does
        self.stage, self.menus = stage, {}
        self.api = UsdviewApi(stage)
        self.registry = plugin.loadPlugins(self.api, self.menus)
        self.menu = self.menus["usdmotion"]

    def select(self, *paths):
        self.api.dataModel.selection.clearPrims()
        if paths:
            self.api.dataModel.selection.setPrim(self.stage.GetPrimAtPath(paths[0]))
        for path in paths[1:]:
            self.api.dataModel.selection.addPrim(self.stage.GetPrimAtPath(path))

    def pick(self, verb, *paths):
        """Select prims, pick an item of the menu, and return what the status bar says then."""
        self.select(*paths)
        self.registry.getCommandPlugin(f"usdmotion.{verb}").run()
        return self.api.told[-1]


@pytest.fixture
def seat(usdview):
    """Return what opens usdview on one of our stages, or on a layer."""
    seats = []  # prims live as long as their stage

    def sit(shot):
        layer = shot if isinstance(shot, Sdf.Layer) else str(STAGES / f"{shot}.usda")
        seats.append(Seat(usdview, Usd.Stage.Open(layer)))
        return seats[-1]

    return sit


@pytest.fixture
def qt(usdview, monkeypatch):
    """Let there be Qt; its dialogs are answered at once, by `answer` or by Cancel."""
    from pxr.Usdviewq.answering import Somebody, qt_of

    somebody = Somebody()
    monkeypatch.setitem(sys.modules, windows.QT, qt_of(somebody))
    return somebody
