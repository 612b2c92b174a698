#!/usr/bin/env python3
"""The Debian packages in a bare Debian 12: installed by apt, used, built against, removed; and refused by another release.
The notebooks are run there too.

    packages.py FOLDER          # holds meniscus_*.deb and libmeniscus-dev_*.deb; as root

Needs mmdebstrap, a mirror of Debian and the privilege to mount and chroot; fails, and names it, where one is missing.
"""
import re
import shutil
import sys
from pathlib import Path

from bare_debian import BareDebian, require

TESTS = Path(__file__).resolve().parents[1]
APT = "apt-get -qq -y install --no-install-recommends"

# Runs the cells of notebooks as Jupyter does, one after the other.
NOTEBOOKS = """import json, sys
for file in sys.argv[1:]:
    names = {"__name__": "__main__"}
    for cell in json.load(open(file, encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{file} {cell['id']}", "exec"), names)
    print("ran", file)
"""


def only(folder, pattern):
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        sys.exit(f"FAILED: {folder}: {len(found)} files {pattern}; make deb makes one")
    return found[0]


def expect(condition, text):
    if not condition:
        sys.exit(f"FAILED: {text}")


def check_program(debian):
    """What a user does, with nothing but the package and as nobody in particular."""
    debian.run("mkdir /tmp/use && chmod 777 /tmp/use")

    def use(command, status=0):
        return debian.run(command, user="nobody:nogroup", folder="/tmp/use", status=status)

    expect(use("meniscus --version").startswith("meniscus "), "no version")
    use("meniscus examples shear-subcritical")
    use("meniscus run shear-subcritical.toml --set time.end=0.2 -q")
    rows = use("cat shear-subcritical/history.csv").splitlines()
    expect(len(rows) > 2 and float(rows[-1].split(",")[1]) >= 0.2, "the run did not come to its end")
    use("test -s shear-subcritical/report.html -a -s shear-subcritical/surface.pvd -a -s shear-subcritical/ro-crate-metadata.json")
    use("meniscus check uniaxial-extension --against /usr/share/doc/meniscus/benchmark/uniaxial-extension.csv")
    for name in ("uniaxial-extension", "cases/uniaxial-extension"):
        use(f"meniscus check {name} --recorded")
    said = use("meniscus study studies/critical-extension.toml 2>&1", status=2)
    expect("/usr/share/doc/meniscus/studies/critical-extension.toml" in said, f"no hint at the shipped study: {said}")
    use("meniscus run none.toml", status=2)
    expect("remesh" in use("zcat /usr/share/man/man1/meniscus.1.gz"), "no manual page")
    words = use("source /usr/share/bash-completion/completions/meniscus; COMP_WORDS=(meniscus rem); COMP_CWORD=1; "
                "_meniscus; echo ${COMPREPLY[@]}; COMP_WORDS=(meniscus examples shear-); COMP_CWORD=2; _meniscus; "
                "echo ${COMPREPLY[@]}; COMP_WORDS=(meniscus run --over); _meniscus; echo ${COMPREPLY[@]}")
    expect(words.split() == ["remesh", "shear-subcritical", "--overwrite"], f"completion gives {words.split()}")


def check_pictures(debian):
    """Stills and films, by what is recommended."""
    debian.run("meniscus report shear-subcritical --svg --png --movie && "
               "test -s shear-subcritical/interface.svg -a -s shear-subcritical/interface.png -a "
               "-s shear-subcritical/interface.mp4", user="nobody:nogroup", folder="/tmp/use")


def check_python(debian):
    """The module, and the notebooks as they are installed."""
    (debian.path / "tmp/use/cells.py").write_text(NOTEBOOKS, encoding="utf-8")

    def use(command):
        return debian.run(command, user="nobody:nogroup", folder="/tmp/use", quiet=False)

    use("/usr/bin/python3 -c \"import meniscus; print(meniscus.__file__, meniscus.explain('drop.nodes'))\"")
    use("cp -r /usr/share/doc/meniscus/examples . && cd examples/notebooks && MPLBACKEND=Agg python3 ../../cells.py *.ipynb")


def check_library(debian):
    shutil.copytree(TESTS / "package", debian.path / "tmp/consumer")
    debian.run("cmake -S /tmp/consumer -B /tmp/consumer/build -G Ninja -DCMAKE_BUILD_TYPE=Release && "
               "cmake --build /tmp/consumer/build")
    debian.run("/tmp/consumer/build/consumer", quiet=False)


def copy_packages(debian, packages):
    (debian.path / "packages").mkdir()
    for package in packages:
        shutil.copy(package, debian.path / "packages")


def check_use(packages):
    """Both packages in the Debian that they are made for: installed, used, removed."""
    with BareDebian("bookworm") as debian:
        copy_packages(debian, packages)
        debian.measured("meniscus and what it needs", f"{APT} ./packages/meniscus_*.deb")
        development = debian.run("dpkg-query -W -f='${Package}\\n' | grep -e '-dev$' || true").split()
        expect(not development, f"meniscus pulls in {development}")
        check_program(debian)
        recommended = re.sub(r"\([^)]*\)|,", "", debian.run("dpkg-query -W -f='${Recommends}' meniscus"))
        debian.measured(f"what it recommends ({recommended})", f"{APT} {recommended}")
        check_python(debian)
        check_pictures(debian)
        debian.measured("libmeniscus-dev, compilers and what they need",
                        f"{APT} ./packages/libmeniscus-dev_*.deb g++ cmake ninja-build")
        check_library(debian)
        debian.run("apt-get -qq -y purge meniscus libmeniscus-dev")
        left = debian.run("find /usr /etc /var/lib/dpkg/info -iname '*meniscus*'").split()
        expect(not left, f"after their removal there are {left}")


def check_refusal(packages, release):
    """Another release of Debian refuses them by what they depend on, in the words of its apt."""
    with BareDebian(release) as debian:
        copy_packages(debian, packages)
        for package in packages:
            refusal = debian.run(f"{APT} ./packages/{package.name} 2>&1", status=100)
            expect(re.search("unmet dependencies|Unable to satisfy dependencies", refusal) and "Depends" in refusal,
                   f"apt says {refusal}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    require(["mmdebstrap", "unshare", "chroot"])
    packages = [only(Path(sys.argv[1]), "meniscus_*.deb"), only(Path(sys.argv[1]), "libmeniscus-dev_*.deb")]
    check_use(packages)
    check_refusal(packages, "trixie")
    print("packages: installed, used, built against and removed in a bare Debian 12; refused by Debian 13")


if __name__ == "__main__":
    main()
