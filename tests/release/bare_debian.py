"""A bare Debian in a folder, made by mmdebstrap, to try things in: what is installed there is all that they have."""
import os
import shlex
import shutil
import subprocess
import sys
import tarfile
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
    """`with BareDebian("bookworm") as debian: debian.run("apt-get update")`; the folder goes at the end.
    `share` maps folders of this machine to where they are seen in the root."""

    def __init__(self, release, share=None):
        self.release = release
        self.share = share or {}

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
        # A root that goes away need not reach the disk, and its downloads are no part of its size.
        (self.path / "etc/dpkg/dpkg.cfg.d").mkdir(exist_ok=True)
        (self.path / "etc/dpkg/dpkg.cfg.d/unsafe-io").write_text("force-unsafe-io\n")
        (self.path / "etc/apt/apt.conf.d/keep-nothing").write_text('APT::Keep-Downloaded-Packages "false";\n')
        for inside in self.share.values():
            (self.path / inside.lstrip("/")).mkdir(parents=True, exist_ok=True)
        self.run("apt-get -qq update")
        return self

    def __exit__(self, *failure):
        self._folder.cleanup()

    def run(self, command, *, user="root", folder="/", status=0, quiet=True):
        """Runs a shell command in the root, with /proc, /dev/pts and a private /dev/shm. Returns what it printed.
        Any other exit status than `status` ends the test."""
        root = shlex.quote(str(self.path))
        inside = f"cd {shlex.quote(folder)} && {command}"
        enter = f"chroot --userspec={user} {root} /usr/bin/env -i " \
                f"HOME={'/root' if user == 'root' else '/tmp'} PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin " \
                f"DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 OMP_NUM_THREADS=1 bash -euo pipefail -c {shlex.quote(inside)}"
        mounts = [f"-t proc proc {root}/proc", f"-t tmpfs tmpfs {root}/dev/shm", f"-t devpts devpts {root}/dev/pts"]
        mounts += [f"--bind {shlex.quote(outside)} {root}{shlex.quote(inside)}" for outside, inside in self.share.items()]
        script = " && ".join([*(f"mount {mount}" for mount in mounts), f"exec {enter}"])
        began = time.monotonic()
        done = subprocess.run(["unshare", "--mount", "--pid", "--fork", "--kill-child", "sh", "-c", script],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        print(f"$ {command} -> {done.returncode}, {time.monotonic() - began:.0f} s", flush=True)
        if done.returncode != status or not quiet:
            print(done.stdout, flush=True)
        if done.returncode != status:
            sys.exit(f"FAILED: expected status {status}")
        return done.stdout

    def copy_tree(self, repository, target):
        """Copies what the last commit of a repository holds."""
        folder = self.path / target.lstrip("/")
        folder.mkdir(parents=True)
        with tempfile.TemporaryFile() as archive:
            subprocess.run(["git", "-C", str(repository), "archive", "HEAD"], stdout=archive, check=True)
            archive.seek(0)
            with tarfile.open(fileobj=archive) as tree:
                tree.extractall(folder)

    def measured(self, title, command, **how):
        """Runs a command and prints its wall time, and how many packages and megabytes it added."""
        before, began = self._size(), time.monotonic()
        printed = self.run(command, **how)
        packages, megabytes = (now - then for now, then in zip(self._size(), before))
        print(f"{title}: {time.monotonic() - began:.0f} s, {packages} packages, {megabytes} MB", flush=True)
        return printed

    def _size(self):
        """Packages that are installed, and megabytes on the disk."""
        packages = list((self.path / "var/lib/dpkg/info").glob("*.list"))
        size = subprocess.run(["du", "-sxm", str(self.path)], capture_output=True, text=True, check=True)
        return len(packages), int(size.stdout.split()[0])
