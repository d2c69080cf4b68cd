"""Fields along the lines and at the points of section Output/Probes."""
import re

import matplotlib.pyplot as plt
import numpy as np

from .results import read_table
from .style import save, short

MOST_ROWS = 6
GROUPS = (("displacement", "length", r"u_[xyz]"), ("stress", "stress", r"stress_[xyz]{2}|von_mises"),
          ("plastic strain", "", r"plastic_strain"))


def grouped(columns):
    """(title, quantity, columns) for displacements, stresses and, where a material may flow, plastic strains."""
    groups = [(title, quantity, [name for name in columns if re.fullmatch(pattern, name)]) for title, quantity, pattern in GROUPS]
    return [group for group in groups if group[2]]


def draw_curves(run, rows, label, starts_at_zero=False):
    """A row of panels for each (name, places, table), one for each group of columns; the figure."""
    zero = [0.0] if starts_at_zero else []
    width = max(len(grouped(table)) for _, _, table in rows)
    figure, panels = plt.subplots(len(rows), width, squeeze=False, figsize=(6.5 * width, 3.4 * len(rows) + 0.5))
    for row, (name, places, table) in zip(panels, rows):
        for panel in row[len(grouped(table)):]:
            panel.set_axis_off()
        for panel, (title, quantity, columns) in zip(row, grouped(table)):
            for column in columns:
                panel.plot([*zero, *places], [*zero, *table[column]], marker="o" if len(places) < 30 else "", markersize=4,
                           label=column.replace("_", " "))
            panel.set_title(name)
            panel.set_xlabel(label)
            panel.set_ylabel(run.units.label(title, quantity))
            panel.ticklabel_format(axis="y", scilimits=(-3, 4))
            panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def draw(run, step):
    """Writes lines.png (lines_NNNN.png for a step asked for), fields along the lines, and probes.png, those at the points
    over time; the paths."""
    found = [draw_lines(run, step), draw_points(run) if step is None else None]
    return [path for path in found if path]


def draw_lines(run, step):
    rows, times = [], set()
    for name, files in lines(run.directory).items():
        number = max(files) if step is None else step
        table = read_table(files[number]) if number in files else {"x": []}
        points = np.stack([table[axis] for axis in "xyz" if axis in table], axis=1)
        if len(points) > 1:
            rows.append((f"line {name}", np.linalg.norm(points - points[0], axis=1), table))
            times.add(run.time_of(number))
    if not rows:
        return None
    figure = draw_curves(run, first_of(rows, "lines"), run.units.label("position along the line", "length"))
    figure.suptitle(run.title + (f", time {short(times.pop())}" if len(times) == 1 and None not in times else ""))
    return save(figure, run.directory / ("lines.png" if step is None else f"lines_{step:04d}.png"))


def draw_points(run):
    file = run.directory / "probes.csv"
    table = read_table(file) if file.exists() else {"time": []}
    if len(table["time"]) < 2:
        return None
    rows = []
    for name in dict.fromkeys(column.split(".")[0] for column in table if "." in column):
        own = {column.split(".", 1)[1]: values for column, values in table.items() if column.startswith(f"{name}.")}
        rows.append((f"probe {name}", table["time"], own))
    # Before the first step nothing is loaded, unless bodies overlap.
    figure = draw_curves(run, first_of(rows, "probes"), "time", run.starts_unloaded())
    for panel in figure.axes:
        panel.set_xlim(left=min(0.0, table["time"][0]))
    figure.suptitle(run.title)
    return save(figure, run.directory / "probes.png")


def first_of(rows, what):
    if len(rows) > MOST_ROWS:
        print(f"{what}: not drawn: {', '.join(name for name, _, _ in rows[MOST_ROWS:])}")
    return rows[:MOST_ROWS]


def lines(directory):
    """{name: {step: file}} of the tables of lines."""
    found = {}
    for path in sorted(directory.glob("line_*.csv")):
        name, _, number = path.stem[len("line_"):].rpartition("_")
        if number.isdigit():
            found.setdefault(name, {})[int(number)] = path
    return found
