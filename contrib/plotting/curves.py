"""Curves: tractions along contact surfaces, and the history."""
import matplotlib.pyplot as plt
import numpy as np

from .recovery import smoothed
from .results import ResultsError
from .style import COLOURS, save, short

MAX_PANELS = 6
MAX_CURVES = 12
JUMP = 6.0  # of points along a surface, in median distances: another piece of it begins


def position_along(table):
    """A coordinate along a contact surface of 2D and its label: x or y of a nearly flat surface, else the arc
    length along the chain of points."""
    x, y = table["x"], table["y"]
    normals = np.stack([table["normal_x"], table["normal_y"]], axis=1)
    mean = normals.mean(axis=0)
    length = np.linalg.norm(mean)
    if length > 0.0 and (normals @ mean / length).min() > 0.5:
        for component, (values, label) in enumerate(((x, "x"), (y, "y"))):
            if abs(mean[component]) / length < 0.35:
                return values, label
        tangent = np.array([mean[1], -mean[0]]) / length
        tangent *= np.sign(tangent[np.argmax(np.abs(tangent))])
        along = x * tangent[0] + y * tangent[1]
        return along - along.min(), "position along the surface"
    return arc_length(np.stack([x, y], axis=1)), "arc length"


def arc_length(points):
    """Arc length of scattered points of a curve, each joined to the nearest one not yet visited, from an end if it has one."""
    order, steps = walk(points, int(np.argmin(points[:, 0])))
    if len(steps) and steps.max() > JUMP * np.median(steps):
        order, steps = walk(points, order[np.argmax(steps)])
    position = np.zeros(len(points))
    position[order[1:]] = np.cumsum(steps)
    return position


def walk(points, start):
    """The points in the order of a walk to the nearest one not yet visited, and the lengths of its steps."""
    left = np.ones(len(points), dtype=bool)
    order, steps = [start], []
    for _ in range(len(points) - 1):
        left[order[-1]] = False
        remaining = np.flatnonzero(left)
        distance = np.linalg.norm(points[remaining] - points[order[-1]], axis=1)
        nearest = int(np.argmin(distance))
        steps.append(distance[nearest])
        order.append(int(remaining[nearest]))
    return np.array(order), np.array(steps)


def with_breaks(position, *curves):
    """The sorted positions and curves over them, with NaN where neighbours are far apart: lines end there."""
    steps = np.diff(position)
    far = np.flatnonzero(steps > JUMP * np.median(steps)) + 1 if len(steps) else []
    return [np.insert(values.astype(float), far, np.nan) for values in (position, *curves)]


