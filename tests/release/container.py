#!/usr/bin/env python3
"""Runs the lines of the Containerfile, which are the steps of README.md, in a bare Debian 12.

    container.py ROOT          # of the repository; as root; builds the program: half an hour on two cores
"""
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from bare_debian import BareDebian, require


def instructions(text):
    """(word, rest) of each line; a line that ends in a backslash goes on in the next."""
    for line in text.replace("\\\n", " ").splitlines():
        if line.strip() and not line.startswith("#"):
            word, _, rest = line.partition(" ")
            yield word, rest.strip()


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    require(["mmdebstrap", "unshare", "chroot", "git"])
    root, folder = Path(sys.argv[1]).resolve(), "/"
    with BareDebian("bookworm") as debian:
        for word, rest in instructions((root / "Containerfile").read_text(encoding="utf-8")):
            if word == "FROM":
                if rest not in ("debian:12", "debian:bookworm"):
                    sys.exit(f"FAILED: FROM {rest}: this test makes Debian 12 only")
            elif word == "WORKDIR":
                folder = rest
            elif word == "COPY":
                source, target = rest.split()
                if source != ".":
                    sys.exit(f"FAILED: COPY {source}: this test copies the whole tree only")
                (debian.path / target.lstrip("/")).mkdir(parents=True)
                with tempfile.TemporaryFile() as archive:
                    subprocess.run(["git", "-C", str(root), "archive", "HEAD"], stdout=archive, check=True)
                    archive.seek(0)
                    with tarfile.open(fileobj=archive) as tree:
                        tree.extractall(debian.path / target.lstrip("/"))
            elif word == "RUN":
                debian.run(rest, folder=folder)
            elif word not in ("CMD", "ENTRYPOINT"):
                sys.exit(f"FAILED: {word}: this test does not know this instruction")
        debian.run("meniscus --version && test -s out/shear-subcritical/report.html", folder=folder, quiet=False)
    print("container: every line of the Containerfile ran in a bare Debian 12")


if __name__ == "__main__":
    main()
