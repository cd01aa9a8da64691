"""All that a file says, before it is decided what it means."""

from dataclasses import dataclass
from pathlib import Path

from usdmotion_bvh.hierarchy import Hierarchy, parse_hierarchy
from usdmotion_bvh.poses import Poses, read_poses
from usdmotion_bvh.rows import Rows, parse_rows
from usdmotion_bvh.source import Source, read_source


@dataclass(frozen=True)
class Take:
    """One file, read in four steps."""

    source: Source
    hierarchy: Hierarchy
    rows: Rows
    poses: Poses


def read_take(path: Path) -> Take:
    """Read a file.

    Raises:
        FileError: It cannot be read without guessing.
    """
    source = read_source(path)
    hierarchy = parse_hierarchy(source)
    rows = parse_rows(source, hierarchy.motion_line, hierarchy.channel_count)
    return Take(source, hierarchy, rows, read_poses(hierarchy, rows.values))