def draw_contact(run, step, references, pairs=None):
    """Writes contact.png (contact_NNNN.png for a step asked for) and returns its path; `pairs`: only these."""
    if not run.contact_files:
        return None
    name = "contact.png" if step is None else f"contact_{step:04d}.png"
    step = run.chosen_step(run.contact_files, step)
    table = run.contact(step)
    if len(table["pair"]) == 0:
        return None
    friction = run.friction_coefficients()
    names, left_out = pairs_to_draw(table, pairs)
    if not names:
        return None
    if not table["pressure"].any():
        time = run.time_of(step)
        print(f"contact: no bodies touch{'' if time is None else f' at time {short(time)}'}: no contact.png (--step N draws others)")
        return None
    n_columns = 1 if len(names) == 1 else 2
    n_rows = -(-len(names) // n_columns)
    figure, panels = plt.subplots(n_rows, n_columns, squeeze=False,
                                  figsize=(7.5 if n_columns == 1 else 12, 4.6 * n_rows + (0.4 if left_out else 0.0)))
    for panel in panels.ravel()[len(names):]:
        panel.set_visible(False)
    for pair, panel in zip(names, panels.ravel()):
        chosen = table["pair"] == pair
        draw_pair(panel, {key: values[chosen] for key, values in table.items()}, friction[pair],
                  references, run)
        panel.set_title(pair, pad=14.0)
    if run.dimension == 3 and len(names) == 1:
        shape = np.ptp(panels[0, 0].get_xlim()) / np.ptp(panels[0, 0].get_ylim())
        figure.set_figwidth(min(max(3.6 * shape + 2.2, 5.5), 7.5))
    time = run.time_of(step)
    figure.suptitle(run.title + (f", time {short(time)}" if time is not None else ""))
    if left_out:
        figure.supxlabel(left_out, fontsize=9, wrap=True)
        print(f"contact: {left_out} (--pair NAME draws others)")
    return save(figure, run.directory / name)


def pairs_to_draw(table, asked):
    """The pairs with the largest forces, or those asked for, in the order of the table, and which are left out, in words."""
    names = list(dict.fromkeys(table["pair"]))
    for name in asked or []:
        if name not in names:
            raise ResultsError(f"--pair {name}: there is no such pair in this step, but: {', '.join(names)}")
    if asked:
        return [name for name in names if name in asked], ""
    force = {name: np.sum((table["weight"] * table["pressure"])[table["pair"] == name]) for name in names}
    drawn = sorted(names, key=lambda name: -force[name])[:MAX_PANELS]
    closed = [name for name in names if name not in drawn and force[name] > 0.0]
    n_open = len(names) - len(drawn) - len(closed)
    words = [f"{len(closed)} more pairs in contact: {listed(closed)}"] if closed else []
    words += [f"{n_open} more pairs without contact"] if n_open else []
    return [name for name in names if name in drawn], "not drawn: " + "; ".join(words) if words else ""


def listed(names, most=8):
    return ", ".join(names[:most]) + (f" and {len(names) - most} others" if len(names) > most else "")


def cell_means(position, table):
    """Sorted positions, pressures and tangential tractions: means of the cells, at the mean positions of their points."""
    pressure, tau = table["cell_pressure"], np.hypot(table["cell_tau_x"], table["cell_tau_y"])
    values = np.stack([pressure, table["cell_tau_x"], table["cell_tau_y"]], axis=1)
    same = (values[1:] == values[:-1]).all(axis=1) & (values[1:] != 0.0).any(axis=1)
    cell = np.concatenate([[0], np.cumsum(~same)])
    return [np.bincount(cell, of_points) / np.bincount(cell) for of_points in (position, pressure, tau)]


def has_means(table, run):
    """Whether tractions are drawn as means of cells."""
    return run.parameters.get("Discretization/Degree", "1") == "1" and "cell_pressure" in table


def draw_pair(panel, table, friction, references, run):
    """Tractions over the surface; in degree 1 lines of means of the cells, for those of points saw-tooth, and faint points."""
    units = run.units
    if "z" in table:
        draw_pair_3d(panel, table, run)
        return
    position, label = position_along(table)
    order = np.argsort(position, kind="stable")
    position, pressure = position[order], table["pressure"][order]
    tau = np.hypot(table["tau_x"], table["tau_y"])[order]
    along, pressures, tractions = position, pressure, tau
    if has_means(table, run):
        for number, values in enumerate((pressure, tau)):
            panel.plot(position, values, ".", markersize=2, color=COLOURS[number], alpha=0.35)
        along, pressures, tractions = cell_means(position, {key: values[order] for key, values in table.items()})
    along, pressures, tractions = with_breaks(along, pressures, tractions)
    panel.plot(along, pressures, ".-", markersize=4, color=COLOURS[0], label="pressure p")
    if tau.max() > 0.0:
        panel.plot(along, tractions, ".-", markersize=4, color=COLOURS[1], label=r"tangential traction $|\tau|$")
    if np.isfinite(friction) and friction > 0.0:
        panel.plot(along, friction * pressures, "--", linewidth=1, color="#707070",
                   label=rf"limit of friction $\mu p$, $\mu$ = {short(friction)}")
    for number, curve in enumerate(references):
        panel.plot(curve.x, curve.y, linestyle=["-", "--", ":", "-."][number % 4], color="black", linewidth=1,
                   label=curve.label)
    closed = table["status"][order] > 0
    if closed.any():
        low, high = position[closed].min(), position[closed].max()
        margin = max(0.35 * (high - low), 1e-9)
        panel.set_xlim(max(position.min(), low - margin) - 0.02 * (high - low),
                       min(position.max(), high + margin) + 0.02 * (high - low))
    top, peak = upper_limit(table), max(pressure.max(), tau.max())
    panel.set_ylim(bottom=min(0.0, pressure.min()), top=top)
    if peak > top:
        panel.annotate(f"up to {short(peak)}", (1.0, 1.0), xycoords="axes fraction", ha="right", va="bottom",
                       fontsize=9)
    panel.set_xlabel(units.label(label, "length"))
    panel.set_ylabel(units.label("traction", "stress"))
    panel.legend(loc="upper center", ncol=2)


def upper_limit(table):
    """Room for the curves and the legend; peaks at corners that rise far above 95% of the surface are cut off."""
    traction = np.maximum(table["pressure"], np.hypot(table["tau_x"], table["tau_y"]))
    closed = np.flatnonzero(table["status"] > 0)
    if not closed.size or traction.max() <= 0.0:
        return 1.0
    order = closed[np.argsort(traction[closed])]
    covered = np.cumsum(table["weight"][order])
    usual = traction[order[np.searchsorted(covered, 0.95 * covered[-1])]]
    return 1.3 * traction.max() if traction.max() < 4.0 * usual else 3.0 * usual


def draw_pair_3d(panel, table, run):
    """The pressure over the contact surface, smoothed over a cell and in degree 1 of means, seen along its mean normal where there is contact, and
    arrows of the tangential traction. Parts that face away are not seen; how many is told."""
    normals = np.stack([table[f"normal_{axis}"] for axis in "xyz"], axis=1)
    mean = normals.mean(axis=0)
    kept = [axis for axis in range(3) if axis != int(np.argmax(np.abs(mean)))]
    points = np.stack([table["xyz"[axis]] for axis in kept], axis=1)
    is_closed = table["status"] > 0 if (table["status"] > 0).any() else np.full(len(points), True)
    cell = cell_edge(table)
    low, high = points[is_closed].min(axis=0), points[is_closed].max(axis=0)
    # Contact at a point or two is seen with the points around it.
    margin = max(0.15 * (high - low).max(), 2.0 * cell)
    lower, upper = run.box
    low, high = np.maximum(low - margin, lower[kept]), np.minimum(high + margin, upper[kept])
    seen = normals @ mean > 0.2 * np.linalg.norm(mean)
    near = ((points > low - 2.0 * cell) & (points < high + 2.0 * cell)).all(axis=1) & seen
    # In degree 1 the means of cells, for the pressures of points saw-tooth.
    column = "cell_pressure" if has_means(table, run) else "pressure"
    image, extent = smoothed(points[near], table["weight"][near], table[column][near], cell, 0.5 * cell, low, high)
    colours = panel.imshow(image.clip(0.0), extent=extent, origin="lower", cmap="viridis", interpolation="bilinear", vmin=0.0)
    tau = np.stack([table[f"tau_{'xyz'[axis]}"] for axis in kept], axis=1)
    arrows = np.flatnonzero((np.linalg.norm(tau, axis=1) > 0.0) & near)
    if arrows.size:
        arrows = arrows[::max(1, len(arrows) // 400)]
        panel.quiver(*points[arrows].T, *tau[arrows].T, color="white", width=0.002)
    panel.set_aspect("equal")
    panel.grid(False)
    panel.set_xlabel(run.units.label("xyz"[kept[0]], "length"))
    panel.set_ylabel(run.units.label("xyz"[kept[1]], "length"))
    told = "means of cells, smoothed" if has_means(table, run) else "p is smoothed over a cell"
    told += ", arrows: tangential traction" if arrows.size else ""
    panel.annotate(told, (0.0, 1.0), xycoords="axes fraction", va="bottom", fontsize=8)
    bar = panel.figure.colorbar(colours, ax=panel, label=run.units.label("pressure p", "stress"), shrink=0.85)
    bar.ax.set_title(f"max {short(np.nanmax(image, initial=0.0))}", fontsize=9, loc="left")
    behind = np.sum(table["weight"][~seen & (table["status"] > 0)]) / max(np.sum(table["weight"][table["status"] > 0]), 1e-300)
    if behind > 0.005:
        panel.annotate(f"{100.0 * behind:.0f} % of the contact faces away and is not seen", (0.02, 0.98),
                       xycoords="axes fraction", va="top", fontsize=8, color="white")


def cell_edge(table):
    """The edge of the cells in contact: the root of the largest area of points with the same mean pressure of their cell."""
    _, cell = np.unique(table["cell_pressure"], return_inverse=True)
    areas = np.bincount(cell, np.where(table["cell_pressure"] > 0.0, table["weight"], 0.0))
    return np.sqrt(max(areas.max(initial=0.0), table["weight"].max()))


def draw_history(run):
    """Writes history.png: forces of the pairs and the boundary conditions, open, stick and slip lengths, energies."""
    if not run.has_history:
        return None
    history = run.history()
    time = history["time"]
    if len(time) == 0:
        return None
    pairs = [name[:-len(".minimum_gap")] for name in history if name.endswith(".minimum_gap")]
    forces = [name for name in history if ".force_" in name]
    groups = {
        "Contact forces on the second body": [n for n in forces if n.split(".force_")[0] in pairs],
        "Forces of boundary conditions": [n for n in forces if n.split(".force_")[0] not in pairs],
        "Contact surface": [f"{pair}.{status}" for pair in pairs for status in ("stick", "slip")],
        "Energies": [name for name in history if name.startswith("energy.")]}
    quantities = {"Contact surface": ("length" if run.dimension == 2 else "area", "area"), "Energies": ("energy", "energy")}
    groups = {title: visible(history, names) for title, names in groups.items()}
    groups = {title: found for title, found in groups.items() if found[0]}
    if not groups:
        return None
    figure, panels = plt.subplots(-(-len(groups) // 2), 2, squeeze=False, figsize=(13, 3.9 * -(-len(groups) // 2)))
    for panel in panels.ravel()[len(groups):]:
        panel.set_visible(False)
    for (title, (names, n_left_out)), panel in zip(groups.items(), panels.ravel()):
        labels = [name.replace("energy.", "").replace(".force_", ", ").replace(".", ", ").replace("_", " ")
                  for name in names]
        quantity = run.units.label(*quantities.get(title, ("force", "force")))
        if len(time) == 1:
            draw_bars(panel, labels, [history[name][0] for name in names], quantity)
        else:
            # Before the first step nothing is loaded, unless bodies overlap.
            starts_at_zero = title != "Contact surface" and run.starts_unloaded()
            draw_lines(panel, time, labels, [history[name] for name in names], quantity, starts_at_zero)
        panel.set_title(title + (f" ({n_left_out} smaller ones not drawn)" if n_left_out else ""))
    figure.suptitle(run.title)
    return save(figure, run.directory / "history.png")


def draw_force_displacement(run):
    """Writes force_displacement.png: what boundary conditions and rigid bodies do against what they move, component by
    component; nothing if nothing moves."""
    if not run.has_history:
        return None
    history = run.history()
    owners = [name[:-len(".displacement_x")] for name in history if name.endswith(".displacement_x")]
    curves = {}
    for owner in owners:
        for axis in "xyz":
            names = f"{owner}.displacement_{axis}", f"{owner}.force_{axis}"
            if all(name in history and len(history[name]) for name in names):
                curves[f"{owner.replace('.', ', ')}, {axis}"] = tuple(history[name] for name in names)
    largest = [max((np.abs(curve[i]).max() for curve in curves.values()), default=0.0) for i in (0, 1)]
    curves = {label: curve for label, curve in curves.items()
              if all(np.abs(curve[i]).max() > 1e-4 * largest[i] > 0.0 for i in (0, 1))}
    if not curves:
        return None
    left_out = len(curves) - MAX_CURVES
    kept = sorted(curves, key=lambda label: -np.ptp(curves[label][0]) * np.abs(curves[label][1]).max())[:MAX_CURVES]
    figure, panel = plt.subplots(figsize=(8.5, 4.8))
    zero = [0.0] if run.starts_unloaded() else []
    for label, (motion, force) in ((label, curves[label]) for label in curves if label in kept):
        panel.plot([*zero, *motion], [*zero, *force], marker="o" if len(motion) < 30 else "", markersize=4, label=label)
    panel.set_xlabel(run.units.label("mean displacement since the start", "length"))
    panel.set_ylabel(run.units.label("force on the body", "force"))
    panel.ticklabel_format(axis="both", scilimits=(-3, 4))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    panel.set_title(run.title + (f"\n{left_out} curves with less work not drawn" if left_out > 0 else ""))
    return save(figure, run.directory / "force_displacement.png")


def draw_lines(panel, time, labels, curves, quantity, starts_at_zero):
    zero = [0.0] if starts_at_zero else []
    for number, (label, curve) in enumerate(zip(labels, curves)):
        dashed = label == "external work"  # often on top of the strain energy
        panel.plot([*zero, *time], [*zero, *curve], linestyle=["--" if dashed else "-", "--", ":"][number // len(COLOURS) % 3],
                   marker="o" if len(time) < 30 else "", markersize=4, label=label)
    panel.set_xlim(left=min(0.0, time[0]))
    panel.set_xlabel("time")
    panel.set_ylabel(quantity)
    panel.ticklabel_format(axis="y", scilimits=(-3, 4))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def draw_bars(panel, labels, values, quantity):
    """A single step: a bar for each value."""
    places = np.arange(len(labels))
    panel.barh(places, values, height=0.6, color=[COLOURS[place % len(COLOURS)] for place in places])
    for place, value in zip(places, values):
        panel.annotate(short(value), (value, place), xytext=(4 if value >= 0.0 else -4, 0), va="center", fontsize=9,
                       textcoords="offset points", ha="left" if value >= 0.0 else "right")
    panel.set_yticks(places, labels)
    panel.set_ylim(max(len(labels), 4) - 0.5, -0.5)
    panel.margins(x=0.2, y=0)
    panel.axvline(0.0, color="black", linewidth=0.8)
    panel.set_xlabel(quantity)


def visible(history, names):
    """The curves that are not zero beside the largest of them, at most MAX_CURVES, and how many are left out."""
    sizes = {name: np.abs(np.nan_to_num(history[name])).max() for name in names}
    largest = max(sizes.values(), default=0.0)
    kept = [name for name in names if sizes[name] > 1e-9 * largest]
    drawn = sorted(sorted(kept, key=lambda name: -sizes[name])[:MAX_CURVES], key=names.index)
    return drawn, len(kept) - len(drawn)
