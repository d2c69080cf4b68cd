"""The columns of contact pairs that history.csv leaves out when there are many pairs, from contacts.csv."""
import csv
from pathlib import Path

import numpy as np

NO_COLUMNS = {"step", "time", "pair", "body_a", "body_b"}


def pair_columns(directory, steps):
    """{"PAIR.COLUMN": values at the given steps} of all pairs that were closed once; before that, forces and lengths
    are zero and gaps are not known."""
    path = Path(directory) / "contacts.csv"
    if not path.exists():
        return {}
    place = {int(step): number for number, step in enumerate(steps)}
    columns = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            for name, word in row.items():
                if name in NO_COLUMNS or int(row["step"]) not in place:
                    continue
                values = columns.setdefault(f"{row['pair']}.{name}",
                                            [float("nan") if name == "minimum_gap" else 0.0] * len(place))
                values[place[int(row["step"])]] = float(word)
    return columns


def with_pair_columns(directory, history):
    """The columns of history.csv and those that it leaves out, as arrays."""
    of_pairs = pair_columns(directory, history["step"])
    return {**{name: np.array(values) for name, values in of_pairs.items()}, **history}
