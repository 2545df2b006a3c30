"""The Markdown table of the measurements, and what they were measured on."""

from __future__ import annotations

import os
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from peers.measure import power
from peers.units import TITLES, WANTED

NAMES = {
    "gaitc": "gaitc",
    "casadi": "CasADi",
    "heyoka": "heyoka",
    "differential_equations": "differential-equations (Rust)",
    "diffsol": "diffsol (Rust)",
    "diffrax": "diffrax",
    "scipy": "SciPy",
}
"""Codes, in the order of the table."""
Row = Mapping[str, Any]


def machine() -> str:
    """Processor, cores, operating system and load."""
    model = platform.processor() or "unknown processor"
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    loads = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    return (
        f"{model}, {os.cpu_count()} cores, {platform.system()} {platform.machine()}, Python {platform.python_version()}; "
        f"load averages {loads}"
    )


def table(rows: Sequence[Row], versions: Mapping[str, str], loads: Sequence[float]) -> str:
    """One table a unit, then versions and machine. A row has `code`, `unit`, `configuration`, `status` and what that brings."""
    parts = []
    for key, title in TITLES.items():
        chosen = [row for row in rows if row["unit"] == key]
        if not chosen:
            continue
        what = "determinant" if key == "a" else "image and Jacobian"
        parts.append(f"**{title}**: error of the {what} at most {power(WANTED[key], 0)}\n")
        parts.append("| code | configuration | setting | error | us a unit |\n|---|---|---|---|---|")
        order = {name: i for i, name in enumerate(NAMES)}
        parts += [line(row) for row in sorted(chosen, key=lambda row: order.get(row["code"], len(order)))]
        parts.append("")
    named = ", ".join(f"{name} {version}" for name, version in sorted(versions.items()))
    parts.append(f"Versions: {named}.\n")
    parts.append(f"Machine: {machine()}; between {min(loads, default=0.0):.1f} and {max(loads, default=0.0):.1f} while measuring.")
    return "\n".join(parts)


def line(row: Row) -> str:
    """One row of a table."""
    name, configuration = NAMES.get(row["code"], row["code"]), row["configuration"]
    if row["status"] == "ok":
        error = power(row["error"], 1)
        if row["unit"] == "a":
            error += f" ({power(row['deviation'], 1)})"
        return f"| {name} | {configuration} | {row['setting']} | {error} | {amount(row['median_us'])} |"
    said = {"unable": "cannot", "missed": "misses the error", "failed": "failed"}[row["status"]]
    return f"| {name} | {configuration} | | | {said}: {row['note']} |"


def amount(microseconds: float) -> str:
    """A time with two or three digits."""
    if microseconds >= 100.0:
        return f"{microseconds:,.0f}"
    return f"{microseconds:.1f}" if microseconds >= 10.0 else f"{microseconds:.2f}"
