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
    known = run.pairs()
    numbers = sorted(set(table["pair"].astype(int)), key=lambda n: -np.sum((table["weight"] * table["pressure"])
                                                                          [table["pair"] == n]))
    numbers = sorted(n for n in numbers[:MAX_PANELS])
    n_columns = 1 if len(numbers) == 1 else 2
    n_rows = -(-len(numbers) // n_columns)
    figure, panels = plt.subplots(n_rows, n_columns, squeeze=False, figsize=(7.5 if n_columns == 1 else 12, 4.6 * n_rows))
    for panel in panels.ravel()[len(numbers):]:
        panel.set_visible(False)
    for number, panel in zip(numbers, panels.ravel()):
        chosen = table["pair"] == number
        title, friction = known[number] if number < len(known) else (f"pair {number}", float("nan"))
        draw_pair(panel, {key: values[chosen] for key, values in table.items()}, friction, references)
        panel.set_title(title)
    time = run.time_of(step)
    figure.suptitle(run.title + (f", time {short(time)}" if time is not None else ""))
    return save(figure, run.directory / name)


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
    panel.set_ylim(bottom=min(0.0, pressure.min()), top=1.3 * max(pressure.max(), tau.max(), 1e-300))
    panel.set_xlabel(label)
    panel.set_ylabel("traction")
    panel.legend(loc="upper center", ncol=2)


def draw_pair_3d(panel, table):
    """The pressure over the plane of the mean normal."""
    normal = np.array([table[f"normal_{axis}"].mean() for axis in "xyz"])
    kept = [axis for axis in range(3) if axis != int(np.argmax(np.abs(normal)))]
    points = [table["xyz"[axis]] for axis in kept]
    dots = panel.scatter(*points, c=table["pressure"], s=6, cmap="viridis")
    panel.set_aspect("equal")
    panel.set_xlabel("xyz"[kept[0]])
    panel.set_ylabel("xyz"[kept[1]])
    panel.figure.colorbar(dots, ax=panel, label="pressure p", shrink=0.85)


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
        for number, name in enumerate(names):
            label = name.replace("energy.", "").replace(".force_", ", ").replace(".", ", ").replace("_", " ")
            panel.plot(time, history[name], linestyle=["-", "--", ":"][number // len(COLOURS) % 3],
                       marker="o" if len(time) < 30 else "", markersize=4, label=label)
        panel.set_title(title)
        panel.set_xlabel("time")
        panel.set_ylabel(units.get(title, "energy" if title == "Energies" else "force"))
        panel.ticklabel_format(axis="y", scilimits=(-3, 4))
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.suptitle(run.title)
    return save(figure, run.directory / "history.png")


def visible(history, names):
    """The curves that are not zero beside the largest of them, at most 12."""
    sizes = {name: np.abs(np.nan_to_num(history[name])).max() for name in names}
    largest = max(sizes.values(), default=0.0)
    kept = [name for name in names if sizes[name] > 1e-9 * largest]
    return sorted(sorted(kept, key=lambda name: -sizes[name])[:12], key=names.index)
