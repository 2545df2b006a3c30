"""Solves the same problems from the same starts with gaitc and with general solvers, checks every answer, and writes a Markdown
table: `benches/optimizers/run --help`.

Needs Python 3.11, cargo and the package registries. Everything it installs or builds lies below `target/optimizers`.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WORK = ROOT / "target" / "optimizers"
CODES = ("gaitc", "ipopt", "scipy")
CASES = ("crank", "crank_stable", "prescribed", "switched", "stroke")


def main() -> None:
    options = arguments()
    (WORK / "results").mkdir(parents=True, exist_ok=True)
    python = environment()
    library(python)
    surroundings = {
        **os.environ,
        # Where the modules are; the equations of the climbers are those of the other comparison.
        "PYTHONPATH": os.pathsep.join(str(path) for path in (HERE, HERE.parent / "peers", WORK / "module")),
        # One core: processor time is what is measured.
        **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS"), "1"),
    }
    count = options.starts
    for case in options.problem:
        for code in options.only:
            say(f"{case}: {code} ...")
            out = WORK / "results" / f"{case}-{code}.jsonl"
            command = [python, "-m", "optimizers.worker", code, case, str(count), str(options.seed)]
            note = measure(command, out, surroundings, options.budget)
            if note:
                say(f"{case}: {code}: {note}")
    report = [python, "-m", "optimizers.report", str(WORK / "results"), *(["--all"] if options.all else [])]
    table = subprocess.run(report, cwd=ROOT, env=surroundings, check=True, capture_output=True, text=True).stdout
    (WORK / "table.md").write_text(table)
    print(table)


def arguments() -> argparse.Namespace:
    """What the user asks for."""
    parser = argparse.ArgumentParser(prog="benches/optimizers/run", description=__doc__)
    parser.add_argument("--only", nargs="+", choices=CODES, default=list(CODES), help="some of the codes; of the others the last results")
    parser.add_argument("--problem", nargs="+", choices=CASES, default=list(CASES), help="some of the problems")
    parser.add_argument("--starts", type=int, default=10, help="random starts besides the spec's own (default 10)")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    parser.add_argument("--all", action="store_true", help="every configuration of a code in the table, not its best alone")
    parser.add_argument("--budget", type=float, default=3600.0, help="longest time of a code on a problem (s)")
    return parser.parse_args()


def environment() -> str:
    """A virtual environment with the pinned packages, made when there is none for these pins; its Python."""
    folder, pins = WORK / "venv", HERE / "requirements.txt"
    python, mark = folder / "bin" / "python", folder / "installed.txt"
    if not mark.exists() or mark.read_text() != pins.read_text():
        say("installing the packages of requirements.txt ...")
        subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
        pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        subprocess.run([*pip, "-r", pins], check=True)
        mark.write_text(pins.read_text())
    return str(python)


def library(python: str) -> None:
    """Builds gaitc as a Python module."""
    say("building gaitc ...")
    target = WORK / "rust"
    command = ["cargo", "build", "--release", "--locked", "--quiet", "--target-dir", str(target)]
    # In its own folder cargo finds the project's flags: code for the processor that it runs on.
    subprocess.run(command, cwd=HERE / "rust", env={**os.environ, "PYO3_PYTHON": python}, check=True)
    (WORK / "module").mkdir(exist_ok=True)
    built = next(file for end in ("so", "dylib") for file in target.joinpath("release").glob(f"libgaitc_problem.{end}"))
    # Put in place whole: another run may have the old one loaded.
    new = WORK / "module" / "gaitc_problem.so.new"
    shutil.copy(built, new)
    new.replace(WORK / "module" / "gaitc_problem.so")


def measure(command: list[str], out: Path, surroundings: dict[str, str], budget: float) -> str:
    """Runs a code on a problem; its rows go to a file. What went wrong, if anything did."""
    with out.open("w") as rows:
        # In the root folder gaitc finds its specs.
        child = subprocess.Popen(command, cwd=ROOT, env=surroundings, stdout=rows, stderr=subprocess.PIPE, text=True)
        try:
            _, err = child.communicate(timeout=budget)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            return f"stopped after {budget:.0f} s"
    return "" if child.returncode == 0 else (err.strip().splitlines() or [f"exit code {child.returncode}"])[-1]


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
