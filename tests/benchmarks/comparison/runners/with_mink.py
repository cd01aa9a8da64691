"""The clip by mink, on MuJoCo."""

from pathlib import Path
from typing import Any

import mink
import mujoco
import numpy as np
from contest import COM, Clip, serve


class PointTask(mink.Task):
    """A site's position alone: three rows where mink's FrameTask has six."""

    def __init__(self, site: int, cost: float, damping: float) -> None:
        super().__init__(cost=np.full(3, cost), lm_damping=damping)
        self.site = site
        self.target = np.zeros(3)

    def set_target(self, target: np.ndarray) -> None:
        self.target = target

    def compute_error(self, configuration: mink.Configuration) -> np.ndarray:
        return configuration.data.site_xpos[self.site] - self.target

    def compute_jacobian(self, configuration: mink.Configuration) -> np.ndarray:
        rows = np.empty((3, configuration.nv))
        mujoco.mj_jacSite(configuration.model, configuration.data, rows, None, self.site)
        return rows


class Mink:
    """Weighted tasks, or the first levels as equality rows, over a posture task."""

    def __init__(self, path: Path, clip: Clip, settings: dict[str, Any]) -> None:
        self.settings = settings
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.configuration = mink.Configuration(self.model)
        # The first joint's quaternion stands behind its position.
        first = np.array([self.model.joint(name).qposadr[0] for name in clip.joints])
        first[0] += 3
        self.quaternions = first[:, None] + np.arange(4)
        self.inputs = np.zeros((len(clip.root), self.model.nq))
        self.inputs[:, :3] = clip.root
        self.inputs[:, self.quaternions] = np.roll(clip.turns, 1, axis=-1)
        self.sites = [self.model.site(name).id for name in clip.names if name != COM]
        ranked = list(zip(clip.names, clip.levels, strict=True))
        self.tasks = [self.task(name, settings["costs"][level]) for name, level in ranked]
        pairs = list(zip(self.tasks, clip.levels, strict=True))
        self.posture = mink.PostureTask(self.model, cost=settings["posture"])
        self.hard = [task for task, level in pairs if level < settings["hard"]]
        self.soft = [task for task, level in pairs if level >= settings["hard"]] + [self.posture]
        self.displacement = np.zeros(self.model.nv)

    def task(self, name: str, cost: float) -> mink.Task:
        damping = self.settings["damping"]
        if name == COM:
            return mink.ComTask(cost=cost, lm_damping=damping)
        return PointTask(self.model.site(name).id, cost, damping)

    def start(self, frame: int) -> float:
        posture = self.inputs[frame]
        if frame:
            before, now = self.inputs[frame - 1], self.configuration.data.qpos
            mujoco.mj_differentiatePos(self.model, self.displacement, 1.0, before, now)
        pose = posture.copy()
        mujoco.mj_integratePos(self.model, pose, self.displacement, 1.0)
        self.configuration.update(pose)
        self.posture.set_target(posture)
        return float(np.abs(self.displacement[3:]).max())

    def aim(self, targets: np.ndarray) -> None:
        for task, target in zip(self.tasks, targets, strict=True):
            task.set_target(target)

    def step(self, turn: float) -> float:
        velocity = mink.solve_ik(
            self.configuration,
            self.soft,
            1.0,
            self.settings["solver"],
            limits=[],
            constraints=self.hard,
        )
        largest = float(np.abs(velocity[3:]).max())
        self.configuration.integrate_inplace(velocity, min(1.0, turn / max(largest, 1e-12)))
        return largest

    def places(self) -> np.ndarray:
        data = self.configuration.data
        return np.concatenate((data.site_xpos[self.sites], data.subtree_com[1:2]))

    def pose(self) -> tuple[np.ndarray, np.ndarray]:
        q = self.configuration.q
        return q[:3], np.roll(q[self.quaternions], -1, axis=-1)


if __name__ == "__main__":
    serve(Mink, "mink", "mujoco")
