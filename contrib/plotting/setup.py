"""What "scree --check" set up: bodies, cells, fitted boundaries, contact surfaces."""
import textwrap
from collections import defaultdict

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .bodies import body_colour, outline, section_plane
from .results import BodyMesh
from .style import COLOURS, RIGID, figure_for, save, short
from .surface import CELL_EDGE, draw_section, draw_surface

SHADES = ["#f7f7f7", "#e6edf5", "#d2e0ee", "#bcd2e6", "#a6c3dd", "#8fb3d3"]  # of whole cells, the largest first
CUT = "#f6dfb8"
ROOM = 3.5  # inches for the legend
MOST_NAMES = 12


def draw(run):
    """Writes setup.png, in 3D setup_section.png too; their paths."""
    mesh = run.mesh(0)
    if mesh.dim == 3:
        return draw_3d(run, mesh)
    points = mesh.points[:, :2]
    figure, axes = figure_for(points, extra=ROOM)
    handles = draw_cells(axes, mesh, points)
    edges = outline(mesh)
    edges = edges[np.argsort(mesh.body[edges[:, 0]], kind="stable")]
    colours = [body_colour(number) for number in mesh.body[edges[:, 0]]]
    axes.add_collection(LineCollection(points[edges], colors=colours, linewidths=1.6))
    handles += [Line2D([], [], color=colour, linewidth=1.6, label=label) for colour, label in labels_of_bodies(mesh)]
    handles += draw_conditions(axes, run, mesh, points, edges)
    if run.contact_files:
        handles += draw_contact_surface(figure, axes, run, mesh.size)
    axes.set_xlabel(run.units.label("x", "length"))
    axes.set_ylabel(run.units.label("y", "length"))
    axes.set_title(run.title + ": set-up")
    axes.legend(handles=handles, loc="center left", bbox_to_anchor=(1.01, 0.5))
    return [save(figure, run.directory / "setup.png")]


def draw_3d(run, mesh):
    """The bodies' surfaces in their colours with the cells and where conditions act, and a section with the sizes of the cells."""
    n_bodies, conditions = mesh.body.max() + 1, list(conditions_of(run, mesh))

    def marks(centres, bodies):
        return [(points, condition.colour) for condition in conditions for points in condition.places(run, mesh, centres, bodies)]

    cells, level, largest = whole_cells(mesh)
    cmap = ListedColormap([body_colour(number) for number in range(n_bodies)])
    figure, axes, _ = draw_surface(mesh, mesh.points, mesh.fields["body"], (-0.5, n_bodies - 0.5), cmap=cmap, cells=cells, marks=marks,
                                   extra=ROOM)
    handles = [Patch(color=colour, label=label) for colour, label in labels_of_bodies(mesh)]
    axes.legend(handles=handles + [condition.handle() for condition in conditions], loc="center left", bbox_to_anchor=(1.01, 0.5))
    axes.set_title(run.title + ": set-up")
    paths = [save(figure, run.directory / "setup.png")]

    section = section_plane(mesh, run.contact(0) if run.contact_files else None)
    figure, axes, _ = draw_section(mesh, mesh.points, level, section, (-1.5, len(SHADES) - 0.5), ~mesh.is_rigid,
                                   ListedColormap([CUT, *SHADES]), cells, extra=ROOM)
    handles = [Patch(color=SHADES[number], label=f"cells of edge {short(largest / 2.0**number)}")
               for number in np.unique(level[(level >= 0) & ~mesh.is_rigid])]
    axes.legend(handles=handles + [Patch(color=CUT, label="cut cells")], loc="center left", bbox_to_anchor=(1.01, 0.5))
    kept = [axis for axis in range(3) if axis != section[0]]
    axes.set_xlabel(run.units.label("xyz"[kept[0]], "length"))
    axes.set_ylabel(run.units.label("xyz"[kept[1]], "length"))
    axes.set_title(f"{run.title}: set-up, section {'xyz'[section[0]]} = {short(section[1])}")
    return paths + [save(figure, run.directory / "setup_section.png")]


def labels_of_bodies(mesh):
    """Colours and names of the bodies for a legend; of many only how many."""
    if len(mesh.names) > MOST_NAMES:
        return [(body_colour(0), f"{len(mesh.names)} bodies")]
    return [(body_colour(number), name) for number, name in enumerate(mesh.names)]


def whole_cells(mesh):
    """For each point of 3D the number of its cell (-1: of a cut cell) and its shade; and the edge of the largest whole cell."""
    cells, level = np.full(len(mesh.points), -1), np.full(len(mesh.points), -1)
    hexahedra = mesh.cells_of(BodyMesh.hexahedron)
    if len(hexahedra) == 0:
        return cells, level, 0.0
    cells[hexahedra] = np.arange(len(hexahedra))[:, None]
    edge = np.ptp(mesh.points[hexahedra][:, :, 0], axis=1)
    largest = edge[~mesh.is_rigid[hexahedra[:, 0]]].max(initial=0.0) or edge.max()
    level[hexahedra] = np.rint(np.log2(largest / edge)).astype(int).clip(0, len(SHADES) - 1)[:, None]
    cells[mesh.is_rigid] = -1
    return cells, level, largest


