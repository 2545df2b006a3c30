"""The Markdown table of the results: `python -m optimizers.report FOLDER [--all]`."""

from __future__ import annotations

import json
import os
import platform
import statistics
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from optimizers.cases import CASES, Task
from optimizers.check import FEASIBLE, Simulated, verdict

NAMES = {"gaitc": "gaitc", "ipopt": "CasADi + IPOPT", "scipy": "SciPy"}
"""Codes, in the order of the table."""
Row = dict[str, Any]


def main(words: list[str]) -> None:
    every = "--all" in words
    folder = Path(next(word for word in words if not word.startswith("--")))
    rows, versions = read(sorted(folder.glob("*.jsonl")))
    lines = [
        "| code | configuration | right | other optimum | wrong | none | median | worst | build | objective |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for key, case in CASES.items():
        chosen = [row for row in rows if row["case"] == key]
        if not chosen:
            continue
        task = Task(case)
        best = best_known(task, chosen)
        count = 1 + max(row["start"] for row in chosen)
        lines.append(f"| **{case.title}**, {count} starts, best known {best:.6f} m/s | | | | | | | | | |")
        for code in NAMES:
            lines += code_lines(task, code, [row for row in chosen if row["code"] == code], best, every)
    print("\n".join(lines))
    named = ", ".join(f"{name} {version}" for name, version in sorted(versions.items()))
    print(f"\nVersions: {named}. Machine: {machine()}.")


def read(files: Iterable[Path]) -> tuple[list[Row], dict[str, str]]:
    rows: list[Row] = []
    versions: dict[str, str] = {}
    for file in files:
        for line in file.read_text().splitlines():
            row = json.loads(line)
            versions |= row.pop("versions", {})
            if row:
                row["simulated"] = row["simulated"] and Simulated(**row["simulated"])
                rows.append(row)
    return rows, versions


def best_known(task: Task, rows: Sequence[Row]) -> float:
    """The best objective of a claim, by any code from any start, that holds when it is simulated."""
    held = [row["simulated"].objective for row in rows if row["success"] and row["simulated"] and row["simulated"].violation <= FEASIBLE]
    return task.sign * max((task.sign * value for value in held), default=float("nan"))


def code_lines(task: Task, code: str, rows: Sequence[Row], best: float, every: bool) -> list[str]:
    """A line for each configuration of a solver, or for that with the most right answers, of equals the quickest."""
    solvers: dict[str, dict[str, list[Row]]] = defaultdict(lambda: defaultdict(list))
    for row in rows:
        # SciPy has several solvers, named first.
        solver, _, way = row["configuration"].rpartition(", ") if code == "scipy" else ("", "", row["configuration"])
        solvers[f"{NAMES[code]} {solver}".strip()][way].append(row)
    lines = []
    for solver, ways in solvers.items():
        ranked = sorted(line(task, solver, way, group, best) for way, group in ways.items())
        lines += [text for _, _, text in (ranked if every else ranked[:1])]
    return lines


def line(task: Task, solver: str, way: str, rows: Sequence[Row], best: float) -> tuple[int, float, str]:
    """A line of the table, behind what it is ranked by."""
    verdicts = [verdict(task, row["success"], row["simulated"], best) for row in rows]
    counts, times = Counter(verdicts), [row["seconds"] for row in rows]
    right = [row["simulated"].objective for row, said in zip(rows, verdicts) if said == "right"]
    cells = [
        solver, way, f"{counts['right']} of {len(rows)}", counts["other"], counts["wrong"], counts["none"],
        duration(statistics.median(times)), duration(max(times)), duration(rows[0]["build"]) if "IPOPT" in solver else "",
        f"{statistics.median(right):.6f}" if right else "",
    ]
    return -counts["right"], statistics.median(times), "| " + " | ".join(str(cell) for cell in cells) + " |"


def duration(seconds: float) -> str:
    """A time with two or three digits."""
    if seconds >= 1.0:
        return f"{seconds:.1f} s" if seconds < 100.0 else f"{seconds:.0f} s"
    return f"{1e3 * seconds:.0f} ms" if seconds >= 0.01 else f"{1e3 * seconds:.1f} ms"


def machine() -> str:
    """Processor, cores, operating system and load."""
    model = platform.processor() or "unknown processor"
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    loads = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    return f"{model}, {os.cpu_count()} cores, {platform.system()} {platform.machine()}, Python {platform.python_version()}; load averages {loads}"


if __name__ == "__main__":
    main(sys.argv[1:])
