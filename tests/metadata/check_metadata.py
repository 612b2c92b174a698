#!/usr/bin/env python3
"""Fails where CITATION.cff or codemeta.json cannot be read, lacks an entry, or disagrees with CMakeLists.txt.

    check_metadata.py ROOT

CITATION.cff is read by the part of YAML that it keeps to: "key: text" at the margin, and below a key without text a list of
texts or of "- key: text".
"""
import json
import re
import sys
from pathlib import Path

NEEDED = {"cff-version", "message", "type", "title", "abstract", "version", "license", "authors"}
LINE = re.compile(r"(?P<key>[a-z-]+):(?: (?P<value>\S.*))?$")
ITEM = re.compile(r"  - (?P<value>\S.*)$")


def read_cff(text):
    """The entries of the file; a list where a key has one. Raises ValueError at a line it cannot read."""
    entries, key = {}, None
    for number, line in enumerate(text.splitlines(), 1):
        if item := ITEM.match(line):
            if not isinstance(entries.get(key), list):
                raise ValueError(f"CITATION.cff:{number}: an item below no list")
            entries[key].append(item["value"])
            continue
        entry = LINE.match(line)
        if not entry or entry["key"] in entries or (entry["value"] and re.search(r": | #", entry["value"])):
            raise ValueError(f"CITATION.cff:{number}: cannot be read: {line}")
        key = entry["key"]
        entries[key] = entry["value"] if entry["value"] else []
    return entries


def faults(root):
    project = re.search(r"project\(meniscus VERSION (\S+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"))
    try:
        cff = read_cff((root / "CITATION.cff").read_text(encoding="utf-8"))
    except ValueError as error:
        yield str(error)
        return
    try:
        meta = json.loads((root / "codemeta.json").read_text(encoding="utf-8"))
    except ValueError as error:
        yield f"codemeta.json: {error}"
        return
    for key in sorted(NEEDED - cff.keys()):
        yield f"CITATION.cff: has no {key}"
    if not cff.get("authors"):
        yield "CITATION.cff: authors: is empty"
    for name, entries in (("CITATION.cff", cff), ("codemeta.json", meta)):
        if entries.get("version") != project[1]:
            yield f"{name}: version {entries.get('version')} is not {project[1]} of CMakeLists.txt"
    if str(meta.get("license", "")).rpartition("/")[2] != cff.get("license"):
        yield f"codemeta.json: license {meta.get('license')} is not {cff.get('license')} of CITATION.cff"
    if meta.get("description") != cff.get("abstract"):
        yield "codemeta.json: description differs from abstract of CITATION.cff"
    authors = [f"name: {author['name']}" for author in meta.get("author", [])]
    if authors != cff.get("authors"):
        yield f"codemeta.json: author {authors} is not authors of CITATION.cff"
    for key in ("readme", "buildInstructions", "releaseNotes"):
        if not (root / str(meta.get(key))).is_file():
            yield f"codemeta.json: {key}: {meta.get(key)} is not there"


def main():
    found = list(faults(Path(sys.argv[1])))
    print("\n".join(found) if found else "metadata: CITATION.cff and codemeta.json agree with CMakeLists.txt")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
