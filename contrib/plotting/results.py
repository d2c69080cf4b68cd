"""The files that a run of scree leaves in its output directory."""
import re
from collections import defaultdict
from functools import cached_property
from pathlib import Path

import numpy as np

from .pairs import with_pair_columns


class ResultsError(Exception):
    """Something the user can mend: a missing file, an unknown name."""


def read_table(path):
    """A CSV file with a header as {column name: array of numbers, or of text}; lines with # are comments."""
    try:
        with open(path, encoding="utf-8") as file:
            lines = [line for line in file if line.strip() and not line.startswith("#")]
    except OSError as error:
        raise ResultsError(f"{path}: {error.strerror}") from error
    if not lines:
        raise ResultsError(f"{path}: the file is empty")
    names = [name.strip() for name in lines[0].split(",")]
    columns = list(zip(*(line.rstrip("\r\n").split(",") for line in lines[1:]))) or [()] * len(names)
    return dict(zip(names, map(numbers_or_text, columns)))


def numbers_or_text(words):
    try:
        return np.array([float(word or "nan") for word in words])
    except ValueError:
        return np.array([word.strip() for word in words])


class ReferenceCurve:
    """CSV:X:Y[:LABEL], two columns of a file to compare with."""

    def __init__(self, text):
        words = text.split(":")
        if len(words) not in (3, 4):
            raise ResultsError(f"--reference {text}: CSV:X:Y or CSV:X:Y:LABEL is needed")
        table = read_table(words[0])
        self.x, self.y = (self.column(table, words[0], word) for word in words[1:3])
        self.label = words[3] if len(words) == 4 else Path(words[0]).stem

    @staticmethod
    def column(table, file_name, word):
        if word in table:
            return table[word]
        if word.isdigit() and int(word) < len(table):
            return list(table.values())[int(word)]
        raise ResultsError(f"{file_name} has no column '{word}', but: {', '.join(table)}")


class Units:
    """Labels with units, where the input names them (Units = length, stress, force); 2D is per unit of thickness."""

    def __init__(self, text, dimension):
        names = [name.strip() for name in text.split(",")]
        self.known = {}
        if len(names) == 3 and all(names):
            length, stress, force = names
            per = "" if dimension == 3 else f"/{length}"
            self.known = {"length": length, "stress": stress, "force": force + per,
                          "moment": f"{force} {length}{per}", "energy": f"{force} {length}{per}",
                          "area": length if dimension == 2 else f"{length}²"}

    def label(self, text, quantity):
        return f"{text} [{self.known[quantity]}]" if quantity in self.known else text


