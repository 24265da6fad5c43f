"""A virtual environment for the programs that motes is measured beside."""

import subprocess
import sys
import tempfile
import venv
from pathlib import Path


def rerun(packages):
    """Runs this script again, with --here, in a new virtual environment that has some packages; gives its exit code."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = Path(folder) / "bin" / "python"
        subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], check=True)
        return subprocess.run([python, *sys.argv, "--here"]).returncode
