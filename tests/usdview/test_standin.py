"""The stand-in has the interface of usdview, as it was recorded.

From plugin.py, usdviewApi.py, rootDataModel.py and selectionDataModel.py in pxr/usdImaging/usdviewq
of OpenUSD, which were compared from 19.11 to 25: the signature of what is called, "property" for
what is looked at, "settable" for what is written to as well. What `addItem` returns is newer.
"""

import inspect
from importlib import import_module

import pytest

RECORDED = {
    "plugin": {
        "PluginContainer.deferredImport": "(self, moduleName)",
        "PluginContainer.registerPlugins": "(self, plugRegistry, plugCtx)",
        "PluginContainer.configureView": "(self, plugRegistry, plugUIBuilder)",
        "CommandPlugin.__init__": "(self, name, displayName, callback, description, usdviewApi)",
        "CommandPlugin.run": "(self)",
        "PluginMenu.addItem": "(self, commandPlugin, shortcut=None)",
        "PluginMenu.addSeparator": "(self)",
        "PluginMenu.findOrCreateSubmenu": "(self, menuName)",
        "PluginRegistry.getCommandPlugin": "(self, name)",
        "PluginRegistry.registerCommandPlugin": (
            "(self, name, displayName, callback, description='')"
        ),
        "PluginUIBuilder.findOrCreateMenu": "(self, menuName)",
        "loadPlugins": "(usdviewApi, mainWindow)",
    },
    "usdviewApi": {
        "UsdviewApi.UpdateGUI": "(self)",
        "UsdviewApi.PrintStatus": "(self, msg)",
        "UsdviewApi.stage": "property",
        "UsdviewApi.frame": "property",
        "UsdviewApi.prim": "property",
        "UsdviewApi.selectedPrims": "property",
        "UsdviewApi.selectedPaths": "property",
    },
    "rootDataModel": {"RootDataModel.currentFrame": "settable"},
    "selectionDataModel": {
        "SelectionDataModel.setPrim": "(self, prim, instance=-1)",
        "SelectionDataModel.addPrim": "(self, prim, instance=-1)",
        "SelectionDataModel.clearPrims": "(self)",
        "SelectionDataModel.getFocusPrim": "(self)",
        "SelectionDataModel.getPrims": "(self)",
        "SelectionDataModel.getPrimPaths": "(self)",
    },
}


@pytest.mark.parametrize("module", RECORDED)
def test_what_is_called_is_what_usdview_has(usdview, module):
    found = import_module(f"pxr.Usdviewq.{module}")
    assert {name: kind_of(found, name) for name in RECORDED[module]} == RECORDED[module]


def kind_of(module, name):
    held = module
    for part in name.split("."):
        held = inspect.getattr_static(held, part)
    if isinstance(held, property):
        return "property" if held.fset is None else "settable"
    return str(inspect.signature(held))
