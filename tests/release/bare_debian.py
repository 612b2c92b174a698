"""A bare Debian in a folder, made by mmdebstrap, to try things in: what is installed there is all that they have."""
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCES = Path("/etc/apt/sources.list.d/debian.sources")


def require(tools):
    """Ends the test with the name of what it lacks: it cannot pass without, and does not skip."""
    if os.geteuid() != 0:
        sys.exit("FAILED: root is needed, to make a Debian root, mount /proc in it and chroot to it")
    for tool in tools:
        if not shutil.which(tool):
            sys.exit(f"FAILED: {tool} is needed: scripts/setup.sh release installs it")
    mounted = subprocess.run(["unshare", "--mount", "--pid", "--fork", "true"], capture_output=True, text=True)
    if mounted.returncode != 0:
        sys.exit(f"FAILED: the privilege to make mount namespaces (CAP_SYS_ADMIN) is needed: {mounted.stderr.strip()}")


class BareDebian:
    """`with BareDebian("bookworm") as debian: debian.run("apt-get update")`; the folder goes at the end."""

    def __init__(self, release):
        self.release = release

    def __enter__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="bare-debian-")
        self.path = Path(self._folder.name) / "root"
        # The machine's own mirrors, where it says so in the present form; else mmdebstrap's.
        sources = []
        if SOURCES.exists():
            of_release = Path(self._folder.name) / "debian.sources"
            of_release.write_text(SOURCES.read_text().replace("bookworm", self.release))
            sources = [str(of_release)]
        command = ["mmdebstrap", "--quiet", "--variant=minbase", self.release, str(self.path), *sources]
        began = time.monotonic()
        subprocess.run(command, check=True)
        print(f"a bare Debian {self.release}: {time.monotonic() - began:.0f} s", flush=True)
        shutil.copy("/etc/resolv.conf", self.path / "etc/resolv.conf")
        self.run("apt-get -qq update")
        return self

    def __exit__(self, *failure):
        self._folder.cleanup()

    def run(self, command, *, user="root", folder="/", status=0, quiet=True):
        """Runs a shell command in the root, with /proc and a private /dev/shm. Returns what it printed.
        Any other exit status than `status` ends the test."""
        root = shlex.quote(str(self.path))
        inside = f"cd {shlex.quote(folder)} && {command}"
        enter = f"chroot --userspec={user} {root} /usr/bin/env -i " \
                f"HOME={'/root' if user == 'root' else '/tmp'} PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin " \
                f"DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 OMP_NUM_THREADS=1 bash -euo pipefail -c {shlex.quote(inside)}"
        script = f"mount -t proc proc {root}/proc && mount -t tmpfs tmpfs {root}/dev/shm && exec {enter}"
        began = time.monotonic()
        done = subprocess.run(["unshare", "--mount", "--pid", "--fork", "--kill-child", "sh", "-c", script],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        print(f"$ {command} -> {done.returncode}, {time.monotonic() - began:.0f} s", flush=True)
        if done.returncode != status or not quiet:
            print(done.stdout, flush=True)
        if done.returncode != status:
            sys.exit(f"FAILED: expected status {status}")
        return done.stdout

    def megabytes(self):
        return round(int(self.run("du -sxm /").split()[0]))
