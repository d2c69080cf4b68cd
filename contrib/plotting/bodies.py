"""The deformed bodies, coloured by a field."""
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.tri import Triangulation

from .recovery import recovered
from .style import COLOURS, RIGID, figure_for, nice_number_below, save, short
from .surface import draw_section, draw_surface

LABELS = {"von_mises": "von Mises stress", "displacement_magnitude": "displacement",
          "plastic_strain": "equivalent plastic strain", "plastic_zone": "plastic zone (1: has yielded)"}


def outline(mesh):
    """Pairs of point numbers (n, 2) that bound the bodies in 2D.

    An edge inside a body occurs twice, or faces a chain of shorter ones: of smaller cells, or of the parts of a cut cell.
    Cut cells of different size may share parts of edges only; such edges lie on grid lines, where the outline is what an
    odd number of them covers (slivers may cover it several times). Cells that share a corner of a body may cut it at places
    that differ a little.
    """
    points, body = mesh.points[:, :2], mesh.body
    tolerance = 1e-7 * mesh.size
    edges = without_partners(points, body, mesh.edges(), tolerance)
    on_line = np.abs(points[edges[:, 1]] - points[edges[:, 0]]) < tolerance
    segments = [edges[~on_line.any(axis=1)]]
    for along in range(2):
        flat = edges[on_line[:, 1 - along] & ~on_line[:, along]]
        segments.append(oddly_covered(points, body, flat, along, tolerance))
    return without_needles(points, body, np.concatenate(segments), tolerance)


def without_needles(points, body, edges, tolerance):
    """Where two edges leave a point in nearly the same direction, they give way to what is between their other ends: beside
    a corner, cells differ a little in where the surface cuts the edge between them."""
    key = np.column_stack([np.rint(points[edges.ravel()] / tolerance / 4).astype(np.int64), body[edges.ravel()]])
    _, first, number = np.unique(key, axis=0, return_index=True, return_inverse=True)
    places, number = points[edges.ravel()[first]], number.reshape(-1, 2)
    left, neighbours = set(), [set() for _ in places]

    def toggle(a, b):
        if a != b:
            left.symmetric_difference_update({(min(a, b), max(a, b))})
            neighbours[a].symmetric_difference_update({b})
            neighbours[b].symmetric_difference_update({a})

    for a, b in number.tolist():
        toggle(a, b)
    for a, width in suspects(places, number):
        while len(neighbours[a]) > 1:
            ends = sorted(neighbours[a])
            away = directions(places[ends] - places[a])
            cosine = np.where(np.tri(len(ends), dtype=bool), -1.0, away @ away.T)
            b, c = np.unravel_index(np.argmax(cosine), cosine.shape)
            if cosine[b, c] < np.cos(width):
                break
            for pair in ((a, ends[b]), (a, ends[c]), (ends[b], ends[c])):
                toggle(*pair)
    return edges.ravel()[first][np.array(sorted(left), dtype=int).reshape(-1, 2)]


def polylines(edges):
    """The edges (n, 2), joined where they share a point: lists of points, closed ones with the first again at the end."""
    neighbours = {}
    for a, b in edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    ends = [point for point, others in neighbours.items() if len(others) != 2]
    lines = []
    for start in ends + list(neighbours):
        while neighbours[start]:
            line = [start]
            while neighbours[line[-1]] and (len(line) == 1 or line[-1] != start):
                line.append(neighbours[line[-1]].pop())
                neighbours[line[-1]].remove(line[-2])
            lines.append(line)
    return lines


def suspects(places, edges):
    """Points where more than two edges meet, or two in a needle, and how narrow needles are there, in radians."""
    order = np.argsort(edges.ravel(), kind="stable")
    point, end = edges.ravel()[order], edges[:, ::-1].ravel()[order]
    count = np.bincount(point, minlength=len(places))
    first = np.flatnonzero(np.diff(point, prepend=-1))
    two = first[count[point[first]] == 2]
    b, c = (directions(places[end[i]] - places[point[two]]) for i in (two, two + 1))
    narrow = point[two][(b * c).sum(axis=1) > np.cos(0.03)]
    return [(a, 0.1) for a in np.flatnonzero(count > 2).tolist()] + [(a, 0.03) for a in narrow.tolist()]


