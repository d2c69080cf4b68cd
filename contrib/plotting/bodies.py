"""The deformed bodies, coloured by a field."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

from .style import COLOURS, figure_for, nice_number_below, save, short
from .surface import draw_section, draw_surface

LABELS = {"von_mises": "von Mises stress", "displacement_magnitude": "displacement"}


def outline(mesh):
    """Pairs of point numbers (n, 2) that bound the bodies in 2D.

    An edge inside a body occurs twice, or faces a chain of shorter ones: of smaller cells, or of the parts of a cut cell.
    Cut cells of different size may share parts of edges only; such edges lie on grid lines, where the outline is what an
    odd number of them covers (slivers may cover it several times).
    """
    points, body = mesh.points[:, :2], mesh.body
    tolerance = 1e-7 * mesh.size
    edges = without_partners(points, body, mesh.edges(), tolerance)
    on_line = np.abs(points[edges[:, 1]] - points[edges[:, 0]]) < tolerance
    segments = [edges[~on_line.any(axis=1)]]
    for along in range(2):
        flat = edges[on_line[:, 1 - along] & ~on_line[:, along]]
        segments.append(oddly_covered(points, body, flat, along, tolerance))
    return np.concatenate(segments)


def oddly_covered(points, body, edges, along, tolerance):
    """Parts of edges parallel to axis `along` that an odd number of cells covers."""
    if len(edges) == 0:
        return np.empty((0, 2), dtype=int)
    swap = points[edges[:, 0], along] > points[edges[:, 1], along]
    edges = np.where(swap[:, None], edges[:, ::-1], edges)
    ends = np.concatenate([edges[:, 0], edges[:, 1]])
    change = np.repeat([1, -1], len(edges))
    middle = 0.5 * points[edges, 1 - along].sum(axis=1)
    line = np.tile(np.rint(middle / tolerance / 4).astype(np.int64), 2)
    place = np.rint(points[ends, along] / tolerance / 4).astype(np.int64)
    order = np.lexsort((change, place, line, body[ends]))
    covers = np.cumsum(change[order])
    ends, place = ends[order], place[order]
    odd = np.flatnonzero((covers[:-1] % 2 == 1) & (place[1:] > place[:-1]))
    return np.stack([ends[odd], ends[odd + 1]], axis=1)


def without_partners(points, body, edges, tolerance):
    """Without the edges that occur an even number of times, those (a, b) for which a chain of others leads from a to b
    along them, and the chains."""
    grid = np.rint(points / tolerance / 4).astype(np.int64)
    key = np.column_stack([grid, body])
    _, vertex, number = np.unique(key[edges.ravel()], axis=0, return_index=True, return_inverse=True)
    vertex = edges.ravel()[vertex]
    pairs, count = np.unique(np.sort(number.reshape(-1, 2), axis=1), axis=0, return_counts=True)
    return vertex[without_chains(points[vertex], pairs[(count % 2 == 1) & (pairs[:, 0] < pairs[:, 1])])]


def without_chains(places, pairs):
    """Without the pairs (a, b) for which a chain of others leads from a to b, within 5% of their distance, and the chains."""
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
    return np.array(sorted(left), dtype=int).reshape(-1, 2)


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
