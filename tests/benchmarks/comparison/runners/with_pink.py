"""The clip by pink, on Pinocchio."""

from pathlib import Path
from typing import Any

import numpy as np
import pink
import pinocchio as pin
from contest import COM, Clip, serve


class PointTask(pink.tasks.Task):
    """A frame's position alone: three rows where pink's FrameTask has six."""

    def __init__(self, frame: int, cost: float, damping: float) -> None:
        super().__init__(cost=cost, lm_damping=damping)
        self.frame = frame
        self.target = np.zeros(3)

    def set_target(self, target: np.ndarray) -> None:
        self.target = target

    def compute_error(self, configuration: pink.Configuration) -> np.ndarray:
        return configuration.data.oMf[self.frame].translation - self.target

    def compute_jacobian(self, configuration: pink.Configuration) -> np.ndarray:
        model, data = configuration.model, configuration.data
        return pin.getFrameJacobian(model, data, self.frame, pin.LOCAL_WORLD_ALIGNED)[:3]

    def __repr__(self) -> str:
        return f"PointTask({self.frame})"


class Pink:
    """Weighted tasks, or the first levels as equality rows, over a posture task."""

    def __init__(self, path: Path, clip: Clip, settings: dict[str, Any]) -> None:
        self.settings = settings
        self.model = pin.buildModelFromMJCF(str(path))
        # The first joint's quaternion stands behind its position.
        self.joints = [self.model.getJointId(name) for name in clip.joints]
        first = np.array([self.model.joints[joint].idx_q for joint in self.joints])
        first[0] += 3
        self.quaternions = first[:, None] + np.arange(4)
        self.inputs = np.zeros((len(clip.root), self.model.nq))
        self.inputs[:, :3] = clip.root
        self.inputs[:, self.quaternions] = clip.turns
        self.configuration = pink.Configuration(self.model, self.model.createData(), self.inputs[0])
        self.frames = [self.model.getFrameId(name) for name in clip.names if name != COM]
        ranked = list(zip(clip.names, clip.levels, strict=True))
        self.tasks = [self.task(name, settings["costs"][level]) for name, level in ranked]
        pairs = list(zip(self.tasks, clip.levels, strict=True))
        self.posture = pink.PostureTask(cost=settings["posture"])
        self.hard = [task for task, level in pairs if level < settings["hard"]]
        self.soft = [task for task, level in pairs if level >= settings["hard"]] + [self.posture]
        self.displacement = np.zeros(self.model.nv)

    def task(self, name: str, cost: float) -> pink.tasks.Task:
        damping = self.settings["damping"]
        if name == COM:
            return pink.tasks.ComTask(cost=cost, lm_damping=damping)
        return PointTask(self.model.getFrameId(name), cost, damping)

    def start(self, frame: int) -> float:
        posture = self.inputs[frame]
        if frame:
            before, now = self.inputs[frame - 1], self.configuration.q
            self.displacement = pin.difference(self.model, before, now)
        self.configuration.update(pin.integrate(self.model, posture, self.displacement))
        self.posture.set_target(posture)
        return float(np.abs(self.displacement[3:]).max())

    def aim(self, targets: np.ndarray) -> None:
        for task, target in zip(self.tasks, targets, strict=True):
            task.set_target(target)

    def step(self, turn: float) -> float:
        velocity = pink.solve_ik(
            self.configuration,
            self.soft,
            1.0,
            self.settings["solver"],
            limits=[],
            constraints=self.hard,
            safety_break=False,
        )
        largest = float(np.abs(velocity[3:]).max())
        self.configuration.integrate_inplace(velocity, min(1.0, turn / max(largest, 1e-12)))
        return largest

    def places(self) -> np.ndarray:
        configuration = self.configuration
        points = [configuration.data.oMf[frame].translation for frame in self.frames]
        com = pin.centerOfMass(self.model, configuration.data, configuration.q)
        return np.array([*points, com])

    def pose(self) -> tuple[np.ndarray, np.ndarray]:
        q = self.configuration.q
        return q[:3], q[self.quaternions]


if __name__ == "__main__":
    serve(Pink, "pin-pink", "pin")
