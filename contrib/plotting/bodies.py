"""The deformed bodies, coloured by a field."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

from .style import COLOURS, figure_for, nice_number_below, save, short
from .surface import draw_section, draw_surface

LABELS = {"von_mises": "von Mises stress", "displacement_magnitude": "displacement"}


def outline(mesh):
    """Pairs of point numbers (n, 2) that bound the bodies in 2D.

    Cells of different size share parts of edges. On a geometry that has not moved all edges inside a body lie on grid
    lines, or are shared whole: on a grid line the outline is where an odd number of cells covers the line (slivers of cut
    cells may cover it several times), elsewhere it is an edge that occurs an odd number of times. On a moved one an edge
    may face a chain of shorter ones, of smaller cells or of the parts of a cut cell.
    """
    points, body, edges = mesh.points[:, :2], mesh.body, mesh.edges()
    tolerance = 1e-7 * mesh.size
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    on_line = np.abs(end - start) < tolerance
    segments = []
    for along in range(2):
        flat = edges[on_line[:, 1 - along] & ~on_line[:, along]]
        segments.append(oddly_covered(points, body, flat, along, tolerance))
    slanted = edges[~on_line.any(axis=1)]
    segments.append(without_partner(points, body, slanted, tolerance))
    return without_chains(points, body, np.concatenate(segments), tolerance)


def oddly_covered(points, body, edges, along, tolerance):
    """Parts of edges parallel to axis `along` that an odd number of cells covers."""
    if len(edges) == 0:
        return np.empty((0, 2), dtype=int)
    swap = points[edges[:, 0], along] > points[edges[:, 1], along]
    edges = np.where(swap[:, None], edges[:, ::-1], edges)
    ends = np.concatenate([edges[:, 0], edges[:, 1]])
    change = np.repeat([1, -1], len(edges))
    line = np.rint(points[ends, 1 - along] / tolerance / 4).astype(np.int64)
    place = np.rint(points[ends, along] / tolerance / 4).astype(np.int64)
    order = np.lexsort((change, place, line, body[ends]))
    covers = np.cumsum(change[order])
    ends, place = ends[order], place[order]
    odd = np.flatnonzero((covers[:-1] % 2 == 1) & (place[1:] > place[:-1]))
    return np.stack([ends[odd], ends[odd + 1]], axis=1)


def welded(points, body, edges, tolerance):
    """The edges (n, 2) between numbers of places, smaller first; a point of each place."""
    grid = np.rint(points / tolerance / 4).astype(np.int64)
    key = np.column_stack([grid, body])
    _, point, number = np.unique(key[edges.ravel()], axis=0, return_index=True, return_inverse=True)
    return np.sort(number.reshape(-1, 2), axis=1), edges.ravel()[point]


def without_partner(points, body, edges, tolerance):
    """Edges that occur an odd number of times."""
    if len(edges) == 0:
        return edges
    number, _ = welded(points, body, edges, tolerance)
    _, first, count = np.unique(number, axis=0, return_index=True, return_counts=True)
    return edges[first[count % 2 == 1]]


def without_chains(points, body, edges, tolerance):
    """Without the edges (a, b) for which a chain of others leads from a to b along them, and without the chain."""
    if len(edges) == 0:
        return edges
    pairs, vertex = welded(points, body, edges, tolerance)
    places = points[vertex]
    left = {tuple(pair) for pair in pairs.tolist()}
    neighbours = {}
    for a, b in left:
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)

    def remove(a, b):
        left.remove((min(a, b), max(a, b)))
        neighbours[a].remove(b)
        neighbours[b].remove(a)

    def chain(a, b):
        axis = places[b] - places[a]
        square, path = axis @ axis, [a]
        while path[-1] != b:
            offsets = {m: places[m] - places[a] for m in neighbours[path[-1]] if m != b or len(path) > 1}
            along = {m: d @ axis / square for m, d in offsets.items()
                     if abs(axis[0] * d[1] - axis[1] * d[0]) < 0.05 * square}
            last = (places[path[-1]] - places[a]) @ axis / square
            ahead = [m for m in along if last + 1e-6 < along[m] < 1 + 1e-6]
            if not ahead:
                return []
            path.append(min(ahead, key=along.get))
        return path

    lengths = np.linalg.norm(places[pairs[:, 1]] - places[pairs[:, 0]], axis=1)
    for a, b in pairs[np.argsort(-lengths)].tolist():
        path = chain(a, b) if (a, b) in left else []
        if path:
            for edge in [(a, b), *zip(path, path[1:])]:
                remove(*edge)
    return vertex[np.array(sorted(left), dtype=int).reshape(-1, 2)]


def automatic_warp(mesh, contact):
    """Largest displacement 5% of the size, but no visible overlap of magnified bodies: with the factor w the gap
    g_0 + n.[[u]] is drawn as g_0 + w n.[[u]]."""
    largest = np.linalg.norm(mesh.displacement, axis=1).max()
    if largest == 0.0:
        return 1.0
    warp = 0.05 * mesh.size / largest
    if contact:
        axes = [axis for axis in "xyz" if f"normal_{axis}" in contact]
        closing = sum(contact[f"normal_{axis}"] * contact[f"jump_{axis}"] for axis in axes)
        initial = contact["gap"] - closing
        shut = (closing < 0.0) & (initial > -0.0025 * mesh.size)
        if shut.any():
            warp = min(warp, ((initial[shut] + 0.0025 * mesh.size) / -closing[shut]).min())
    return nice_number_below(max(warp, 1.0))


def limits(values):
    """Range of the colours: 99.5% of the points, so that corner singularities do not hide the rest."""
    low, high = np.percentile(values, [0.25, 99.75])
    if low >= 0.0 and low < 0.3 * high:
        low = 0.0
    if high - low <= 1e-12 * max(abs(low), abs(high)):
        high, low = high + 1e-9 * (abs(high) or 1.0), low - 1e-9 * (abs(low) or 1.0)
    return low, high


def extend(values, low, high):
    """Which ends of the colour bar are exceeded by the values."""
    tolerance = 1e-9 * (high - low)
    return {(False, False): "neither", (False, True): "max", (True, False): "min", (True, True): "both"}[
        (bool(values.min() < low - tolerance), bool(values.max() > high + tolerance))]


def draw(run, field, step, warp):
    """Writes bodies_FIELD.png (bodies_FIELD_NNNN.png for a step asked for), in 3D section_FIELD.png too; the paths."""
    if not run.body_files:
        return []
    suffix = "" if step is None else f"_{step:04d}"
    step = run.chosen_step(run.body_files, step)
    mesh = run.mesh(step)
    values = mesh.field(field)
    contact = run.contact(step) if step in run.contact_files else None
    factor = automatic_warp(mesh, contact) if warp == "auto" else warp
    deformed = mesh.points + factor * mesh.displacement
    time = run.time_of(step)
    title = f"{run.title}\n" + (f"time {short(time)}, " if time is not None else "") + f"displacements times {short(factor)}"
    pictures = []

    def finish(name, drawn, more=""):
        figure, axes, colours = drawn
        axes.set_title(title + more)
        label = LABELS.get(field, field.replace("_", " "))
        figure.colorbar(colours, ax=axes, label=label, extend=extend(values, *colours.get_clim()), shrink=0.85, pad=0.02)
        pictures.append(save(figure, run.directory / f"{name}_{field}{suffix}.png"))

    if mesh.dim == 2:
        finish("bodies", draw_2d(mesh, deformed[:, :2], values))
    else:
        finish("bodies", draw_surface(mesh, deformed, values, limits(values)))
        section = section_plane(mesh, contact)
        finish("section", draw_section(mesh, deformed, values, section, limits(values)),
               f", section {'xyz'[section[0]]} = {short(section[1])}")
    return pictures


def section_plane(mesh, contact):
    """Axis and position of the section: through the centre of the contact forces, normal to the axis y or, where
    contact acts along y, x; without contact through the middle."""
    middle = 0.5 * (mesh.points.min(axis=0) + mesh.points.max(axis=0))
    if contact is None or not contact["pressure"].any():
        return 1, middle[1]
    force = contact["weight"] * contact["pressure"]
    normal = [np.abs(force @ contact[f"normal_{axis}"]) for axis in "xyz"]
    axis = 0 if np.argmax(normal) == 1 else 1
    return axis, force @ contact["xyz"[axis]] / force.sum()


def draw_2d(mesh, deformed, values):
    figure, axes = figure_for(deformed)
    low, high = limits(values)
    colours = axes.tripcolor(Triangulation(deformed[:, 0], deformed[:, 1], mesh.triangles()), values,
                             shading="gouraud", cmap="viridis", vmin=low, vmax=high, rasterized=True)
    edges = outline(mesh)
    axes.add_collection(LineCollection(deformed[edges], colors="black", linewidths=0.8, capstyle="round"))
    return figure, axes, colours


def body_colour(number):
    return COLOURS[number % len(COLOURS)]
