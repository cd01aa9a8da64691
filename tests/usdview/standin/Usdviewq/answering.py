"""As much of Qt as a plugin uses, with somebody in front of it who answers at once.

The names are those that PySide2 and PySide6 share; what is not here must not be used.
"""

from types import ModuleType, SimpleNamespace


class Somebody:
    """Who is asked."""

    def __init__(self):
        self.runs = True
        """Whether there is an application."""
        self.answer, self.cancels = "", False
        """What is answered, "" for what is offered; or Cancel."""
        self.asked, self.shown, self.cursors, self.field, self.events = [], [], [], [], 0
        """Questions and faults, texts, cursors that are on, the field of the frame, events."""


class QApplication:
    @classmethod
    def instance(cls):
        return cls.somebody if cls.somebody.runs else None

    @classmethod
    def setOverrideCursor(cls, cursor):
        cls.somebody.cursors.append(cursor)

    @classmethod
    def restoreOverrideCursor(cls):
        cls.somebody.cursors.pop()

    @classmethod
    def processEvents(cls, flags):
        cls.somebody.events += flags == "no input"


class QMessageBox:
    @classmethod
    def warning(cls, parent, title, text):
        cls.somebody.asked.append(text)

    Yes, No = "yes", "no"

    @classmethod
    def question(cls, parent, title, text):
        cls.somebody.asked.append(text)
        return "no" if cls.somebody.cancels else "yes"


class QInputDialog:
    UseListViewForComboBoxItems = "list"

    def __init__(self, parent):
        self._text = ""

    def setWindowTitle(self, title):
        pass

    def setLabelText(self, text):
        self.somebody.asked.append(text)

    def setOption(self, option, on=True):
        assert option == "list" and on

    def setComboBoxItems(self, items):
        assert len(items) == len(set(items))
        self._items = items

    def setTextValue(self, text):
        assert text in self._items
        self._text = self.somebody.answer or text

    def exec_(self):
        return not self.somebody.cancels

    def textValue(self):
        assert self._text in self._items
        return self._text


class QFileDialog:
    DontConfirmOverwrite = "into"

    @classmethod
    def getSaveFileName(cls, parent, caption, directory, filter, options):
        cls.somebody.asked.append(caption)
        return cls.somebody.answer, filter


class QDialog:
    def __init__(self, parent):
        pass

    def setWindowTitle(self, title):
        pass

    def setAttribute(self, attribute):
        assert attribute == "delete on close"

    def resize(self, width, height):
        pass

    def show(self):
        pass


class QPlainTextEdit:
    NoWrap = "no wrap"

    def __init__(self, text):
        self.somebody.shown.append(text)

    def setReadOnly(self, on):
        assert on

    def setLineWrapMode(self, mode):
        assert mode == self.NoWrap

    def setFont(self, font):
        assert font == "fixed"


class QVBoxLayout:
    def __init__(self, parent):
        pass

    def addWidget(self, widget):
        pass


class QLineEdit:
    def setText(self, text):
        self.somebody.field.append(text)

    @property
    def editingFinished(self):
        return SimpleNamespace(emit=lambda: self.somebody.field.append("editingFinished"))


WIDGETS = (QApplication, QMessageBox, QInputDialog, QFileDialog, QDialog)
WIDGETS += (QPlainTextEdit, QVBoxLayout, QLineEdit)


def qt_of(somebody):
    """Return what `pxr.Usdviewq.qt` has, with somebody in front of it."""
    qt = ModuleType("pxr.Usdviewq.qt")
    widgets = {
        each.__name__: type(each.__name__, (each,), {"somebody": somebody}) for each in WIDGETS
    }
    qt.QtWidgets = SimpleNamespace(**widgets)
    qt.QtCore = SimpleNamespace(
        Qt=SimpleNamespace(WaitCursor="wait", WA_DeleteOnClose="delete on close"),
        QEventLoop=SimpleNamespace(ExcludeUserInputEvents="no input"),
    )
    fonts = SimpleNamespace(FixedFont="fixed", systemFont=lambda kind: kind)
    qt.QtGui = SimpleNamespace(QFontDatabase=fonts)
    return qt


class MainWindow:
    """The window of usdview, of which a plugin knows the field with the frame's number."""

    def findChild(self, kind, name):
        return kind() if name == "frameField" else None
