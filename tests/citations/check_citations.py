#!/usr/bin/env python3
"""Fails on a key cited in a comment or a page of the docs that docs/references.bib does not hold.

    check_citations.py ROOT
"""
import re
import sys
from pathlib import Path

KEY = re.compile(r"\b[a-z]+(?:-[a-z]+)?(?:18|19|20)\d\d[a-z]?\b")
ENTRY = re.compile(r"^@\w+\{([^,\s]+),", re.MULTILINE)
FOLDERS = {"meniscus": (".hpp", ".cpp"), "tests": (".hpp", ".cpp"), "bench": (".hpp", ".cpp"),
           "docs": (".md",), "cases": (".md",), ".": (".md",)}


def files(root):
    for folder, suffixes in FOLDERS.items():
        search = (root / folder).glob if folder == "." else (root / folder).rglob
        yield from sorted(f for f in search("*") if f.suffix in suffixes)


def prose(file, line):
    """The part of a line that can cite: all of a page, the comment of a source line."""
    return line if file.suffix == ".md" else line.partition("//")[2]


def citations(root):
    for file in files(root):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            for key in KEY.findall(prose(file, line)):
                yield key, f"{file}:{number}"


def faults(root):
    keys = ENTRY.findall((root / "docs/references.bib").read_text(encoding="utf-8"))
    for key in sorted({k for k in keys if keys.count(k) > 1}):
        yield f"docs/references.bib: {key} is there twice"
    for key, place in citations(root):
        if key not in keys:
            yield f"{place}: {key} is not in docs/references.bib"


def main():
    found = list(faults(Path(sys.argv[1])))
    print("\n".join(found) if found else "citations: every key is in docs/references.bib")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
