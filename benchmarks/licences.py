"""The licences of all that is installed beside this package, as each distribution states its own.

python -m benchmarks.licences [--markdown FILE]
"""

from __future__ import annotations

import argparse
from collections import Counter
from importlib.metadata import distributions
from pathlib import Path


def licences() -> dict[str, tuple[str, str]]:
    """Version and licence of each distribution by its name."""
    found = {}
    for package in distributions():
        metadata = package.metadata
        classifiers = [c.rpartition(":: ")[2] for c in metadata.get_all("Classifier") or [] if c.startswith("License")]
        words = (metadata.get("License") or "").strip().splitlines()
        text = metadata.get("License-Expression") or ", ".join(classifiers) or (words[0] if words else "not stated")
        found[str(metadata["Name"])] = (package.version, text[:80])
    return dict(sorted(found.items(), key=lambda item: item[0].lower()))


def main() -> None:
    parser = argparse.ArgumentParser(description="Licences of what is installed.")
    parser.add_argument("--markdown", type=Path, help="file to write the table to")
    how = parser.parse_args()
    rows = [f"| {name} | {version} | {text} |" for name, (version, text) in licences().items()]
    table = "\n".join(["| package | version | licence |", "|---|---|---|", *rows, ""])
    if how.markdown:
        how.markdown.write_text(table, encoding="utf-8")
    else:
        print(table)
    for text, count in Counter(text for _, text in licences().values()).most_common():
        print(f"{count:4d}  {text}")


if __name__ == "__main__":
    main()
