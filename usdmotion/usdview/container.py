"""What usdview loads: the commands, and their menu."""

from functools import partial
from typing import Any

from pxr import Tf
from pxr.Usdviewq.plugin import PluginContainer

from usdmotion.usdview.menu import DESTINATIONS, DESTINATIONS_TITLE, GROUPS, TITLE
from usdmotion.usdview.running import Desk, run


class UsdMotionPluginContainer(PluginContainer):  # type: ignore[misc]
    """The commands of usdmotion.

    usdview loads plugins before it opens a stage, so nothing here looks at one.
    """

    def registerPlugins(self, plugRegistry: Any, usdviewApi: Any) -> None:
        """Register a command for each item of the menu."""
        self.desk = Desk()
        items = [item for group in (*GROUPS, DESTINATIONS) for item in group]
        self._commands = {
            item: plugRegistry.registerCommandPlugin(
                item.name, item.label, partial(run, item.verb, self.desk), item.description
            )
            for item in items
        }

    def configureView(self, plugRegistry: Any, plugUIBuilder: Any) -> None:
        """Build the menu."""
        menu = plugUIBuilder.findOrCreateMenu(TITLE)
        for group in GROUPS:
            for item in group:
                menu.addItem(self._commands[item])
            menu.addSeparator()
        submenu = menu.findOrCreateSubmenu(DESTINATIONS_TITLE)
        # Older releases return nothing, and then the status bar alone tells which is in force.
        actions = {item.verb: submenu.addItem(self._commands[item]) for item in DESTINATIONS}
        self.desk.marks = {verb: action for verb, action in actions.items() if action is not None}
        self.desk.mark()


Tf.Type.Define(UsdMotionPluginContainer)
