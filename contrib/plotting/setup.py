"""What "scree --check" set up: bodies, cells, fitted boundaries, contact surfaces."""
import textwrap

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .bodies import body_colour, outline
from .results import BodyMesh, read_table
from .style import COLOURS, RIGID, figure_for, save, short
from .surface import draw_surface


def draw(run):
    """Writes setup.png and returns its path."""
    mesh = run.mesh(0)
    if mesh.dim == 3:
        return draw_3d(run, mesh)
    points = mesh.points[:, :2]
    figure, axes = figure_for(points, extra=3.5)
    handles = draw_cells(axes, mesh, points)
    edges = outline(mesh)
    names = list(run.bodies())
    for number in np.unique(mesh.body[edges[:, 0]]):
        own = edges[mesh.body[edges[:, 0]] == number]
        axes.add_collection(LineCollection(points[own], colors=body_colour(number), linewidths=1.6))
        if names:
            handles.append(Line2D([], [], color=body_colour(number), linewidth=1.6, label=names[number]))
    if not names:
        handles.append(Line2D([], [], color=body_colour(0), linewidth=1.6, label=f"{mesh.body.max() + 1} bodies"))
    handles += draw_conditions(axes, run, mesh, points, edges)
    if run.contact_files:
        handles += draw_contact_surface(figure, axes, run, mesh.size)
    axes.set_xlabel(run.units.label("x", "length"))
    axes.set_ylabel(run.units.label("y", "length"))
    axes.set_title(run.title + ": set-up")
    axes.legend(handles=handles, loc="center left", bbox_to_anchor=(1.01, 0.5))
    return save(figure, run.directory / "setup.png")


def draw_3d(run, mesh):
    """The bodies' surfaces in their colours."""
    names, n_bodies = list(run.bodies()), mesh.body.max() + 1
    cmap = ListedColormap([body_colour(number) for number in range(n_bodies)])
    figure, axes, _ = draw_surface(mesh, mesh.points, mesh.fields["body"], (-0.5, n_bodies - 0.5), cmap=cmap)
    axes.legend(handles=[Patch(color=body_colour(number), label=name) for number, name in enumerate(names)],
                loc="center left", bbox_to_anchor=(1.01, 0.5))
    axes.set_title(run.title + ": set-up")
    return save(figure, run.directory / "setup.png")


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
            shade = ListedColormap(["#f7f7f7", "#e6edf5", "#d2e0ee", "#bcd2e6", "#a6c3dd", "#8fb3d3"])(min(number, 5))
            chosen = quads[level == number]
            axes.add_collection(PolyCollection(points[chosen], facecolors=shade, edgecolors="none"))
            handles.append(Patch(color=shade, label=f"cells of edge {short(size.max() / 2.0**number)}"))
    if len(triangles):
        axes.add_collection(PolyCollection(points[triangles], facecolors="#f6dfb8", edgecolors="none"))
        handles.append(Patch(color="#f6dfb8", label="cut cells"))
    edges = mesh.edges()
    edges = edges[~is_rigid[edges[:, 0]]]
    straight = (np.abs(points[edges[:, 0]] - points[edges[:, 1]]) < 1e-7 * mesh.size).any(axis=1)
    axes.add_collection(LineCollection(points[edges[straight]], colors="#9a9a9a", linewidths=0.25))
    return handles


def draw_conditions(axes, run, mesh, points, edges):
    """Marks where conditions act: fitted boundaries, and the points of regions.csv on cut surfaces."""
    handles, number = [], 0
    file = run.directory / "regions.csv"
    regions = read_table(file) if file.exists() else None
    corners = [np.array([float(v) for v in run.parameters.get(f"Grid/{corner} corner", "nan,nan").split(",")])
               for corner in ("Lower", "Upper")]
    middle = points[edges].mean(axis=1)
    for index, body in enumerate(run.bodies()):
        section = f"Bodies/{body}/Boundary conditions"
        for name in run.names(section):
            places = [place.strip() for place in run.parameters.get(f"{section}/{name}/On", "").split(",")]
            kind = run.parameters.get(f"{section}/{name}/Type", "")
            where = run.parameters.get(f"{section}/{name}/Where", "1")
            colour = COLOURS[(number + 3) % len(COLOURS)]
            if kind == "point support":
                place = [float(value) for value in run.parameters[f"{section}/{name}/Point"].split(",")]
                handles += axes.plot(*place, marker="^", markersize=9, color=colour, linestyle="", clip_on=False,
                                     zorder=4, label=f"{body}, {name}: {kind}")
                number += 1
                continue
            text = f"{body}, {name}: {kind} on {', '.join(places)}" + ("" if where == "1" else f" where {where}")
            handles.append(Line2D([], [], color=colour, linewidth=4, alpha=0.6, label=textwrap.fill(text, 42)))
            for place in places:
                if len(place) == 2 and place[0] in "xy":
                    axis = "xy".index(place[0])
                    plane = corners[place[1] == "+"][axis]
                    own = (mesh.body[edges[:, 0]] == index) & (np.abs(middle[:, axis] - plane) < 1e-6 * mesh.size)
                    axes.add_collection(LineCollection(points[edges[own]], colors=colour, linewidths=5, alpha=0.6))
                elif regions:
                    condition = name if len(places) == 1 else f"{name}.{place}"
                    own = [(b, c) == (body, condition) for b, c in zip(regions["body"], regions["condition"])]
                    axes.plot(np.asarray(regions["x"])[own], np.asarray(regions["y"])[own], "o", markersize=4,
                              color=colour, alpha=0.6, zorder=3)
            number += 1
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
