"""Pictures of bodies in 3D: their surface and plane sections, drawn pixel by pixel with the nearest triangle in front."""
import itertools

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_rgba

from .results import BodyMesh
from .style import RIGID, figure_for

CELL_EDGE = "#9a9a9a"
PIXELS = 1000  # along the longer side of the picture
# A cube in six tetrahedra around the diagonal of the vertices 0 and 6 of VTK's order.
SIX_TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))


class View:
    """Directions of the picture in space: to the right, up, and towards the eye."""

    def __init__(self, azimuth=-60.0, elevation=25.0):
        azimuth, elevation = np.radians(azimuth), np.radians(elevation)
        self.right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        self.towards = np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation),
                                 np.sin(elevation)])
        self.up = np.cross(self.towards, self.right)

    def project(self, points):
        """Coordinates in the picture (n, 2) and nearness (n)."""
        return np.stack([points @ self.right, points @ self.up], axis=1), points @ self.towards


class Raster:
    """For every pixel the nearest triangle (-1: none), of several the first, and the barycentric weights of its corners there."""

    def __init__(self, plane, nearness, triangles):
        self.low, high = plane.min(axis=0), plane.max(axis=0)
        self.pixel = (high - self.low).max() / PIXELS
        self.low, high = self.low - 2.0 * self.pixel, high + 2.0 * self.pixel  # room for the outline
        width, height = (np.ceil((high - self.low) / self.pixel).astype(int) + 1).tolist()
        self.extent = (self.low[0], self.low[0] + width * self.pixel, self.low[1], self.low[1] + height * self.pixel)
        self.triangle = np.full((height, width), -1)
        self.weights = np.zeros((height, width, 3))
        self.nearness = np.full((height, width), -np.inf)
        corners = (plane[triangles] - self.low) / self.pixel - 0.5
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        doubled_area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        first = np.ceil(corners.min(axis=1)).astype(int).clip(0)
        last = np.floor(corners.max(axis=1)).astype(int).clip(max=[width - 1, height - 1])
        seen = np.flatnonzero((last >= first).all(axis=1) & (np.abs(doubled_area) > 1e-9))
        for number in seen:
            self.paint(number, first[number], last[number], corners[number], doubled_area[number],
                       nearness[triangles[number]])

    def paint(self, number, first, last, corners, doubled_area, nearness):
        x, y = np.arange(first[0], last[0] + 1), np.arange(first[1], last[1] + 1)[:, None]
        (ax, ay), (bx, by), (cx, cy) = corners
        weight_b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / doubled_area
        weight_c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / doubled_area
        weight_a = 1.0 - weight_b - weight_c
        depth = weight_a * nearness[0] + weight_b * nearness[1] + weight_c * nearness[2]
        window = np.s_[first[1]:last[1] + 1, first[0]:last[0] + 1]
        front = ((weight_a >= -1e-9) & (weight_b >= -1e-9) & (weight_c >= -1e-9)
                 & (depth > self.nearness[window] + 1e-3 * self.pixel))
        self.nearness[window][front] = depth[front]
        self.triangle[window][front] = number
        self.weights[window][front] = np.stack([weight_a, weight_b, weight_c], axis=2)[front]

    def values(self, of_corners):
        """An image of values (n triangles, 3) given at the corners; nan where there is nothing."""
        image = np.einsum("ijk,ijk->ij", self.weights, of_corners[self.triangle])
        return np.where(self.triangle >= 0, image, np.nan)

    def outlines(self, body):
        """Whether a pixel lies where one body ends: beside nothing, another body (n triangles), or a step in depth."""
        shown = np.where(self.triangle >= 0, body[self.triangle], -1)
        finite = np.where(self.triangle >= 0, self.nearness, 0.0)
        return between(lambda axis: (np.diff(shown, axis=axis) != 0) | (np.abs(np.diff(finite, axis=axis)) > 20.0 * self.pixel))

    def cell_edges(self, cell):
        """Whether a pixel lies between two cells (n triangles), of which numbers below 0 are none."""
        shown = np.where(self.triangle >= 0, cell[self.triangle], -1)
        return between(lambda axis: (np.diff(shown, axis=axis) != 0) & (pairwise(np.maximum, shown, axis) >= 0))

    def sees(self, plane, nearness):
        """Whether points of the surface at `plane` (n, 2) are in front."""
        column, row = np.floor((plane - self.low) / self.pixel).astype(int).T
        inside = (column >= 0) & (row >= 0) & (column < self.triangle.shape[1]) & (row < self.triangle.shape[0])
        row, column = np.where(inside, (row, column), 0)
        return inside & (nearness > self.nearness[row, column] - 3.0 * self.pixel)

    def draw(self, axes, colours, outlines):
        """Colours (height, width, 4) with black outlines."""
        colours[outlines] = (0.0, 0.0, 0.0, 1.0)
        axes.imshow(colours, extent=self.extent, origin="lower", interpolation="antialiased", zorder=1)


