"""What people see and are asked: through Qt where it is there, in the status bar where not."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from pxr import Usd

from usdmotion.errors import SceneError

QT = "pxr.Usdviewq.qt"
"""Where usdview itself takes Qt from, whichever it was built with."""
TITLE = "usdmotion"


class Cancelled(Exception):
    """Somebody was asked and would rather not."""


class Window:
    """The window of usdview, as far as a command may use it."""

    def __init__(self, api: Any) -> None:
        """Take over the window.

        Args:
            api: What usdview offers its plugins.
        """
        self._api = api

    def refuse(self, sentence: str) -> None:
        """Show what is at fault."""
        qt = _qt()
        if qt is not None:
            qt.QtWidgets.QMessageBox.warning(self._api.qMainWindow, TITLE, sentence)

    def show(self, title: str, text: str) -> None:
        """Show a text with columns, which stays open beside the stage; print it without Qt."""
        qt = _qt()
        if qt is None:
            print(text)
            return
        dialog = qt.QtWidgets.QDialog(self._api.qMainWindow)
        dialog.setWindowTitle(f"{TITLE}: {title}")
        dialog.setAttribute(qt.QtCore.Qt.WA_DeleteOnClose)
        shown = qt.QtWidgets.QPlainTextEdit(text)
        shown.setReadOnly(True)
        shown.setLineWrapMode(qt.QtWidgets.QPlainTextEdit.NoWrap)
        shown.setFont(qt.QtGui.QFontDatabase.systemFont(qt.QtGui.QFontDatabase.FixedFont))
        layout = qt.QtWidgets.QVBoxLayout(dialog)
        layout.addWidget(shown)
        dialog.resize(1000, 600)
        dialog.show()

    def choose(self, question: str, names: Sequence[str], current: int, otherwise: str) -> int:
        """Ask for one of several names.

        Args:
            question: What is asked.
            names: What to choose from; no two are equal.
            current: Index of the one that is offered first.
            otherwise: What would do where nobody can be asked.

        Returns:
            Its index.

        Raises:
            Cancelled: None of them.
            SceneError: There is no Qt to ask with.
        """
        qt = _qt()
        if qt is None:
            raise SceneError(otherwise)
        kind = qt.QtWidgets.QInputDialog
        dialog = kind(self._api.qMainWindow)
        dialog.setWindowTitle(TITLE)
        dialog.setLabelText(question)
        dialog.setOption(kind.UseListViewForComboBoxItems)
        dialog.setComboBoxItems(list(names))
        dialog.setTextValue(names[current])
        ask = getattr(dialog, "exec", None) or dialog.exec_  # PySide2 has only the latter
        if not ask():
            raise Cancelled
        return list(names).index(dialog.textValue())

    def confirm(self, question: str) -> bool:
        """Ask for Yes or No; without Qt it is No."""
        qt = _qt()
        if qt is None:
            return False
        box = qt.QtWidgets.QMessageBox
        return bool(box.question(self._api.qMainWindow, TITLE, question) == box.Yes)

    def choose_file(self, question: str, folder: str, endings: Sequence[str]) -> str:
        """Ask for a file to write, which may be there already.

        Args:
            question: What is asked.
            folder: Where to look first.
            endings: What its name may end in.

        Returns:
            Its path.

        Raises:
            Cancelled: None.
            SceneError: There is no Qt to ask with.
        """
        qt = _qt()
        if qt is None:
            raise SceneError(
                "there is no Qt to ask for a file with; make a layer the edit target, and let "
                "results go there"
            )
        dialog = qt.QtWidgets.QFileDialog
        filters = f"USD ({' '.join(f'*{ending}' for ending in endings)})"
        path, _ = dialog.getSaveFileName(
            self._api.qMainWindow,
            question,
            folder,
            filters,
            options=dialog.DontConfirmOverwrite,  # what is in the file stays
        )
        if not path:
            raise Cancelled
        return str(path)

    def go_to(self, time_code: float) -> None:
        """Show another frame.

        A plugin can only set the frame of usdview's data model, and then neither the slider nor the
        field with its number follow. They do where somebody writes into the field.
        """
        qt = _qt(only_if_loaded=True)
        field = None
        if qt is not None:
            field = self._api.qMainWindow.findChild(qt.QtWidgets.QLineEdit, "frameField")
        if field is not None:
            field.setText(f"{time_code:.12g}")
            field.editingFinished.emit()
        # The field knows whole steps only.
        self._api.dataModel.currentFrame = Usd.TimeCode(time_code)

    @contextmanager
    def busy(self) -> Iterator[Callable[[str], None]]:
        """Yield what to tell about the long work inside; people see that it is going on."""
        qt = _qt(only_if_loaded=True)

        def say(doing: str) -> None:
            self._api.PrintStatus(f"{doing} …")
            if qt is not None:
                # A click would begin something else in the middle of this.
                qt.QtWidgets.QApplication.processEvents(qt.QtCore.QEventLoop.ExcludeUserInputEvents)

        if qt is not None:
            qt.QtWidgets.QApplication.setOverrideCursor(qt.QtCore.Qt.WaitCursor)
        try:
            yield say
        finally:
            if qt is not None:
                qt.QtWidgets.QApplication.restoreOverrideCursor()


def _qt(*, only_if_loaded: bool = False) -> Any:
    """Return usdview's module of Qt; None where there is none, or no application of it."""
    try:
        found = sys.modules.get(QT) if only_if_loaded else import_module(QT)
    except ImportError:
        return None
    return found if found is not None and found.QtWidgets.QApplication.instance() else None
