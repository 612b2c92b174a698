#!/usr/bin/env python3
"""Runs the lines of the Containerfile, which are the steps of README.md, in a bare Debian 12; then `make deb` and
`make docs` there. Tells the time, the packages and the disk space that each line takes.

    container.py ROOT [CACHE]  # ROOT: of the repository; as root; builds the program: half an hour on two cores

CACHE is a folder of ccache's that the compilers of the root may use too.
"""
import sys
from pathlib import Path

from bare_debian import BareDebian, require


def instructions(text):
    """(word, rest) of each line; a line that ends in a backslash goes on in the next."""
    for line in text.replace("\\\n", " ").splitlines():
        if line.strip() and not line.startswith("#"):
            word, _, rest = line.partition(" ")
            yield word, rest.strip()


def follow(debian, root):
    """What the instructions say. Returns the folder that they leave one in."""
    folder = "/"
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
            debian.copy_tree(root, target)
        elif word == "RUN":
            debian.measured(f"RUN {rest}", rest, folder=folder)
        elif word not in ("CMD", "ENTRYPOINT"):
            sys.exit(f"FAILED: {word}: this test does not know this instruction")
    return folder


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    require(["mmdebstrap", "unshare", "chroot", "git"])
    root = Path(sys.argv[1]).resolve()
    share = {sys.argv[2]: "/root/.cache/ccache"} if len(sys.argv) == 3 else {}
    with BareDebian("bookworm", share) as debian:
        if share:
            debian.run("apt-get -qq -y install --no-install-recommends ccache")
            (debian.path / "root/.config/ccache").mkdir(parents=True)
            (debian.path / "root/.config/ccache/ccache.conf").write_text(
                "base_dir = /meniscus\nhash_dir = false\ncache_dir = /root/.cache/ccache\n")
        folder = follow(debian, root)
        debian.run("meniscus --version && test -s out/shear-subcritical/report.html", folder=folder, quiet=False)
        debian.measured("make deb", "make deb", folder=folder, quiet=False)
        debian.measured("make docs", "make docs", folder=folder, quiet=False)
    print("container: every line of the Containerfile, make deb and make docs ran in a bare Debian 12")


if __name__ == "__main__":
    main()