def pairwise(function, image, axis):
    """The function of all pixels and of those that follow along an axis."""
    n = image.shape[axis]
    return function(np.take(image, range(n - 1), axis), np.take(image, range(1, n), axis))


def between(changes):
    """Whether a pixel differs from the next one along either axis; `changes` tells it for the pairs along an axis."""
    return np.pad(changes(0), [(0, 1), (0, 0)]) | np.pad(changes(1), [(0, 0), (0, 1)])


def surface_triangles(mesh):
    """Triangles (n, 3) of the faces that occur an odd number of times. Where cells of different size meet inside a
    body their faces remain; they are hidden behind the surface."""
    tetrahedra, hexahedra = mesh.cells_of(BodyMesh.tetrahedron), mesh.cells_of(BodyMesh.hexahedron)
    faces = [tetrahedra[:, list(f) + [f[2]]] for f in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))]
    faces += [hexahedra[:, list(f)] for f in ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
                                              (2, 3, 7, 6), (3, 0, 4, 7))]
    faces = np.concatenate(faces)
    grid = np.rint(mesh.points / (4e-7 * mesh.size)).astype(np.int64)
    _, number = np.unique(np.column_stack([grid, mesh.body]), axis=0, return_inverse=True)
    number = np.sort(number[faces], axis=1)
    solid = (np.diff(number, axis=1) > 0).sum(axis=1) >= 2
    faces, number = faces[solid], number[solid]
    _, first, count = np.unique(number, axis=0, return_index=True, return_counts=True)
    faces = faces[first[count % 2 == 1]]
    quadrilateral = faces[:, 2] != faces[:, 3]
    return by_body(mesh, np.concatenate([faces[:, :3], faces[quadrilateral][:, [0, 2, 3]]]))


def by_body(mesh, corners):
    """Triangles (n, 3, ...) of points in the order of their bodies: where bodies overlap the same one is always seen."""
    return corners[np.argsort(mesh.body[corners.reshape(len(corners), -1)[:, 0]], kind="stable")]


def section_triangles(mesh, axis, position):
    """The section of all bodies with the plane x_axis = position: triangles as pairs of points and the share of the
    second (n, 3), by tetrahedra that are cut into a triangle or two."""
    hexahedra = mesh.cells_of(BodyMesh.hexahedron)
    tetrahedra = np.concatenate([mesh.cells_of(BodyMesh.tetrahedron)] + [hexahedra[:, list(t)] for t in SIX_TETRAHEDRA])
    # A plane through nodes would meet tetrahedra in corners and edges only.
    side = mesh.points[:, axis] - position - 1e-9 * mesh.size
    tetrahedra = tetrahedra[(side[tetrahedra].min(axis=1) < 0.0) & (side[tetrahedra].max(axis=1) >= 0.0)]
    tetrahedra = np.take_along_axis(tetrahedra, np.argsort(side[tetrahedra], axis=1), axis=1)
    n_below = (side[tetrahedra] < 0.0).sum(axis=1)
    edges = {1: [((0, 1), (0, 2), (0, 3))], 3: [((0, 3), (1, 3), (2, 3))],
             2: [((0, 2), (0, 3), (1, 3)), ((0, 2), (1, 3), (1, 2))]}
    pairs = by_body(mesh, np.concatenate([tetrahedra[n_below == n][:, triangle].reshape(-1, 3, 2)
                                          for n, triangles in edges.items() for triangle in triangles]))
    share = side[pairs[:, :, 0]] / (side[pairs[:, :, 0]] - side[pairs[:, :, 1]])
    return pairs, share


