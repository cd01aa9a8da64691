"""The reader of BVH files."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from usdmotion import Motion, Recording, Skeleton, option
from usdmotion_bvh.hierarchy import Joint
from usdmotion_bvh.meaning import Wishes, decide_meaning
from usdmotion_bvh.names import joint_tokens, valid_name
from usdmotion_bvh.rates import decide_rate
from usdmotion_bvh.takes import read_take


@dataclass(frozen=True)
class BvhReader:
    """Reads BVH files of any maker; what a file leaves open is decided from its data and said."""

    name: ClassVar[str] = "bvh"
    suffixes: ClassVar[tuple[str, ...]] = (".bvh",)

    rate: float = option(
        0.0, "Samples per second where the file's Frame Time is wrong; 0 trusts it.", minimum=0.0
    )
    unit: float = option(
        0.0, "Metres per unit of the file; 0 decides by the height of the body.", minimum=0.0
    )
    root: str = option(
        "auto",
        "Whether the root's positions include its OFFSET (absolute) or are added to it (relative).",
        choices=("auto", "absolute", "relative"),
    )
    up: str = option("auto", "The axis of the file that points up.", choices=("auto", "Y", "Z"))
    root_scale: float = option(
        0.0,
        "Factor on the root's positions; 0 takes them as they are and refuses a clash of units.",
        minimum=0.0,
    )

    skip: int = option(
        0, "Frames at the start that are left out, such as an added T-pose.", minimum=0
    )

    def read(self, path: Path) -> Recording:
        """Read one file.

        Raises:
            FileError: The file is refused; one sentence with the file and the line.
        """
        take = read_take(path)
        rate, notes = decide_rate(take.source, take.rows, self.rate)
        meaning = decide_meaning(take, Wishes(self.unit, self.root, self.up, self.root_scale))
        joints, tips = take.hierarchy.joints, take.hierarchy.tips
        poses, metres = take.poses, meaning.metres
        tokens = joint_tokens(joints)
        rest_rotations = np.tile((0.0, 0.0, 0.0, 1.0), (len(joints), 1))
        kept = slice(min(self.skip, len(take.rows.values) - 1), None)
        return Recording(
            name=valid_name(path.stem),
            skeleton=Skeleton(tokens, poses.parents, poses.offsets * metres, rest_rotations),
            motion=Motion(
                times=np.arange(len(take.rows.values[kept])) / rate,
                translations=meaning.translations[kept] * metres,
                rotations=poses.rotations[kept],
            ),
            frame_rate=rate,
            original_names=tuple(joint.name for joint in joints),
            up=meaning.up,
            tip_joints=np.array([tip.joint for tip in tips], dtype=np.int64),
            tip_points=np.array([tip.offset for tip in tips]).reshape(-1, 3) * metres,
            notes=(*take.rows.notes, *notes, *meaning.notes, *_renamed(joints, tokens)),
        )


def _renamed(joints: tuple[Joint, ...], tokens: tuple[str, ...]) -> list[str]:
    """Return what there is to say about names that USD does not allow."""
    new_names = [token.rpartition("/")[2] for token in tokens]
    pairs = zip((joint.name for joint in joints), new_names, strict=True)
    renamed = [(name, new) for name, new in pairs if name != new]
    if not renamed:
        return []
    name, new = renamed[0]
    return [f"{len(renamed)} joint names do not suit USD and are changed: '{name}' to '{new}'"]
