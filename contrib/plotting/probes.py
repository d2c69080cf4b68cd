"""Fields along the lines and at the points of section Output/Probes."""
import re

import matplotlib.pyplot as plt
import numpy as np

from .results import read_table
from .style import save, short

GROUPS = (("displacement", "length", r"u_[xyz]"), ("stress", "stress", r"stress_[xyz]{2}|von_mises"))


def grouped(columns):
    """(title, quantity, columns) for displacements and stresses."""
    return [(title, quantity, [name for name in columns if re.fullmatch(pattern, name)]) for title, quantity, pattern in GROUPS]


def draw_curves(run, name, places, label, table):
    """A row of two panels; the figure."""
    figure, panels = plt.subplots(1, 2, figsize=(13, 3.9))
    for panel, (title, quantity, columns) in zip(panels, grouped(table)):
        for column in columns:
            panel.plot(places, table[column], marker="o" if len(places) < 30 else "", markersize=4,
                       label=column.replace("_", " "))
        panel.set_xlabel(label)
        panel.set_ylabel(run.units.label(title, quantity))
        panel.ticklabel_format(axis="y", scilimits=(-3, 4))
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.suptitle(name)
    return figure


def draw(run, step):
    """Writes line_NAME.png for each line (line_NAME_NNNN.png for a step asked for) and probes.png with the points over
    time; the paths."""
    paths = []
    for name, files in lines(run.directory).items():
        if step is not None and step not in files:
            continue
        number = max(files) if step is None else step
        table = read_table(files[number])
        points = np.stack([table[axis] for axis in "xyz" if axis in table], axis=1)
        if len(points) < 2:
            continue
        distance = np.linalg.norm(points - points[0], axis=1)
        time = run.time_of(number)
        title = f"{run.title}: line {name}" + (f", time {short(time)}" if time is not None else "")
        figure = draw_curves(run, title, distance, run.units.label("position along the line", "length"), table)
        paths.append(save(figure, run.directory / (f"line_{name}.png" if step is None else f"line_{name}_{step:04d}.png")))
    table = read_table(run.directory / "probes.csv") if (run.directory / "probes.csv").exists() else {}
    for name in dict.fromkeys(column.split(".")[0] for column in table if "." in column):
        own = {column.split(".", 1)[1]: values for column, values in table.items() if column.startswith(f"{name}.")}
        figure = draw_curves(run, f"{run.title}: probe {name}", table["time"], "time", own)
        paths.append(save(figure, run.directory / f"probe_{name}.png"))
    return paths


def lines(directory):
    """{name: {step: file}} of the tables of lines."""
    found = {}
    for path in sorted(directory.glob("line_*.csv")):
        name, _, number = path.stem[len("line_"):].rpartition("_")
        if number.isdigit():
            found.setdefault(name, {})[int(number)] = path
    return found
