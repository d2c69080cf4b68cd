"""A packing as an assembly: force chains over the grains, the rose of its contacts, and macroscopic curves."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation
from matplotlib.colors import ListedColormap

from .bodies import outline
from .results import read_table
from .style import COLOURS, RIGID, figure_for, save, short

GRAIN = "#eef0f2"
WIDEST = 7.0  # points, of the largest force
FEWEST = 3    # grains; fewer are no packing


def draw(run, step):
    """Writes chains.png and rose.png of 2D (NAME_NNNN.png for a step asked for) and assembly.png of a packing; their paths."""
    path = run.directory / "assembly.csv"
    if not path.exists():
        return []
    table = read_table(path)
    if table["grains"].max(initial=0) < FEWEST:
        return []
    pictures = []
    if run.dimension == 2 and run.body_files:
        number = run.chosen_step(run.body_files, step)
        contacts = contacts_of(run, number)
        suffix = "" if step is None else f"_{step:04d}"
        if len(contacts["force"]):
            pictures.append(save(chains(run, number, contacts), run.directory / f"chains{suffix}.png"))
        if (~contacts["at_wall"]).any():
            pictures.append(save(rose(run, number, contacts), run.directory / f"rose{suffix}.png"))
    return pictures + [draw_curves(run, table)]


def contacts_of(run, step):
    """The contacts of a step that carry a force: its normal part, normals (n, 2), whether a rigid body takes part, and the
    lines from the centroids of deformable bodies to the place (m, 2, 2) with the numbers of their contacts."""
    grains, table = (read_table(run.directory / name) for name in ("grains.csv", "contacts.csv"))
    now = grains["step"] == step
    moved = 0.0 if run.is_moving else 1.0
    centroids = np.stack([grains[f"position_{axis}"] - moved * grains[f"displacement_{axis}"] for axis in "xy"], axis=1)
    centroid = dict(zip(grains["body"][now], centroids[now]))
    rigid = dict(zip(grains["body"][now], np.isnan(grains["stress_xx"][now])))
    loaded = (table["step"] == step) & (table["normal_force"] > 1e-6 * np.nanmax(table["normal_force"], initial=0.0))
    loaded &= np.isfinite(table["place_x"])
    place, normal = (np.stack([table[f"{name}_{axis}"] for axis in "xy"], axis=1)[loaded] for name in ("place", "normal"))
    bodies = [table[f"body_{side}"][loaded] for side in "ab"]
    lines = [(number, (centroid[body], place[number])) for side in bodies for number, body in enumerate(side) if not rigid[body]]
    return {"force": table["normal_force"][loaded], "normal": normal,
            "at_wall": np.array([rigid[a] or rigid[b] for a, b in zip(*bodies)], dtype=bool),
            "line_of": np.array([number for number, _ in lines], dtype=int), "lines": np.array([line for _, line in lines])}


def chains(run, step, contacts):
    """The grains, and over them lines along the branch vectors, wide and dark where forces are large."""
    mesh = run.mesh(step)
    points = (mesh.points + (mesh.displacement if mesh.is_moved else 0.0))[:, :2]
    grains = mesh.cell_points(~mesh.is_rigid)
    low, high = points[grains].min(axis=0), points[grains].max(axis=0)
    room = 0.06 * (high - low).max()
    figure, axes = figure_for(np.stack([low - room, high + room]))
    triangles = mesh.triangles()
    for rigid, colour in ((True, RIGID), (False, GRAIN)):
        chosen = triangles[mesh.is_rigid[triangles[:, 0]] == rigid]
        if len(chosen):
            axes.tripcolor(Triangulation(*points.T, chosen), np.zeros(len(points)), shading="gouraud",
                           cmap=ListedColormap([colour]), rasterized=True)
    axes.add_collection(LineCollection(points[outline(mesh)], colors="#8a8f96", linewidths=0.7, capstyle="round"))
    order = np.argsort(contacts["force"][contacts["line_of"]])
    force = contacts["force"][contacts["line_of"]][order]
    drawn = LineCollection(contacts["lines"][order], linewidths=WIDEST * force / force.max(), array=force, cmap="inferno_r",
                           capstyle="round", zorder=3)
    drawn.set_clim(-0.15 * force.max(), force.max())  # without the palest colours
    axes.add_collection(drawn)
    axes.set_xlabel(run.units.label("x", "length"))
    axes.set_ylabel(run.units.label("y", "length"))
    axes.set_title(title(run, step, "force chains"))
    bar = figure.colorbar(drawn, ax=axes, label=run.units.label("normal force, as the width", "force"), shrink=0.85, pad=0.02)
    bar.ax.set_ylim(0.0, force.max())
    bar.ax.set_title(f"max {short(force.max())}", fontsize=9)
    return figure


def rose(run, step, contacts):
    """Directions of the contacts between grains, by number and by force: the part of each sector over that of an equal
    distribution, and the ellipse-like curve 1 + 4 (F - I/2) : n n of the fabric tensor."""
    inner = ~contacts["at_wall"]
    normal, force = contacts["normal"][inner], contacts["force"][inner]
    n_sectors = 2 * int(np.clip(len(force) // 8, 3, 9))  # in half a turn, some around both axes
    edges = np.linspace(0.0, np.pi, n_sectors + 1) - 0.5 * np.pi / n_sectors
    angle = (np.arctan2(normal[:, 1], normal[:, 0]) - edges[0]) % np.pi + edges[0]
    around = np.linspace(0.0, 2.0 * np.pi, 361)
    direction = np.stack([np.cos(around), np.sin(around)], axis=1)
    figure, panels = plt.subplots(1, 2, figsize=(10.0, 5.4), subplot_kw={"projection": "polar"})
    for panel, weight, colour, name in zip(panels, (np.ones(len(force)), force), COLOURS,
                                           (f"by number, {len(force)} contacts", "by normal force")):
        part = np.histogram(angle, edges, weights=weight)[0] / weight.sum() * n_sectors
        centre = 0.5 * (edges[1:] + edges[:-1])
        panel.bar(np.concatenate([centre, centre + np.pi]), np.tile(part, 2), width=np.pi / n_sectors, color=colour, alpha=0.55,
                  edgecolor="white", linewidth=0.6)
        fabric = np.einsum("c,ci,cj->ij", weight, normal, normal) / weight.sum()
        panel.plot(around, 1.0 + 4.0 * (np.einsum("ai,ij,aj->a", direction, fabric, direction) - 0.5), color="black",
                   linewidth=1.3, label="of the fabric tensor")
        panel.set_rticks(np.arange(1.0, np.ceil(part.max()) + 0.5))
        panel.set_title(name)
        panel.legend(loc="lower center", bbox_to_anchor=(0.5, -0.17))
    figure.suptitle(title(run, step, "contact directions over an equal distribution"))
    return figure


def draw_curves(run, table):
    """Writes assembly.png: stress, porosity, coordination and friction over time, with lines where a stage ends; nothing for a single
    step."""
    if len(table["time"]) < 2:
        return None
    figure, panels = plt.subplots(2, 2, figsize=(11.0, 7.4), sharex=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(table["p"] > 0.0, table["q"] / table["p"], np.nan)
    curves = ((run.units.label("stress", "stress"), {"p": table["p"], "q": table["q"]}),
              ("porosity", {"porosity": table["porosity"]}),
              ("coordination number", {"all grains": table["coordination"], "without rattlers": table["mechanical_coordination"]}),
              ("ratio", {"q/p": ratio, "mobilised friction": table["mobilised_friction"]}))
    for panel, (label, values) in zip(panels.ravel(), curves):
        for name, curve in values.items():
            panel.plot(table["time"], curve, marker="o" if len(curve) < 30 else "", markersize=4, label=name)
        for time in ends_of_stages(table):
            panel.axvline(time, color="0.6", linewidth=0.8, zorder=0)
        panel.set_ylabel(label)
        panel.ticklabel_format(axis="y", useOffset=False)
        if len(values) > 1:
            panel.legend()
    for panel in panels[1]:
        panel.set_xlabel("time")
    figure.suptitle(run.title)
    return save(figure, run.directory / "assembly.png")


def ends_of_stages(table):
    """Times at which a stage ends and another one follows."""
    return table["time"][:-1][np.diff(table["stage"]) > 0] if "stage" in table else []


def title(run, step, words):
    time = run.time_of(step)
    return run.title + "\n" + words + (f", time {short(time)}" if time is not None else "")
