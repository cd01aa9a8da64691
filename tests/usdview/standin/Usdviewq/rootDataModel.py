"""The state of usdview: a stage, what is selected, how it is viewed, and the frame."""

from pxr import Usd
from pxr.Usdviewq.selectionDataModel import SelectionDataModel


class ViewSettingsDataModel:
    displayGuide = False


class RootDataModel:
    def __init__(self, stage):
        self.stage, self.selection = stage, SelectionDataModel(self)
        self.viewSettings = ViewSettingsDataModel()
        self._frame = Usd.TimeCode.Default()

    @property
    def currentFrame(self):
        return self._frame

    @currentFrame.setter
    def currentFrame(self, value):
        if not isinstance(value, Usd.TimeCode):
            raise ValueError(value)
        self._frame = value