def draw_cells(axes, mesh, points):
    """Whole cells of deformable bodies by size, cut cells in one colour, cell edges (without the diagonals of cut cells); rigid
    bodies, which have no cells, grey."""
    handles = []
    quads, triangles = (mesh.cells_of(kind) for kind in (BodyMesh.quadrilateral, BodyMesh.triangle))
    is_rigid = mesh.is_rigid
    for cells in (quads, triangles):
        if len(cells):
            axes.add_collection(PolyCollection(points[cells[is_rigid[cells[:, 0]]]], facecolors=RIGID, edgecolors="face"))
    quads, triangles = quads[~is_rigid[quads[:, 0]]], triangles[~is_rigid[triangles[:, 0]]]
    if len(quads):
        size = np.ptp(points[quads][:, :, 0], axis=1)
        level = np.rint(np.log2(size.max() / size)).astype(int)
        for number in np.unique(level):
            shade = SHADES[min(number, len(SHADES) - 1)]
            chosen = quads[level == number]
            axes.add_collection(PolyCollection(points[chosen], facecolors=shade, edgecolors="none"))
            handles.append(Patch(color=shade, label=f"cells of edge {short(size.max() / 2.0**number)}"))
    if len(triangles):
        axes.add_collection(PolyCollection(points[triangles], facecolors=CUT, edgecolors="none"))
        handles.append(Patch(color=CUT, label="cut cells"))
    edges = mesh.edges()
    edges = edges[~is_rigid[edges[:, 0]]]
    straight = (np.abs(points[edges[:, 0]] - points[edges[:, 1]]) < 1e-7 * mesh.size).any(axis=1)
    axes.add_collection(LineCollection(points[edges[straight]], colors=CELL_EDGE, linewidths=0.25))
    return handles


class Condition:
    """A boundary condition of a body or a family, of numbers `own`, as it is drawn."""

    def __init__(self, run, own, body, name, colour):
        section = f"Bodies/{body}/Boundary conditions/{name}"
        self.own, self.body, self.name, self.colour = own, body, name, colour
        self.on = [place.strip() for place in run.parameters.get(f"{section}/On", "").split(",")]
        self.kind = run.parameters.get(f"{section}/Type", "")
        self.where = run.parameters.get(f"{section}/Where", "1")
        self.point = [float(value) for value in run.parameters.get(f"{section}/Point", "").split(",") if value.strip()]

    @property
    def is_point(self):
        return self.kind == "point support"

    def handle(self):
        if self.is_point:
            return Line2D([], [], marker="^", markersize=9, color=self.colour, linestyle="",
                          label=f"{self.body}, {self.name}: {self.kind}")
        text = f"{self.body}, {self.name}: {self.kind} on {', '.join(self.on)}" + ("" if self.where == "1" else f" where {self.where}")
        return Line2D([], [], color=self.colour, linewidth=4, alpha=0.6, label=textwrap.fill(text, 42))

    def on_plane(self, run, place, mesh, centres, bodies):
        """Which parts of the outline (their centres and bodies) lie on a face of the grid, as x- or z+."""
        axis = "xyz".index(place[0])
        plane = run.box[place[1] == "+"][axis]
        return np.isin(bodies, self.own) & (np.abs(centres[:, axis] - plane) < 1e-6 * mesh.size)

    def on_surface(self, run, place):
        """The points of regions.csv (n, dim)."""
        if not run.regions:
            return np.empty((0, run.dimension))
        condition = self.name if len(self.on) == 1 else f"{self.name}.{place}"
        rows = run.rows_of_regions.get((self.body, condition), [])
        return np.stack([np.asarray(run.regions[axis])[rows] for axis in "xyz"[:run.dimension]], axis=1)

    def places(self, run, mesh, centres, bodies):
        """Points of 3D where it acts: of every part of the outline on a face of the grid, of a region, or its point."""
        if self.is_point:
            return [np.array([self.point])]
        return [centres[self.on_plane(run, place, mesh, centres, bodies)] if is_plane(place) else self.on_surface(run, place)
                for place in self.on]


def is_plane(place):
    return len(place) == 2 and place[0] in "xyz" and place[1] in "-+"


def conditions_of(run, mesh):
    """All boundary conditions, each in a colour."""
    number, own = 3, defaultdict(list)
    for index, name in enumerate(mesh.names):
        own[run.section_of(name)].append(index)
    for body in run.names("Bodies"):
        for name in run.names(f"Bodies/{body}/Boundary conditions"):
            yield Condition(run, own[body], body, name, COLOURS[number % len(COLOURS)])
            number += 1


def draw_conditions(axes, run, mesh, points, edges):
    """Marks where conditions act: fitted boundaries, and the points of regions.csv on cut surfaces."""
    handles = []
    centres, bodies = points[edges].mean(axis=1), mesh.body[edges[:, 0]]
    for condition in conditions_of(run, mesh):
        handles.append(condition.handle())
        if condition.is_point:
            axes.plot(*condition.point, marker="^", markersize=9, color=condition.colour, linestyle="", clip_on=False, zorder=4)
            continue
        for place in condition.on:
            if is_plane(place):
                own = condition.on_plane(run, place, mesh, centres, bodies)
                axes.add_collection(LineCollection(points[edges[own]], colors=condition.colour, linewidths=5, alpha=0.6))
            else:
                axes.plot(*condition.on_surface(run, place).T, "o", markersize=4, color=condition.colour, alpha=0.6, zorder=3)
    return handles


def draw_contact_surface(figure, axes, run, size):
    """Contact points coloured by the initial gap; its legend if there is no gap at all."""
    contact = run.contact(0)
    gap = contact["gap"]
    if len(gap) == 0:
        return []
    if np.abs(gap).max() < 1e-7 * size:
        axes.plot(contact["x"], contact["y"], ".", markersize=4, color="#0d0887", zorder=3)
        return [Line2D([], [], color="#0d0887", marker=".", linestyle="", label="contact points, no initial gap")]
    dots = axes.scatter(contact["x"], contact["y"], c=gap, s=9, cmap="plasma", zorder=3, linewidths=0)
    figure.colorbar(dots, ax=axes, label=run.units.label("initial gap at the contact points", "length"),
                    orientation="horizontal", shrink=0.6, aspect=40, pad=0.02)
    return []
