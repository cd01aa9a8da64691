"""How usdview finds, loads and shows plugins, without Qt; `interface` says where that is from.

Menus are lists. What usdview does to everybody's plugins when one is at fault is done here too.
"""

from pxr import Plug, Tf


class DuplicateCommandPlugin(Exception):
    """Two commands have one name."""


class PluginContainer:
    """What plugins derive from; usdview's own raises too, so that who overrides nothing is seen."""

    def deferredImport(self, moduleName):
        raise NotImplementedError

    def registerPlugins(self, plugRegistry, plugCtx):
        raise NotImplementedError

    def configureView(self, plugRegistry, plugUIBuilder):
        raise NotImplementedError


PluginContainerTfType = Tf.Type.Define(PluginContainer)


class CommandPlugin:
    def __init__(self, name, displayName, callback, description, usdviewApi):
        self.name, self.displayName, self.description = name, displayName, description
        self._callback, self._api = callback, usdviewApi

    def run(self):
        self._callback(self._api)


class Action:
    """What newer releases return for an item of a menu."""

    def __init__(self):
        self.checkable = self.checked = False

    def setCheckable(self, checkable):
        self.checkable = checkable

    def setChecked(self, checked):
        self.checked = checked


class PluginMenu:
    returns_actions = True
    """Whether it is of a newer release."""

    def __init__(self, title):
        self.title, self.items, self.submenus = title, [], {}

    def addItem(self, commandPlugin, shortcut=None):
        action = Action()
        self.items.append((commandPlugin, action))
        return action if self.returns_actions else None

    def findOrCreateSubmenu(self, menuName):
        return self.submenus.setdefault(menuName, PluginMenu(menuName))

    def addSeparator(self):
        self.items.append(None)


class PluginRegistry:
    def __init__(self, usdviewApi):
        self._api, self._commands = usdviewApi, {}

    def registerCommandPlugin(self, name, displayName, callback, description=""):
        if name in self._commands:
            raise DuplicateCommandPlugin(name)
        self._commands[name] = CommandPlugin(name, displayName, callback, description, self._api)
        return self._commands[name]

    def getCommandPlugin(self, name):
        return self._commands.get(name)


class PluginUIBuilder:
    def __init__(self, mainWindow):
        self._menus = mainWindow

    def findOrCreateMenu(self, menuName):
        return self._menus.setdefault(menuName, PluginMenu(menuName))


def loadPlugins(usdviewApi, mainWindow):
    """Load all plugins; one duplicate name leaves usdview without any. `mainWindow` is a dict."""
    containers = []
    for kind in Plug.Registry.GetAllDerivedTypes(PluginContainerTfType):
        Plug.Registry().GetPluginForType(kind).Load()
        containers.append(kind.pythonClass())
    registry = PluginRegistry(usdviewApi)
    try:
        for each in containers:
            each.registerPlugins(registry, usdviewApi)
    except DuplicateCommandPlugin:
        return None
    builder = PluginUIBuilder(mainWindow)
    for each in containers:
        each.configureView(registry, builder)
    return registry
