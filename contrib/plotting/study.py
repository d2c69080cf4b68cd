"""A refinement study: errors over unknowns."""
import matplotlib.pyplot as plt
import numpy as np

from .results import ResultsError, read_table
from .style import save


ROUND_OFF = 1e-10  # errors below say nothing, and would stretch the axis


def cycles(directory):
    """The output directories of the cycles of a study, in order; none of a single run."""
    return sorted(directory.glob("cycle-[0-9]*"), key=lambda path: int(path.name.split("-")[1]))


def draw(directory, title):
    """Writes study.png: the error of each quantity and the estimated one, with the last order."""
    path = directory / "study.csv"
    if not path.exists():
        return None
    table = read_table(path)
    unknowns = table["unknowns"]
    curves = {name[:-len(".error")]: errors for name, errors in table.items() if name.endswith(".error")}
    curves["estimated, energy norm"] = table["error_estimate"]
    figure, panel = plt.subplots(figsize=(8.5, 5.0))
    for name, errors in curves.items():
        drawn = np.isfinite(errors) & (errors > ROUND_OFF)
        if not drawn.any():
            if (np.isfinite(errors) & (errors <= ROUND_OFF)).any():
                panel.plot([], [], " ", label=f"{name}: round-off")
            continue
        orders = table.get(f"{name}.order", np.array([]))
        orders = orders[np.isfinite(orders)]
        label = f"{name}, order {orders[-1]:.2f} at last" if orders.size else name
        panel.loglog(unknowns[drawn], errors[drawn], "--" if name.startswith("estimated") else "-", marker="o",
                     markersize=4, label=label)
    if not panel.lines:
        raise ResultsError(f"{path}: there is no error to draw")
    panel.set_xscale("log")
    panel.set_xticks(unknowns, [f"{n:,.0f}" for n in unknowns], rotation=30 if len(unknowns) > 4 else 0)
    panel.set_xticks([], minor=True)
    panel.set_xlabel("unknowns")
    panel.set_ylabel("relative error")
    panel.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    panel.set_title(title)
    return save(figure, directory / "study.png")