def draw_surface(mesh, deformed, values, scale, shown=None, box=None, cmap="viridis", cells=None, marks=None, extra=1.2):
    """The surface, grey where points are not `shown`, in a window for what is in `box` (low and high corner), seen from above the
    corner between x and -y; edges of `cells` (a number for each point, below 0: none), and what `marks` makes of the centres of the
    triangles and their bodies: pairs of points on the surface (n, 3) and their colour; `extra` room beside it in inches. Figure, axes, and the colours for a bar."""
    view = View()
    triangles = surface_triangles(mesh)
    plane, nearness = view.project(deformed)
    used = np.unique(triangles)
    corners = plane[used] if box is None else view.project(np.array(list(itertools.product(*zip(*box)))))[0]
    figure, axes = figure_for(corners, extra=extra)
    axes.set_axis_off()
    raster = Raster(plane, nearness, triangles)
    a, b, c = (deformed[triangles[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True).clip(1e-300)
    lamp = view.towards + 0.4 * view.up
    light = 0.65 + 0.35 * np.abs(normal @ lamp / np.linalg.norm(lamp))
    colours = ScalarMappable(Normalize(*scale), cmap)
    image = colours.to_rgba(raster.values(values[triangles]))
    if shown is not None:
        image[~shown[triangles[:, 0]][raster.triangle]] = to_rgba(RIGID)
    image[:, :, :3] *= light[raster.triangle][:, :, None]
    image[raster.triangle < 0] = 0.0
    if cells is not None:
        image[raster.cell_edges(cells[triangles[:, 0]])] = to_rgba(CELL_EDGE)
    for points, colour in marks(mesh.points[triangles].mean(axis=1), mesh.body[triangles[:, 0]]) if marks else ():
        places, depth = view.project(points)
        axes.plot(*places[raster.sees(places, depth)].T, "o", markersize=4, color=colour, alpha=0.6, zorder=3)
    outlines = raster.outlines(mesh.body[triangles[:, 0]])
    if shown is not None and not shown.all() and shown.any():
        see_through(mesh, plane, nearness, triangles[shown[triangles[:, 0]]], raster, image, outlines, colours, values)
    raster.draw(axes, image, outlines)
    return figure, axes, colours


def see_through(mesh, plane, nearness, triangles, raster, image, outlines, colours, values):
    """Lets what rigid bodies hide shine through them, with its outlines."""
    inner = Raster(plane, nearness, triangles)
    hidden = (inner.triangle >= 0) & (inner.nearness < raster.nearness)
    behind = colours.to_rgba(inner.values(values[triangles]))
    image[hidden] = 0.35 * image[hidden] + 0.65 * behind[hidden]
    outlines |= inner.outlines(mesh.body[triangles[:, 0]]) & (hidden | (inner.triangle < 0)) & (raster.triangle >= 0)


def draw_section(mesh, deformed, values, section, scale, shown, cmap="viridis", cells=None, extra=1.2):
    """The section with the plane (axis, position) of the undeformed bodies, with edges of `cells` as of the surface. Figure, axes,
    and the colours."""
    pairs, share = section_triangles(mesh, *section)
    kept = [axis for axis in range(3) if axis != section[0]]
    at = [deformed[:, kept], values]
    plane, field = ((1.0 - share)[..., None] * a.reshape(len(a), -1)[pairs[:, :, 0]]
                    + share[..., None] * a.reshape(len(a), -1)[pairs[:, :, 1]] for a in at)
    plane = plane.reshape(-1, 2)
    figure, axes = figure_for(plane, extra=extra)
    raster = Raster(plane, np.zeros(len(plane)), np.arange(len(plane)).reshape(-1, 3))
    colours = ScalarMappable(Normalize(*scale), cmap)
    image = colours.to_rgba(raster.values(field[..., 0]))
    image[~shown[pairs[:, 0, 0]][raster.triangle]] = to_rgba(RIGID)
    image[raster.triangle < 0] = 0.0
    if cells is not None:
        image[raster.cell_edges(cells[pairs[:, 0, 0]])] = to_rgba(CELL_EDGE)
    raster.draw(axes, image, raster.outlines(mesh.body[pairs[:, 0, 0]]))
    return figure, axes, colours
