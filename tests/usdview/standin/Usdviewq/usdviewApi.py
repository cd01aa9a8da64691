"""What usdview offers its plugins, as far as ours use it; `told` is what the status bar showed."""

from pxr.Usdviewq.answering import MainWindow
from pxr.Usdviewq.rootDataModel import RootDataModel


class UsdviewApi:
    def __init__(self, stage):
        self.dataModel, self.qMainWindow = RootDataModel(stage), MainWindow()
        self.told, self.updates = [], 0

    @property
    def stage(self):
        return self.dataModel.stage

    @property
    def frame(self):
        return self.dataModel.currentFrame

    @property
    def prim(self):
        return self.dataModel.selection.getFocusPrim()

    @property
    def selectedPrims(self):
        return self.dataModel.selection.getPrims()

    @property
    def selectedPaths(self):
        return self.dataModel.selection.getPrimPaths()

    def UpdateGUI(self):
        self.updates += 1

    def PrintStatus(self, msg):
        assert isinstance(msg, str) and "\n" not in msg, msg
        self.told.append(msg)
