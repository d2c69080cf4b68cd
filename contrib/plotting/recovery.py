"""Smooth fields: values at the nodes of each body, recovered from those of the cells around them."""
import numpy as np

from .results import BodyMesh
from .surface import SIX_TETRAHEDRA


def node_numbers(mesh):
    """A number for each point, the same where points of one body coincide."""
    places = np.rint(mesh.points / (4e-7 * mesh.size)).astype(np.int64).view(np.uint64)
    # One word per place: the remainders of products with large odd numbers; collisions are as rare as 1 in 2^64/n^2.
    factors = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
    words = (places * factors).sum(axis=1, dtype=np.uint64) + mesh.body.astype(np.uint64) * np.uint64(0x27D4EB2F165667C5)
    return np.unique(words, return_inverse=True)[1]


def sizes_at_points(mesh):
    """Area or volume of the cell of each point; every point belongs to one cell."""
    sizes = np.zeros(len(mesh.points))
    for kind, cells in mesh.cells.items():
        corners = mesh.points[cells]
        if kind in (BodyMesh.triangle, BodyMesh.quadrilateral):
            a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
            sizes[cells] = (area if kind == BodyMesh.quadrilateral else 0.5 * area)[:, None]
        else:
            parts = SIX_TETRAHEDRA if kind == BodyMesh.hexahedron else ((0, 1, 2, 3),)
            edges = [corners[:, list(p[1:])] - corners[:, [p[0]]] for p in parts]
            sizes[cells] = sum(np.abs(np.linalg.det(e)) for e in edges)[:, None] / 6.0
    return sizes


def recovered(mesh, values):
    """The mean of what the cells around a node have there, with their areas or volumes as weights."""
    number, size = node_numbers(mesh), sizes_at_points(mesh)
    weight = np.bincount(number, size)
    mean = np.bincount(number, size * values) / np.where(weight > 0.0, weight, 1.0)
    return np.where(weight[number] > 0.0, mean[number], values)