class BodyMesh:
    """The pieces of the bodies in the order of the file: points (n, 3) where they are at the start of the run, arrays
    of triangles and quadrilaterals (2D) or tetrahedra and hexahedra (3D) with the kind of each cell, and the fields at
    the points. The file says whether its points are those of the start or moved (FieldData points_are_moved); file_points
    are those of the file."""

    triangle, quadrilateral, tetrahedron, hexahedron = 5, 9, 10, 12

    def __init__(self, pieces, is_moved=False):
        """`is_moved` counts where files do not say it (those of version 0.1 before the field datum)."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

        points, fields, cells, offset = [], {}, {}, 0
        self.names = []
        for path in pieces:
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(path))
            reader.Update()
            grid = reader.GetOutput()
            self.names = names_of_bodies(grid.GetFieldData())
            moved = grid.GetFieldData().GetArray("points_are_moved")
            is_moved = moved.GetValue(0) if moved else is_moved
            if grid.GetNumberOfPoints() == 0:
                continue
            points.append(vtk_to_numpy(grid.GetPoints().GetData()).astype(float))
            kinds = vtk_to_numpy(grid.GetCellTypesArray())
            starts = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
            connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
            for kind in np.unique(kinds):
                begin = starts[:-1][kinds == kind]
                size = starts[1:][kinds == kind][0] - begin[0]
                cells.setdefault(int(kind), []).append(connectivity[begin[:, None] + np.arange(size)] + offset)
            data = grid.GetPointData()
            for i in range(data.GetNumberOfArrays()):
                fields.setdefault(data.GetArrayName(i), []).append(vtk_to_numpy(data.GetArray(i)).astype(float))
            offset += grid.GetNumberOfPoints()
        if not points:
            raise ResultsError(f"{pieces[0]}: no points")
        self.points = np.concatenate(points)
        self.fields = {name: np.concatenate(parts) for name, parts in fields.items()}
        self.cells = {kind: np.concatenate(parts) for kind, parts in cells.items()}
        self.dim = 3 if any(kind in self.cells for kind in (self.tetrahedron, self.hexahedron)) else 2
        self.is_moved = bool(is_moved)
        self.file_points = self.points
        if self.is_moved:
            self.points = self.points - self.displacement[:, :3]
        self.fields["displacement_magnitude"] = np.linalg.norm(self.displacement, axis=1)
        self.rigid_bodies = np.array([], dtype=int)

    @property
    def displacement(self):
        return self.fields["displacement"]

    @property
    def body(self):
        """Number of the body at each point."""
        return np.rint(self.fields["body"]).astype(int)

    @property
    def is_rigid(self):
        """Whether each point is one of a rigid body."""
        return np.isin(self.body, self.rigid_bodies)

    @property
    def size(self):
        """Largest edge of the box around all bodies."""
        return float(np.ptp(self.points, axis=0).max())

    def cell_points(self, chosen):
        """The numbers of the points that are chosen (a flag for each) and belong to cells of 2D."""
        used = np.unique(self.triangles())
        return used[chosen[used]]

    def field(self, name):
        if name not in self.fields or self.fields[name].ndim > 1:
            known = ", ".join(sorted(key for key, values in self.fields.items() if values.ndim == 1))
            raise ResultsError(f"--field {name}: there is no such field, but: {known}")
        return self.fields[name]

    def cells_of(self, kind):
        n_vertices = {self.triangle: 3, self.quadrilateral: 4, self.tetrahedron: 4, self.hexahedron: 8}[kind]
        return self.cells.get(kind, np.empty((0, n_vertices), dtype=int))

    def triangles(self):
        """All cells of 2D as triangles (n, 3)."""
        quads = self.cells_of(self.quadrilateral)
        return np.concatenate([self.cells_of(self.triangle), quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])

    def edges(self):
        """All edges of the 2D cells (n, 2), those between cells as often as there are cells."""
        edges = []
        for kind in (self.triangle, self.quadrilateral):
            cells = self.cells_of(kind)
            edges += [np.stack([cells[:, i], np.roll(cells, -1, axis=1)[:, i]], axis=1)
                      for i in range(cells.shape[1])]
        return np.concatenate(edges)


def names_of_bodies(field_data):
    """The names of all bodies in the order of their numbers, by the field data body.NAME."""
    arrays = [field_data.GetArray(i) for i in range(field_data.GetNumberOfArrays())]
    numbers = {a.GetName()[len("body."):]: a.GetValue(0) for a in arrays if a and a.GetName().startswith("body.")}
    return sorted(numbers, key=numbers.get)


class RunResults:
    """An output directory: which steps there are, and their tables and meshes."""

    def __init__(self, directory):
        self.directory = Path(directory)
        if not self.directory.is_dir():
            raise ResultsError(f"{directory}: there is no such directory")
        self.parameters = self.read_parameters()
        self.body_files = self.files_by_step(r"bodies_(\d+)(?:\.\d+)?\.vtu")
        self.contact_files = self.files_by_step(r"contact_(\d+)\.csv")
        if not (self.body_files or self.contact_files or self.has_history):
            raise ResultsError(f"{directory}: there are no results of scree in this directory")

    @property
    def has_history(self):
        return (self.directory / "history.csv").exists()

    @property
    def is_check(self):
        """Whether only the set-up was written (scree --check)."""
        return not self.has_history and 0 in self.body_files

    @property
    def units(self):
        return Units(self.parameters.get("Units", ""), self.dimension)

    @property
    def dimension(self):
        return int(self.parameters.get("Dimension", "2"))

    @property
    def title(self):
        return self.parameters.get("Title", "") or self.directory.resolve().name

    def files_by_step(self, pattern):
        steps = {}
        for path in sorted(self.directory.iterdir()):
            match = re.fullmatch(pattern, path.name)
            if match:
                steps.setdefault(int(match.group(1)), []).append(path)
        return steps

    @staticmethod
    def chosen_step(steps, step):
        if step is None:
            return max(steps)
        if step not in steps:
            raise ResultsError(f"--step {step}: not written; there are {', '.join(map(str, sorted(steps)))}")
        return step

    def mesh(self, step):
        mesh = BodyMesh(self.body_files[step], self.is_moving)
        mesh.names = mesh.names or self.names("Bodies")  # files of version 0.1 have none
        mesh.rigid_bodies = np.flatnonzero([self.is_rigid(name) for name in mesh.names])
        return mesh

    @property
    def is_moving(self):
        return self.parameters.get("Moving geometry/Update", "none") != "none"

    def section_of(self, body):
        """The section in Bodies of a body: its own, or that of its family, of which FAMILY-0017 is one."""
        return body if body in self.own_sections else body.rpartition("-")[0]

    @cached_property
    def own_sections(self):
        return frozenset(self.names("Bodies"))

    def is_rigid(self, body):
        material = self.parameters.get(f"Bodies/{self.section_of(body)}/Material", "")
        return self.parameters.get(f"Materials/{material}/Law", "") == "rigid"

    def contact(self, step):
        return read_table(self.contact_files[step][0])

    @property
    def box(self):
        """Lower and upper corner of the grid; infinite where the parameters do not tell."""
        return [np.array([float(v) for v in self.parameters.get(f"Grid/{corner} corner", f"{end},{end},{end}").split(",")])
                for corner, end in (("Lower", "-inf"), ("Upper", "inf"))]

    @cached_property
    def regions(self):
        """The points of conditions on cut surfaces; empty without any."""
        file = self.directory / "regions.csv"
        return read_table(file) if file.exists() else {}

    def history(self):
        """With the columns of pairs, wherever they are."""
        return with_pair_columns(self.directory, read_table(self.directory / "history.csv"))

    @cached_property
    def rows_of_regions(self):
        """{(section of the body, condition): rows of the regions}."""
        rows = defaultdict(list)
        for row, key in enumerate(zip(self.regions.get("body", ()), self.regions.get("condition", ()))):
            rows[self.section_of(key[0]), key[1]].append(row)
        return rows

    def read_parameters(self):
        """The resolved parameters as {"Section/Subsection/Key": text}; those of a cycle are one directory up."""
        entries, path = {}, []
        file = self.directory / "parameters.prm"
        if not file.exists():
            file = self.directory.parent / "parameters.prm"
        for line in file.read_text(encoding="utf-8").splitlines() if file.exists() else []:
            line = line.split("#")[0].strip()
            if line.startswith("subsection "):
                path.append(line[len("subsection "):].strip())
            elif line == "end":
                path.pop()
            elif line.startswith("set "):
                key, _, value = line[len("set "):].partition("=")
                entries["/".join(path + [key.strip()])] = value.strip()
        return entries

    def names(self, section):
        text = self.parameters.get(f"{section}/Names", "")
        return [name.strip() for name in text.split(",") if name.strip()]

    def time_of(self, step):
        if not self.has_history:
            return None
        history = self.history()
        rows = np.flatnonzero(history["step"] == step)
        return history["time"][rows[0]] if rows.size else None

    def log(self):
        """The text of the log; empty without one."""
        path = self.directory / "log.txt"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def starts_unloaded(self):
        """Whether no bodies overlap at the start, by the gaps that the log tells."""
        return "overlap at the start" not in self.log()

    def friction_coefficients(self):
        """{name: friction coefficient} of the contact pairs, nan without Coulomb friction. The log tells the law, but if there
        are many pairs; then that of the input counts, if there is one for all."""
        def of_law(section):
            return float(self.parameters.get(f"Contact/{section}/Friction coefficient", "nan"))

        laws = self.names("Contact")
        is_for_all = len(laws) == 1 and self.parameters.get(f"Contact/{laws[0]}/Bodies", "*, *").replace(" ", "") == "*,*"
        is_coulomb = is_for_all and self.parameters.get(f"Contact/{laws[0]}/Law", "") == "coulomb"
        pairs = defaultdict(lambda: of_law(laws[0]) if is_coulomb else float("nan"))
        for line in self.log().splitlines():
            match = re.match(r"Contact (.+): (\w+) \('(.*)'\)", line)
            if match:
                name, law, section = match.groups()
                pairs[name] = of_law(section) if law == "coulomb" else float("nan")
        return pairs
