"""Smooth fields: values at the nodes of each body, recovered from those of the cells around them, and images of scattered values."""
import itertools

import numpy as np

from .results import BodyMesh
from .surface import SIX_TETRAHEDRA


def node_numbers(mesh):
    """A number for each point, the same where points of one body coincide."""
    return np.unique(words_of(np.rint(mesh.points / (4e-7 * mesh.size)).astype(np.int64), mesh.body), return_inverse=True)[1]


def words_of(places, body):
    """One word per place and body: the remainders of products with large odd numbers; collisions are as rare as 1 in 2^64/n^2."""
    factors = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
    return (places.view(np.uint64) * factors).sum(axis=1, dtype=np.uint64) + body.astype(np.uint64) * np.uint64(0x27D4EB2F165667C5)


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
    """The mean of what the cells around a node have there, with their areas or volumes as weights; at nodes on edges and faces
    of larger cells what those have, by the nodes at their ends."""
    number, size = node_numbers(mesh), sizes_at_points(mesh)
    weight = np.bincount(number, size)
    mean = np.bincount(number, size * values) / np.where(weight > 0.0, weight, 1.0)
    for nodes, ends in hanging_nodes(mesh, number):
        mean[nodes] = mean[ends].mean(axis=1)
    return np.where(weight[number] > 0.0, mean[number], values)


EDGES = {BodyMesh.triangle: ((0, 1), (1, 2), (2, 0)), BodyMesh.quadrilateral: ((0, 1), (1, 2), (2, 3), (3, 0)),
         BodyMesh.hexahedron: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))}
FACES = {BodyMesh.hexahedron: ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))}


def hanging_nodes(mesh, number):
    """Nodes in the middle of edges and of faces of larger cells, and the nodes (n, 2 or 4) at the ends of those: the largest
    first, in groups of one size."""
    point = np.empty(number.max() + 1, dtype=int)
    point[number] = np.arange(len(number))
    places, body = mesh.file_points[point], mesh.body[point]
    found = []
    for parts in (EDGES, FACES):
        ends = [number[cells[:, part]] for kind, cells in mesh.cells.items() for part in parts.get(kind, ())]
        if ends:
            ends = np.unique(np.sort(np.concatenate(ends), axis=1), axis=0)
            nodes = nodes_at(places, body, places[ends].mean(axis=1), body[ends[:, 0]], 1e-6 * mesh.size)
            ends, nodes = ends[nodes >= 0], nodes[nodes >= 0]
            edge = np.linalg.norm(places[ends[:, 0]] - places[ends[:, 1]], axis=1)
            found += [(-level, nodes[chosen], ends[chosen]) for level, chosen in by_level(edge)]
    return [(nodes, ends) for _, nodes, ends in sorted(found, key=lambda group: group[0])]


def by_level(lengths):
    """Lengths in groups of about the same binary logarithm: it, and which they are."""
    level = np.rint(2.0 * np.log2(lengths.clip(1e-300))).astype(int)
    return [(value, level == value) for value in np.unique(level)]


def nodes_at(places, body, wanted, of_body, tolerance):
    """The number of a node of the body within the tolerance of each place wanted, -1 without one."""
    found = np.full(len(wanted), -1)
    for shift in itertools.product((0.0, 0.5), repeat=3):
        known, asked = (words_of(np.floor(x / (4.0 * tolerance) + shift).astype(np.int64), b)
                        for x, b in ((places, body), (wanted, of_body)))
        order = np.argsort(known)
        at = order[np.searchsorted(known, asked, sorter=order).clip(max=len(known) - 1)]
        found = np.where(known[at] == asked, at, found)
    return found


def smoothed(points, weights, values, radius, reach, low, high):
    """An image, over low to high, of scattered values (n) at points (n, 2) with areas `weights`: in each pixel the moving least
    squares fit of degree 1 with the kernel (1 - (r/radius)^2)^2, nan farther than `reach` from all points; and its extent."""
    edge = max(radius / 8.0, (high - low).max() / 1000.0)
    shape = np.ceil((high - low) / edge).astype(int).clip(1)  # columns, rows
    edge = (high - low) / shape
    steps = [np.arange(-n, n + 1) for n in np.ceil(radius / edge).astype(int)]
    offsets = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 2)
    # Sums over the points around a pixel: of 1, x, y, x^2, xy, y^2 with the kernel, of v, vx, vy, and how many are near.
    sums = np.zeros((10, shape.prod()))
    for first in range(0, len(points), 10000):
        part = np.s_[first:first + 10000]
        pixel = np.floor((points[part] - low) / edge).astype(int)[:, None, :] + offsets
        distance = points[part][:, None, :] - (low + (pixel + 0.5) * edge)
        square = (distance ** 2).sum(axis=2)
        used = (square < radius ** 2) & (pixel >= 0).all(axis=2) & (pixel < shape).all(axis=2)
        number = (pixel[..., 1] * shape[0] + pixel[..., 0])[used]
        x, y = (distance[used] / radius).T
        kernel = (np.broadcast_to(weights[part, None], used.shape)[used]) * (1.0 - square[used] / radius ** 2) ** 2
        value = np.broadcast_to(values[part, None], used.shape)[used]
        for row, factor in enumerate((1.0, x, y, x * x, x * y, y * y, value, value * x, value * y)):
            sums[row] += np.bincount(number, kernel * factor, minlength=shape.prod())
        sums[9] += np.bincount(number, square[used] < reach ** 2, minlength=shape.prod())
    matrix = sums[[[0, 1, 2], [1, 3, 4], [2, 4, 5]]].transpose(2, 0, 1)
    # A little of the mean where points lie on a line.
    matrix[:, [1, 2], [1, 2]] += 1e-3 * matrix[:, [0], 0]
    image = np.full(shape.prod(), np.nan)
    is_near = sums[9] > 0
    image[is_near] = np.linalg.solve(matrix[is_near], sums[6:9, is_near].T[..., None])[:, 0, 0]
    return image.reshape(shape[::-1]), (low[0], high[0], low[1], high[1])