def directions(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True).clip(1e-300)


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
    """1 where the points were moved, as large displacements are drawn as they are. Else the largest displacement is 5% of
    the size, but magnified bodies do not visibly overlap: with the factor w the gap g_0 + n.[[u]] is drawn as
    g_0 + w n.[[u]]."""
    largest = np.linalg.norm(mesh.displacement, axis=1).max()
    if mesh.is_moved or largest == 0.0:
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


def quantity_of(field):
    """What a field measures, for its unit."""
    if field.startswith("displacement"):
        return "length"
    return "stress" if field.startswith(("stress", "von_mises", "principal_stress", "strain_energy")) else ""


class BodyPicture:
    """The deformed bodies of one step, coloured by a field: where they are drawn, the values, and their range."""

    def __init__(self, run, field, step, warp, is_raw=False, range_of_colours=None):
        self.run, self.field, self.step = run, field, step
        self.mesh = mesh = run.mesh(step)
        self.contact = run.contact(step) if step in run.contact_files else None
        self.factor = automatic_warp(mesh, self.contact) if warp == "auto" else warp
        self.deformed = mesh.points + self.factor * mesh.displacement
        values = mesh.field(field)
        # Rigid bodies have no stress; they are grey.
        self.shown = ~mesh.is_rigid if not field.startswith("displacement") else np.ones(len(values), dtype=bool)
        # A zone has an edge, which means would blur.
        self.values = values if is_raw or field == "plastic_zone" else recovered(mesh, values)
        coloured = self.values[self.shown] if self.shown.any() else np.zeros(1)
        self.extremes = coloured.min(), coloured.max()
        self.largest_in_file = values[self.shown].max() if self.shown.any() else 0.0
        self.limits = range_of_colours or limits(coloured)

    @property
    def title(self):
        time = self.run.time_of(self.step)
        words = [f"time {short(time)}"] if time is not None else []
        if self.factor != 1.0:
            words.append(f"displacements times {short(self.factor)}")
        return "\n".join(filter(None, [self.run.title, ", ".join(words)]))

    def draw(self, scale=None, box=None):
        """Figure and axes in 2D; `scale` and `box` (low and high corner) are those of all frames of an animation."""
        scale = scale or self.limits
        if self.mesh.dim == 2:
            figure, axes, colours = draw_2d(self, scale, box)
        else:
            figure, axes, colours = draw_surface(self.mesh, self.deformed, self.values, scale, self.shown, box)
        self.finish(figure, axes, colours)
        return figure

    def draw_section(self):
        section = section_plane(self.mesh, self.contact)
        figure, axes, colours = draw_section(self.mesh, self.deformed, self.values, section, self.limits, self.shown)
        across, *along = sorted(range(3), key=lambda axis: axis != section[0])
        axes.set_xlabel(self.run.units.label("xyz"[along[0]], "length"))
        axes.set_ylabel(self.run.units.label("xyz"[along[1]], "length"))
        self.finish(figure, axes, colours, f", section {'xyz'[across]} = {short(section[1])}")
        return figure

    def finish(self, figure, axes, colours, more=""):
        axes.set_title(self.title + more)
        if not self.shown.any():
            return
        low, high = colours.get_clim()
        label = self.run.units.label(LABELS.get(self.field, self.field.replace("_", " ")), quantity_of(self.field))
        bar = figure.colorbar(colours, ax=axes, label=label, extend=extend(self.extremes, low, high), shrink=0.85, pad=0.02)
        largest = f"max {short(self.extremes[1])}"
        if abs(self.largest_in_file - self.extremes[1]) > 0.01 * abs(self.largest_in_file):
            largest += f"\n(not smoothed\n{short(self.largest_in_file)})"
        bar.ax.set_title(largest, fontsize=9)
        if self.extremes[0] < 0.0:
            bar.ax.set_xlabel(f"min {short(self.extremes[0])}", fontsize=9)


