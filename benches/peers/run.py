"""Measures gaitc and its peers on three units of work and writes a Markdown table: `benches/peers/run --help`.

Needs Python 3.11, cargo, a C compiler and the package registries. Everything it installs or builds lies below `target/peers`.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from peers.report import table

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WORK = ROOT / "target" / "peers"
PYTHON_CODES = ("casadi", "heyoka", "diffrax", "scipy")
RUST_CODES = ("gaitc", "diffsol", "differential_equations")
UNITS = ("a", "b", "c")


def main() -> None:
    options = arguments()
    WORK.mkdir(parents=True, exist_ok=True)
    python = environment()
    cases = units(python)
    codes = options.only or [*RUST_CODES, *PYTHON_CODES]
    rows: list[dict[str, Any]] = []
    versions: dict[str, str] = {}
    loads: list[float] = []
    for code in codes:
        try:
            command = rust(code, versions) if code in RUST_CODES else [python, "-m", "peers.worker", code]
        except subprocess.CalledProcessError as error:
            note = f"does not build, see {error.cmd[-1]}"
            rows += [failed(code, unit, note) for unit in options.unit]
            continue
        for unit in options.unit:
            quick = ["--quick"] if options.quick else []
            place = ["run", code] if code in RUST_CODES else []
            for row in measure([*command, *place, unit, str(cases), *quick], code, unit, options.budget):
                versions |= row.pop("versions", {})
                if row:
                    rows.append({"code": code, "unit": unit, **row})
                    say(rows[-1])
            loads.append(os.getloadavg()[0])
            # As it comes, so that a run that is broken off leaves what it has.
            (WORK / "table.md").write_text(table(rows, versions, loads))
    print(table(rows, versions, loads))


def arguments() -> argparse.Namespace:
    """What the user asks for."""
    parser = argparse.ArgumentParser(prog="benches/peers/run", description=__doc__)
    known = [*RUST_CODES, *PYTHON_CODES]
    parser.add_argument("--only", nargs="+", choices=known, metavar="CODE", help=f"some of {', '.join(known)}")
    parser.add_argument("--unit", nargs="+", choices=UNITS, default=list(UNITS), help="some of the units")
    parser.add_argument("--quick", action="store_true", help="time briefly: to see that it works, not for the table")
    parser.add_argument("--budget", type=float, default=600.0, help="longest time of a code on a unit (s)")
    return parser.parse_args()


def environment() -> str:
    """A virtual environment with the pinned packages, made when there is none for these pins; its Python."""
    folder, pins = WORK / "venv", HERE / "requirements.txt"
    python, mark = folder / "bin" / "python", folder / "installed.txt"
    if not mark.exists() or mark.read_text() != pins.read_text():
        print("installing the packages of requirements.txt ...", file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
        pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        if subprocess.run([*pip, "-r", pins], check=False).returncode != 0:
            # One package that does not install must not stop the others.
            for line in pins.read_text().splitlines():
                if line and not line.startswith("#"):
                    subprocess.run([*pip, line], check=False)
        mark.write_text(pins.read_text())
    return str(python)


def rust(code: str, versions: dict[str, str]) -> list[str]:
    """Builds a Rust code, each with its own feature; the command that runs it."""
    feature = code.replace("_", "-")
    target, binary = WORK / "rust", WORK / "rust" / f"peer-{feature}"
    log = WORK / f"build-{feature}.log"
    command = ["cargo", "build", "--release", "--locked", "--features", feature, "--target-dir", str(target)]
    print(f"building {feature} ...", file=sys.stderr)
    with log.open("w") as out:
        # In its own folder cargo finds the project's flags: code for the processor that it runs on.
        built = subprocess.run(command, cwd=HERE / "rust", stdout=out, stderr=subprocess.STDOUT, check=False)
    if built.returncode != 0:
        raise subprocess.CalledProcessError(built.returncode, [*command, str(log)])
    tree = ["cargo", "tree", "--depth", "1", "--prefix", "none", "--features", feature]
    listed = subprocess.run(tree, cwd=HERE / "rust", capture_output=True, text=True, check=False).stdout
    versions |= {name: v.lstrip("v") for name, v, *_ in (x.split() for x in listed.splitlines()) if name == feature}
    # The next code is built in the same place.
    shutil.copy(target / "release" / "gaitc-peers", binary)
    return [str(binary)]


def units(python: str) -> Path:
    """The file of units: gaits by gaitc, results by the reference; kept while the gaits are the same."""
    file = WORK / "cases.json"
    text = subprocess.run([*rust("gaitc", {}), "cases"], check=True, capture_output=True, text=True).stdout
    cases = json.loads(text)
    known = json.loads(file.read_text()) if file.exists() else {}
    same = all({k: known.get(key, {}).get(k) for k in case} == case for key, case in cases.items())
    if not same:
        print("computing the reference (a minute) ...", file=sys.stderr)
        (WORK / "gaits.json").write_text(text)
        subprocess.run([python, "-m", "peers.reference", str(WORK / "gaits.json"), str(file)], cwd=HERE, check=True)
    return file


def measure(command: Sequence[str], code: str, unit: str, budget: float) -> Iterator[dict[str, Any]]:
    """Runs a code on a unit and yields what it says; a row that tells of it where it stops early."""
    child = subprocess.Popen(command, cwd=HERE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        out, err = child.communicate(timeout=budget)
        note = "" if child.returncode == 0 else (err.strip().splitlines() or [f"exit code {child.returncode}"])[-1]
    except subprocess.TimeoutExpired:
        child.kill()
        out, err = child.communicate()
        note = f"stopped after {budget:.0f} s"
    yield from (json.loads(line) for line in out.splitlines() if line.startswith("{"))
    if note:
        yield failed(code, unit, note[:160])


def failed(code: str, unit: str, note: str) -> dict[str, Any]:
    """A row for what did not work."""
    return {"code": code, "unit": unit, "configuration": "", "status": "failed", "note": note}


def say(row: dict[str, Any]) -> None:
    """One line of progress."""
    outcome = f"{row['median_us']:.2f} us" if row["status"] == "ok" else f"{row['status']}: {row['note']}"
    print(f"{row['unit']} {row['code']}: {row['configuration']}: {outcome}", file=sys.stderr)


if __name__ == "__main__":
    main()
