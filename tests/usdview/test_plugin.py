"""usdview finds the plugin, loads it, and has a menu; loading costs nothing and needs no Qt."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import usdmotion_schemas

from usdmotion.usdview.menu import DESTINATIONS, DESTINATIONS_TITLE, GROUPS

STANDIN = Path(__file__).with_name("standin")

# What usdview does when it starts, with a plugin of somebody else beside ours.
STARTING = """
import json, sys, pxr
pxr.__path__.insert(0, sys.argv[1])
from pxr import Plug
from pxr.Usdviewq import plugin
from pxr.Usdviewq.usdviewApi import UsdviewApi
plugin.PluginMenu.returns_actions = json.loads(sys.argv[2])
known = set(sys.modules)
types = Plug.Registry.GetAllDerivedTypes(plugin.PluginContainerTfType)
menus = {}
registry = plugin.loadPlugins(UsdviewApi(None), menus)
def shown(menu):
    return {
        "items": [
            item and [item[0].name, item[0].displayName, item[1].checked] for item in menu.items
        ],
        "submenus": {title: shown(each) for title, each in menu.submenus.items()},
    }
print(json.dumps({
    "types": [each.typeName for each in types],
    "menus": {title: shown(menu) for title, menu in menus.items()},
    "documented": all(item[0].description for item in menus["usdmotion"].items if item),
    "loaded": sorted(set(sys.modules) - known),
}))
"""

ANOTHERS = {
    "plugInfo.json": json.dumps(
        {
            "Plugins": [
                {
                    "Type": "python",
                    "Name": "studio_menu",
                    "Info": {
                        "Types": {
                            "studio_menu.StudioContainer": {
                                "bases": ["pxr.Usdviewq.plugin.PluginContainer"]
                            }
                        }
                    },
                }
            ]
        }
    ),
    "studio_menu.py": """
from pxr import Tf
from pxr.Usdviewq.plugin import PluginContainer
class StudioContainer(PluginContainer):
    def registerPlugins(self, registry, api):
        names = ("inspect", "solve", "StudioContainer.solve")
        self.commands = [registry.registerCommandPlugin(name, name, print) for name in names]
    def configureView(self, registry, builder):
        for command in self.commands:
            builder.findOrCreateMenu("Studio").addItem(command)
Tf.Type.Define(StudioContainer)
""",
}


@pytest.fixture(scope="module")
def started(tmp_path_factory):
    """Return what usdview has after it started, a newer and an older one, side by side."""
    folder = tmp_path_factory.mktemp("studio")
    for name, text in ANOTHERS.items():
        (folder / name).write_text(text)
    environment = os.environ | dict(
        line.split("=", 1) for line in usdmotion_schemas.environment([folder])
    )
    environment["PYTHONPATH"] = os.pathsep.join([str(folder), *filter(None, sys.path)])
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", STARTING, str(STANDIN), newer],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for newer in ("true", "false")
    ]
    told = [process.communicate() for process in processes]
    assert all(process.returncode == 0 for process in processes), told
    assert not any(errors for _, errors in told), told
    return [json.loads(out) for out, _ in told]


def test_it_is_found_by_what_schema_env_prints(started):
    ours = "usdmotion.usdview.container.UsdMotionPluginContainer"
    assert all(ours in each["types"] for each in started)


def test_its_menu_has_every_command_in_its_order(started):
    for each in started:
        menu = each["menus"]["usdmotion"]
        expected = []
        for group in GROUPS:
            expected += [[item.name, item.label, False] for item in group] + [None]
        assert menu["items"] == expected
        assert each["documented"]


def test_results_go_to_the_session_layer_at_first_where_a_menu_can_tell(started):
    for each, newer in zip(started, (True, False), strict=True):
        submenu = each["menus"]["usdmotion"]["submenus"][DESTINATIONS_TITLE]
        assert submenu["items"] == [
            [item.name, item.label, newer and item is DESTINATIONS[0]] for item in DESTINATIONS
        ]


def test_the_plugins_of_others_stay_whatever_their_commands_are_called(started):
    for each in started:
        names = [name for name, *_ in each["menus"]["Studio"]["items"]]
        assert names == ["inspect", "solve", "StudioContainer.solve"]


def test_loading_does_nothing_but_define(started):
    for each in started:
        ours = {name for name in each["loaded"] if name.startswith("usdmotion")}
        assert ours == {
            "usdmotion",
            "usdmotion.errors",
            "usdmotion.usdview",
            *(f"usdmotion.usdview.{name}" for name in ("container", "menu", "running", "windows")),
        }
        heavy = {"numpy", "numba", "scipy", "typer", "PySide6", "PySide2", "pxr.Usdviewq.qt"}
        assert not heavy & set(each["loaded"])


def test_a_usd_without_usdview_takes_no_notice(started):
    lines = dict(line.split("=", 1) for line in usdmotion_schemas.environment())
    code = "from pxr import Usd; Usd.Stage.CreateInMemory().DefinePrim('/Edit', 'MotionEdit')"
    importable = {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | lines | importable,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
