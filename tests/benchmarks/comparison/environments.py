"""An environment of its own for each library, because they ask for different Pinocchios."""

import os
import subprocess
import sys
import venv
from pathlib import Path

PACKAGES = {
    "mink": ("mink", "mujoco", "daqp"),
    "pink": ("pin-pink", "daqp"),
    "placo": ("placo",),
}
"""What pip installs for each."""


class NotHere(Exception):
    """A library cannot be had on this machine; the sentence says why."""


def folder() -> Path:
    """Return where the environments are kept."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    return Path(cache) / "usdmotion" / "benchmarks" / version


def python(library: str, where: Path | None = None) -> Path:
    """Return the interpreter that has a library; the first time it is made and filled.

    Raises:
        NotHere: pip cannot install it.
    """
    place = (where or folder()) / library
    executable = place / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    done = place / "installed"
    if not done.is_file():
        print(f"making an environment for {library} …", file=sys.stderr)
        venv.create(place, clear=True, with_pip=True)
        command = [str(executable), "-m", "pip", "install", "-q", *PACKAGES[library]]
        said = subprocess.run(command, capture_output=True, text=True)
        if said.returncode != 0:
            why = (said.stderr.strip().splitlines() or ["pip said nothing"])[-1]
            raise NotHere(f"{library} is left out, because it cannot be installed here: {why}")
        done.touch()
    return executable


def single_threaded() -> dict[str, str]:
    """Return the variables under which no library starts threads of its own."""
    names = ("OMP", "OPENBLAS", "MKL", "NUMEXPR")
    foreign = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return foreign | {f"{name}_NUM_THREADS": "1" for name in names}