def default_fields(run, step):
    """Von Mises stress and, where something flows, plastic strain; the displacement if neither was written."""
    if not run.body_files:
        return []
    mesh = run.mesh(run.chosen_step(run.body_files, step))
    fields = [name for name in ("von_mises", "plastic_strain") if name in mesh.fields]
    if "plastic_strain" in fields and not mesh.fields["plastic_strain"].any():
        fields.remove("plastic_strain")
    return fields or ["displacement_magnitude"]


def limits(values):
    """Range of the colours: that of all values, or of 99.5% of them where singular corners would hide the rest."""
    low, high = values.min(), values.max()
    usual_low, usual_high = np.percentile(values, [0.25, 99.75])
    if high - low > 1.5 * (usual_high - usual_low):
        low, high = usual_low, usual_high
    if 0.0 <= low < 0.3 * high:
        low = 0.0
    if high - low <= 1e-12 * max(abs(low), abs(high)):
        high, low = high + 1e-9 * (abs(high) or 1.0), low - 1e-9 * (abs(low) or 1.0)
    return low, high


def extend(extremes, low, high):
    """Which ends of the colour bar are exceeded by the values."""
    tolerance = 1e-9 * (high - low)
    return {(False, False): "neither", (False, True): "max", (True, False): "min", (True, True): "both"}[
        (bool(extremes[0] < low - tolerance), bool(extremes[1] > high + tolerance))]


def draw(run, field, step, warp, is_raw=False, range_of_colours=None):
    """Writes bodies_FIELD.png (bodies_FIELD_NNNN.png for a step asked for), in 3D section_FIELD.png too; the paths."""
    if not run.body_files:
        return []
    suffix = "" if step is None else f"_{step:04d}"
    picture = BodyPicture(run, field, run.chosen_step(run.body_files, step), warp, is_raw, range_of_colours)
    paths = [save(picture.draw(), run.directory / f"bodies_{field}{suffix}.png")]
    if picture.mesh.dim == 3:
        paths.append(save(picture.draw_section(), run.directory / f"section_{field}{suffix}.png"))
    return paths


def section_plane(mesh, contact):
    """Axis and position of the section: through the centre of the contact forces, or where bodies are nearest before contact,
    normal to the axis y or, where contact acts along y, x; without contact points through the middle."""
    middle = 0.5 * (mesh.points.min(axis=0) + mesh.points.max(axis=0))
    if contact is None or not len(contact["gap"]):
        return 1, middle[1]
    force = contact["weight"] * contact["pressure"]
    if not force.any():
        force = (np.arange(len(force)) == np.argmin(contact["gap"])).astype(float)
    normal = [np.abs(force @ contact[f"normal_{axis}"]) for axis in "xyz"]
    axis = 0 if np.argmax(normal) == 1 else 1
    return axis, force @ contact["xyz"[axis]] / force.sum()


def draw_2d(picture, scale, box):
    mesh, deformed = picture.mesh, picture.deformed[:, :2]
    figure, axes = figure_for(deformed if box is None else np.stack(box)[:, :2])
    triangles = mesh.triangles()
    coloured = picture.shown[triangles[:, 0]]
    colours = ScalarMappable(Normalize(*scale), "viridis")
    if not coloured.all():
        axes.tripcolor(Triangulation(deformed[:, 0], deformed[:, 1], triangles[~coloured]), np.zeros(len(deformed)),
                       shading="gouraud", cmap=ListedColormap([RIGID]), rasterized=True)
    if coloured.any():
        colours = axes.tripcolor(Triangulation(deformed[:, 0], deformed[:, 1], triangles[coloured]), picture.values,
                                 shading="gouraud", cmap="viridis", vmin=scale[0], vmax=scale[1], rasterized=True)
    lines = [deformed[line] for line in polylines(outline(mesh))]
    axes.add_collection(LineCollection(lines, colors="black", linewidths=0.8, capstyle="round", joinstyle="round"))
    axes.set_xlabel(picture.run.units.label("x", "length"))
    axes.set_ylabel(picture.run.units.label("y", "length"))
    return figure, axes, colours


def body_colour(number):
    return COLOURS[number % len(COLOURS)]
