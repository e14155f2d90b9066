"""Every example in the form of SimReady, judged by NVIDIA's rules, by those of OpenUSD, and by the memory of many references.

    python3.12 -m venv simready && simready/bin/pip install simready-validate==2026.8.0 \
        simready-foundation-tier-core==2026.8.0 omniverse-asset-validator==1.18.0
    python -m benchmarks.robotics_prop WORK --python simready/bin/python [--page docs/simready.md] [--examples NAME...]

It ends with status 1 if an example does not pass. WORK keeps the assets, which are written anew but not found anew.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

import anymesh
from anymesh.openusd.simready_ import simready_file

ROOT = Path(__file__).parents[1]
RULES = ROOT / "benchmarks" / "robotics_prop_rules.py"
BEGIN, END = "<!-- table: begin -->", "<!-- table: end -->"
NOT_WANTED = {  # requirements of optional features, and why assets need not meet them
    "RB.MB.001": "nothing moves",
    "GSP.001": "nothing moves",
    "VM.MDL.003": "MDL materials",
    "VM.PBR.001": "OpenPBR materials",
    "NVM.001": "materials for other sensors than cameras",
    "NVM.002": "materials for other sensors than cameras",
    "NVM.003": "materials for other sensors than cameras",
}
COPIES = 1000


def made(example: str, work: Path) -> list[Path]:
    """Return the files of an example that are judged."""
    folder = work / example
    how = {"formats": "usd,usdz", "profile": "simready"}
    if (folder / "asset.json").exists():
        anymesh.export_asset(folder, **how)
    else:
        anymesh.articulate(ROOT / f"examples/meshes/{example}.glb", folder, **how)
    return [folder / f for f in (simready_file(example), f"{example}.usdc", f"{example}.usdz")]


def line(example: str, told: list[dict]) -> str:
    """Return the row of an example."""
    ready, single, packed = told
    runs = [name for name in ("PHYSX", "NEWTON", "MUJOCO") if ready["features"][f"FET_003_{name}"]]
    issues = [sum(t["asset_validator"].values()) + len(t["usdchecker"]) for t in (ready, single, packed)]
    unmet = [
        f"{code} ({NOT_WANTED.get(code, 'wanted')})" for code in ready["unmet"] if "material" not in NOT_WANTED.get(code, "")
    ]
    verdict = "passed" if ready["passed"] else "failed"
    return f"| {example} | {verdict} | {', '.join(runs)} | {' / '.join(map(str, issues))} | {', '.join(unmet) or '-'} |"


def fails(told: list[dict]) -> bool:
    """Return whether an example does not pass, or a validator has something to say."""
    return not told[0]["passed"] or any(t["asset_validator"] or t["usdchecker"] for t in told)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=Path)
    parser.add_argument("--examples", nargs="*", default=sorted(p.stem for p in (ROOT / "examples/meshes").glob("*.glb")))
    parser.add_argument("--python", required=True)
    parser.add_argument("--page", type=Path)
    args = parser.parse_args()
    files = {example: made(example, args.work) for example in args.examples}
    every = [str(f) for some in files.values() for f in some]
    done = subprocess.run([args.python, str(RULES), *every], capture_output=True, text=True, check=True)
    report = json.loads(done.stdout.splitlines()[-1])
    told = {example: [report["files"][str(f)] for f in some] for example, some in files.items()}
    rows = [line(example, told[example]) for example in files]
    print("\n".join(rows))
    if args.page:
        first = str(next(iter(files.values()))[0])
        taken = [
            float(subprocess.run([args.python, str(RULES), "--memory", first, *way], capture_output=True, text=True).stdout)
            for way in (("1", "shared"), (str(COPIES), "shared"), (str(COPIES), "separate"))
        ]
        text = "\n".join([
            BEGIN,
            ", ".join(f"{name} {number}" for name, number in report["versions"].items()) + ".",
            "",
            "| example | profile | engines | issues of layers / usdc / usdz | optional requirements that are not met |",
            "|---|---|---|---|---|",
            *rows,
            "",
            f"One reference to {args.examples[0]} takes {taken[0]} MB, {COPIES} that are `instanceable` {taken[1]} MB, "
            f"and {COPIES} whose links can move {taken[2]} MB.",
            END,
        ])  # fmt: skip
        page = args.page.read_text(encoding="utf-8")
        args.page.write_text(re.sub(f"{BEGIN}.*?{END}", lambda _: text, page, flags=re.S), encoding="utf-8", newline="\n")
    sys.exit(any(fails(some) for some in told.values()))


if __name__ == "__main__":
    main()
