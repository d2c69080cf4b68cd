"""What the checks that run whole inputs share: NAME.check beside NAME.prm (see shipped_inputs), how a run ended."""
import shlex
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TIME_LIMIT = 600  # seconds for a run


def shipped():
    """The inputs for users."""
    return sorted((ROOT / "prm").rglob("*.prm"))


class Check:
    """What a .check file says."""

    def __init__(self, path):
        self.options, self.expectations, self.failure, self.processes = [], [], None, 1
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            line = line.strip()
            if line and not line.startswith("#"):
                try:
                    self.read_line(line)
                except (ValueError, IndexError) as error:
                    raise ValueError(f"{path.name}, line {number}: '{line}' is not understood") from error
        if not self.expectations and self.failure is None:
            raise ValueError(f"{path.name}: nothing is expected")

    def read_line(self, line):
        if line.startswith("--set "):
            self.options += ["--set", line[len("--set "):].strip()]
            return
        kind, *words = shlex.split(line)
        if kind == "expect":
            file_name, column, row, value, tolerance = words
            self.expectations.append((file_name, column, int(row), float(value), float(tolerance)))
        elif kind == "fails":
            (self.failure,) = words
        elif kind == "processes":
            self.processes = int(words[0])
        else:
            raise ValueError(kind)

    def command(self, program, prm, results):
        words = [str(program), str(prm), *self.options, "--output", str(results)]
        if self.processes > 1:
            words = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(self.processes), *words]
        return words


def wrong_end(done, failure):
    """What is wrong with the way the program ended, or nothing."""
    tail = "\n".join(done.stdout.splitlines()[-15:])
    if failure is None:
        return f"ended with exit code {done.returncode}:\n{tail}" if done.returncode != 0 else ""
    if done.returncode == 0:
        return f"should fail with '{failure}' but ended well"
    return "" if failure in " ".join(done.stdout.split()) else f"failed without saying '{failure}':\n{tail}"
