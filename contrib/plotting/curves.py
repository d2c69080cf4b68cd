"""Curves: tractions along contact surfaces, and the history."""
import matplotlib.pyplot as plt
import numpy as np

from .style import COLOURS, save, short

MAX_PANELS = 6


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
    """Arc length of scattered points of a curve, each joined to the nearest one not yet visited."""
    n = len(points)
    left = np.ones(n, dtype=bool)
    current = int(np.argmin(points[:, 0]))
    position, total = np.zeros(n), 0.0
    for _ in range(n - 1):
        left[current] = False
        remaining = np.flatnonzero(left)
        distance = np.linalg.norm(points[remaining] - points[current], axis=1)
        nearest = int(np.argmin(distance))
        total += distance[nearest]
        current = int(remaining[nearest])
        position[current] = total
    return position


def draw_contact(run, step, references):
    """Writes contact.png (contact_NNNN.png for a step asked for) and returns its path."""
    if not run.contact_files:
        return None
    name = "contact.png" if step is None else f"contact_{step:04d}.png"
    step = run.chosen_step(run.contact_files, step)
    table = run.contact(step)
    if len(table["pair"]) == 0:
        return None
    friction = run.friction_coefficients()
    names = pairs_to_draw(table)
    n_columns = 1 if len(names) == 1 else 2
    n_rows = -(-len(names) // n_columns)
    figure, panels = plt.subplots(n_rows, n_columns, squeeze=False,
                                  figsize=(7.5 if n_columns == 1 else 12, 4.6 * n_rows))
    for panel in panels.ravel()[len(names):]:
        panel.set_visible(False)
    for pair, panel in zip(names, panels.ravel()):
        chosen = table["pair"] == pair
        draw_pair(panel, {key: values[chosen] for key, values in table.items()}, friction.get(pair, float("nan")),
                  references)
        panel.set_title(pair)
    time = run.time_of(step)
    figure.suptitle(run.title + (f", time {short(time)}" if time is not None else ""))
    return save(figure, run.directory / name)


def pairs_to_draw(table):
    """The pairs with the largest forces, in the order of the table."""
    names = list(dict.fromkeys(table["pair"]))
    force = {name: np.sum((table["weight"] * table["pressure"])[table["pair"] == name]) for name in names}
    return sorted(sorted(names, key=lambda name: -force[name])[:MAX_PANELS], key=names.index)


def draw_pair(panel, table, friction, references):
    if "z" in table:
        draw_pair_3d(panel, table)
        return
    position, label = position_along(table)
    order = np.argsort(position, kind="stable")
    position, pressure = position[order], table["pressure"][order]
    tau = np.hypot(table["tau_x"], table["tau_y"])[order]
    panel.plot(position, pressure, ".-", markersize=4, color=COLOURS[0], label="pressure p")
    if tau.max() > 0.0:
        panel.plot(position, tau, ".-", markersize=4, color=COLOURS[1], label=r"tangential traction $|\tau|$")
    if np.isfinite(friction) and friction > 0.0:
        panel.plot(position, friction * pressure, "--", linewidth=1, color="#707070",
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
    panel.set_xlabel(label)
    panel.set_ylabel("traction")
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


def draw_pair_3d(panel, table):
    """The pressure over the plane of the mean normal where there is contact, and arrows of the tangential traction."""
    normal = np.array([table[f"normal_{axis}"].mean() for axis in "xyz"])
    kept = [axis for axis in range(3) if axis != int(np.argmax(np.abs(normal)))]
    points = np.stack([table["xyz"[axis]] for axis in kept], axis=1)
    closed = points[table["status"] > 0] if (table["status"] > 0).any() else points
    low, high = closed.min(axis=0), closed.max(axis=0)
    margin = 0.15 * (high - low).max() + 1e-9
    shown = ((points > low - margin) & (points < high + margin)).all(axis=1)
    points = points[shown]
    spacing = np.sqrt(np.median(table["weight"][shown]))  # about the distance of points
    size = 200.0 * spacing / ((high - low).max() + 2.0 * margin)  # points of a picture four inches wide
    dots = panel.scatter(*points.T, c=table["pressure"][shown], s=np.clip(size, 2.0, 12.0) ** 2, marker="s",
                         linewidths=0, cmap="viridis")
    tau = np.stack([table[f"tau_{'xyz'[axis]}"] for axis in kept], axis=1)[shown]
    if np.abs(tau).max() > 0.0:
        arrows = np.flatnonzero(np.linalg.norm(tau, axis=1) > 0.0)
        arrows = arrows[::max(1, len(arrows) // 400)]
        panel.quiver(*points[arrows].T, *tau[arrows].T, color="white", width=0.002)
    panel.set_aspect("equal")
    panel.set_xlabel("xyz"[kept[0]])
    panel.set_ylabel("xyz"[kept[1]])
    label = "pressure p" + (r", arrows: tangential traction" if np.abs(tau).max() > 0.0 else "")
    panel.figure.colorbar(dots, ax=panel, label=label, shrink=0.85)


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
    units = {"Contact surface": "length or area"}
    groups = {title: visible(history, names) for title, names in groups.items()}
    groups = {title: names for title, names in groups.items() if names}
    figure, panels = plt.subplots(-(-len(groups) // 2), 2, squeeze=False, figsize=(13, 3.9 * -(-len(groups) // 2)))
    for panel in panels.ravel()[len(groups):]:
        panel.set_visible(False)
    for (title, names), panel in zip(groups.items(), panels.ravel()):
        labels = [name.replace("energy.", "").replace(".force_", ", ").replace(".", ", ").replace("_", " ")
                  for name in names]
        quantity = units.get(title, "energy" if title == "Energies" else "force")
        if len(time) == 1:
            draw_bars(panel, labels, [history[name][0] for name in names], quantity)
        else:
            draw_lines(panel, time, labels, [history[name] for name in names], quantity)
        panel.set_title(title)
    figure.suptitle(run.title)
    return save(figure, run.directory / "history.png")


def draw_lines(panel, time, labels, curves, quantity):
    for number, (label, curve) in enumerate(zip(labels, curves)):
        dashed = label == "external work"  # often on top of the strain energy
        panel.plot(time, curve, linestyle=["--" if dashed else "-", "--", ":"][number // len(COLOURS) % 3],
                   marker="o" if len(time) < 30 else "", markersize=4, label=label)
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
    """The curves that are not zero beside the largest of them, at most 12."""
    sizes = {name: np.abs(np.nan_to_num(history[name])).max() for name in names}
    largest = max(sizes.values(), default=0.0)
    kept = [name for name in names if sizes[name] > 1e-9 * largest]
    return sorted(sorted(kept, key=lambda name: -sizes[name])[:12], key=names.index)
