#!/usr/bin/env python3
"""The lockfile of web/ names every package by version and hash, and no host: lockfile.py ROOT"""
import json
import re
import sys
from pathlib import Path


def main():
    folder = Path(sys.argv[1]) / "web"
    text = (folder / "package-lock.json").read_text(encoding="utf-8")
    hosts = re.findall(r"\w+://[^\"]*", text)
    if hosts or '"resolved"' in text:
        sys.exit(f"web/package-lock.json names where packages come from: {hosts[:3]}")
    for name, package in json.loads(text)["packages"].items():
        if name and not ("version" in package and package.get("integrity", "").startswith("sha512-")):
            sys.exit(f"web/package-lock.json: {name} has no version or no hash")
    if "omit-lockfile-registry-resolved=true" not in (folder / ".npmrc").read_text(encoding="utf-8"):
        sys.exit("web/.npmrc does not keep hosts out of the lockfile")
    print("lockfile: names no host")


if __name__ == "__main__":
    main()
