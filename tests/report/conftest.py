"""Outcomes without USD: a humanoid whose result is what a test says."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from usdmotion import Constraint, Motion
from usdmotion.humanoid import recognize
from usdmotion.kernels import from_vector, multiply
from usdmotion.outcome import Outcome, Record
from usdmotion.testing import HUMANOID, humanoid_scene

Turns = Mapping[str, tuple[float, float, float]]


@dataclass(frozen=True)
class Outcomes:
    """Makes outcomes, and knows the tokens of the humanoid's joints."""

    def __call__(
        self,
        constraints: Sequence[Constraint] = (),
        *,
        turns: Turns | None = None,
        lift: float = 0.0,
        frame_count: int = 24,
        **said: object,
    ) -> Outcome:
        """Return an outcome whose result has some joints turned [rad], and the root lifted [m]."""
        scene = humanoid_scene(constraints, frame_count=frame_count)
        (character,) = scene.characters
        given = character.motion
        skeleton = character.skeleton
        rotations, translations = np.array(given.rotations), np.array(given.translations)
        for name, turn in (turns or {}).items():
            joint = skeleton.index[self.token(name)]
            rotations[:, joint] = multiply(rotations[:, joint], from_vector(np.array([turn])))
        translations[:, 0, 1] += lift
        whole = replace(character, parts=recognize(skeleton))
        scene = replace(scene, characters=(whole,))
        record = {
            "edit": scene.edits[0].path,
            "solver": "by_hand",
            "version": "7.8.9",
            "options": {"patience": 3},
            "input_hash": "abc",
            "hash_now": "abc",
            "shown": True,
        }
        motion = Motion(given.times, translations, rotations)
        return Outcome(scene, {HUMANOID: motion}, (Record(**(record | said)),), ("beware <this>",))

    def token(self, name: str) -> str:
        """Return the token of a joint by its last name."""
        return next(token for token in self.joints if token.rsplit("/", 1)[-1] == name)

    @property
    def joints(self) -> tuple[str, ...]:
        return humanoid_scene().characters[0].skeleton.joints


@pytest.fixture
def outcome() -> Outcomes:
    return Outcomes()
