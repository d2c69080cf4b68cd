"""What all pictures share."""
import matplotlib.pyplot as plt

TALLEST = 6.5  # inches
COLOURS = ["#1f5fa8", "#c8452e", "#2f8f4e", "#8a56a8", "#b8860b", "#4c9aa8", "#7a5c43", "#d0719f"]
RIGID = "#b4b4b4"

plt.rcParams.update({
    "figure.dpi": 100, "savefig.dpi": 150, "font.size": 10, "axes.titlesize": 11, "axes.grid": True,
    "grid.color": "#e4e4e4", "grid.linewidth": 0.7, "axes.axisbelow": True, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "legend.fontsize": 9, "lines.linewidth": 1.5,
    "axes.prop_cycle": plt.cycler(color=COLOURS), "figure.constrained_layout.use": True, "figure.constrained_layout.h_pad": 0.12,
    "figure.constrained_layout.w_pad": 0.1})


def figure_for(points, width=8.0, extra=1.2):
    """A figure and axes of equal scale, shaped like the box around `points` (n, 2)."""
    low, high = points.min(axis=0), points.max(axis=0)
    extent = (high - low).clip(1e-12 * max((high - low).max(), 1e-300))
    height = min(max(width * extent[1] / extent[0], 2.2), TALLEST)
    if height == TALLEST:
        width = min(max(TALLEST * extent[0] / extent[1] + 1.5, 4.5), width)
    figure, axes = plt.subplots(figsize=(width + extra, height + 0.9))
    margin = 0.03 * extent.max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("x")
    axes.set_ylabel("y")
    return figure, axes


def save(figure, path):
    # The layout has made room for all that is drawn; a second pass for a tight box would double the time.
    figure.savefig(path, pil_kwargs={"compress_level": 4})
    plt.close(figure)
    return path


def nice_number_below(value):
    """The largest of 1, 1.5, 2, 3, 5, 7 times a power of ten that is not above `value`."""
    power = 10.0 ** int(f"{value:e}".split("e")[1])
    return max(m for m in (1.0, 1.5, 2.0, 3.0, 5.0, 7.0) if m * power <= value * (1 + 1e-12)) * power


def short(value):
    return f"{value:.4g}"
