"""What is selected in usdview: paths, and the pseudo-root where nothing is."""

from pxr import Sdf

ALL_INSTANCES = -1


class SelectionDataModel:
    def __init__(self, rootDataModel):
        self._model, self._paths = rootDataModel, [Sdf.Path.absoluteRootPath]

    def setPrim(self, prim, instance=ALL_INSTANCES):
        self._paths = [prim.GetPath()]

    def addPrim(self, prim, instance=ALL_INSTANCES):
        self._paths.append(prim.GetPath())

    def clearPrims(self):
        self._paths = [Sdf.Path.absoluteRootPath]

    def getFocusPrim(self):
        return self._model.stage.GetPrimAtPath(self._paths[0])

    def getPrims(self):
        return [self._model.stage.GetPrimAtPath(path) for path in self._paths]

    def getPrimPaths(self):
        return list(self._paths)
