"""The clip by placo."""

from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import placo
from contest import COM, Clip, serve


class Placo:
    """Soft tasks, or the first levels hard, over a regularization of the step.

    Its posture task is for hinges, so the posture is kept by one soft relative orientation a joint.
    """

    def __init__(self, path: Path, clip: Clip, settings: dict[str, Any]) -> None:
        self.settings = settings
        flags = placo.Flags.mjcf | placo.Flags.ignore_collisions
        self.robot = placo.RobotWrapper(str(path), flags)
        self.model = self.robot.model
        # The first joint's quaternion stands behind its position.
        self.joints = [self.model.getJointId(name) for name in clip.joints]
        first = np.array([self.model.joints[joint].idx_q for joint in self.joints])
        first[0] += 3
        self.quaternions = first[:, None] + np.arange(4)
        self.inputs = np.zeros((len(clip.root), self.model.nq))
        self.inputs[:, :3] = clip.root
        self.inputs[:, self.quaternions] = clip.turns
        self.solver = placo.KinematicsSolver(self.robot)
        self.points = [name for name in clip.names if name != COM]
        ranked = zip(clip.names, clip.levels, strict=True)
        self.tasks = [self.task(name, level) for name, level in ranked]
        self.postures = self.posture_tasks(clip)
        self.solver.add_regularization_task(settings["damping"])
        self.displacement = np.zeros(self.model.nv)

    def task(self, name: str, level: int) -> Any:
        target = np.zeros(3)
        if name == COM:
            task = self.solver.add_com_task(target)
        else:
            task = self.solver.add_position_task(name, target)
        priority = "hard" if level < self.settings["hard"] else "soft"
        task.configure(name, priority, self.settings["costs"][level])
        return task

    def posture_tasks(self, clip: Clip) -> list[Any]:
        tasks = []
        for joint, index in list(enumerate(self.joints))[1:]:
            above = self.joints.index(self.model.parents[index])
            task = self.solver.add_relative_orientation_task(
                f"body{above}", f"body{joint}", np.eye(3)
            )
            task.configure(f"posture{joint}", "soft", self.settings["posture"])
            rest = self.model.jointPlacements[index].rotation
            asked = [rest @ pin.Quaternion(turn).matrix() for turn in clip.turns[:, joint]]
            tasks.append((task, asked))
        return tasks

    def start(self, frame: int) -> float:
        robot, posture = self.robot, self.inputs[frame]
        if frame:
            before, now = self.inputs[frame - 1], robot.state.q
            self.displacement = pin.difference(self.model, before, now)
        robot.state.q = pin.integrate(self.model, posture, self.displacement)
        robot.update_kinematics()
        for task, asked in self.postures:
            task.R_a_b = asked[frame]
        return float(np.abs(self.displacement[3:]).max())

    def aim(self, targets: np.ndarray) -> None:
        for task, target in zip(self.tasks, targets, strict=True):
            task.target_world = target

    def step(self, turn: float) -> float:
        robot = self.robot
        velocity = self.solver.solve(False)
        largest = float(np.abs(velocity[3:]).max())
        share = min(1.0, turn / max(largest, 1e-12))
        robot.state.q = pin.integrate(self.model, robot.state.q, share * velocity)
        robot.update_kinematics()
        return largest

    def places(self) -> np.ndarray:
        robot = self.robot
        points = [robot.get_T_world_frame(name)[:3, 3] for name in self.points]
        return np.array([*points, robot.com_world()])

    def pose(self) -> tuple[np.ndarray, np.ndarray]:
        q = self.robot.state.q
        return q[:3].copy(), q[self.quaternions]


if __name__ == "__main__":
    serve(Placo, "placo", "pin")
