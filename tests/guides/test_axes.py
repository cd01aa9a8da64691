"""Directions beside an axis are right-handed, and a marker is closed and seen from every side."""

from collections import Counter

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from usdmotion.guides import OCTAHEDRON_FACES, octahedron
from usdmotion.guides.axes import sideways

WAYS = arrays(np.float64, 3, elements=st.floats(-1.0, 1.0)).filter(
    lambda way: np.linalg.norm(way) > 0.1
)


@given(WAYS)
def test_directions_beside_an_axis_are_at_right_angles(way):
    up = way / np.linalg.norm(way)
    frame = np.array([*sideways(up), up])
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(frame) > 0.0


def test_the_faces_of_a_marker_look_outwards_and_leave_no_gap():
    corners = octahedron(2.0)
    np.testing.assert_allclose(np.linalg.norm(corners, axis=1), 2.0)
    faces = corners[OCTAHEDRON_FACES]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    assert ((normals * faces.mean(axis=1)).sum(axis=1) > 0.0).all()
    edges = Counter(
        tuple(face[[corner, (corner + 1) % 3]].tolist())
        for face in OCTAHEDRON_FACES
        for corner in range(3)
    )
    assert all(edges[b, a] == count == 1 for (a, b), count in edges.items())
