"""What contrib/checks/fuzz and fuzz_readers know of the programs that they start."""
import os
from pathlib import Path

# Leaks are those of Open MPI and Trilinos; their containers are not annotated.
SANITIZERS = {"ASAN_OPTIONS": "detect_leaks=0:detect_container_overflow=0:allocator_may_return_null=1",
              "UBSAN_OPTIONS": "print_stacktrace=1:halt_on_error=1"}


def memory_of(process):
    """Bytes that the process of this number takes; 0 if it has ended."""
    try:
        return int(Path(f"/proc/{process}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError):
        return 0
