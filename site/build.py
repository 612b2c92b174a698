#!/usr/bin/env python3
"""Builds the site: the pages of the repository by MkDocs, the C++ interface by Doxygen.

    site/build.py OUTPUT
    site/build.py --check [ROOT]   only looks whether every link of a page leads somewhere, in the
                                   repository or in pages that are installed

Every page keeps its place, so that links between pages stay as they are. A file that a page links
to is copied beside it. Formulas, the fences ```math, are typeset by the MathJax of Debian's
libjs-mathjax, which is copied too. Nothing is fetched, and the site loads nothing from elsewhere.
"""

import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s#]+)(#[^)\s]*)?\)")
FENCE = re.compile(r"(^```.*?^```)", flags=re.S | re.M)
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# What TeX typeset as SVG takes of it: no fonts but outlines.
OF_MATHJAX = ["MathJax.js", "extensions/MathEvents.js", "extensions/AssistiveMML.js", "extensions/toMathML.js",
              "extensions/TeX/AMSmath.js", "extensions/TeX/AMSsymbols.js", "jax/element", "jax/input/TeX",
              "jax/output/SVG/config.js", "jax/output/SVG/jax.js", "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX"]

# What is found under which tab; other pages come last.
TABS = {
    "Start": ["README.md", "docs/python.md", "docs/studies.md", "docs/packaging.md", "docs/report.md",
              "docs/parallel.md", "docs/limits.md"],
    "Tutorial": ["docs/tutorial/*.md", "docs/library-tutorial.md"],
    "Physics": ["docs/surfactant.md", "docs/bulk-scalars.md", "docs/thermocapillarity.md",
                "docs/mass-transfer.md", "docs/inertia.md", "docs/generalised-newtonian.md",
                "docs/topology.md"],
    "Methods": ["docs/time-stepping.md", "docs/boundary-integrals.md", "docs/surface-remeshing.md",
                "docs/surfaces-and-curvature.md", "docs/volume-mesh.md", "docs/fields.md"],
    "Validation": ["docs/validation-stokes.md", "docs/validation-stokes-tables.md",
                   "docs/cost-against-error.md", "cases/README.md", "cases/*/README.md",
                   "docs/benchmark-stokes.md", "docs/benchmark-remeshing.md", "benchmark/README.md"],
    "Reference": ["docs/case-file.md", "docs/notation.md"],
    "Developers": ["docs/architecture.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/README.md"],
}


def pages(root=ROOT):
    """All pages, by their paths from the root."""
    patterns = ["*.md", "docs/*.md", "docs/tutorial/*.md", "cases/*.md", "cases/*/*.md",
                "benchmark/*.md"]
    return sorted({p.relative_to(root) for pattern in patterns for p in root.glob(pattern)})


def title_of(page):
    for line in (ROOT / page).read_text().splitlines():
        if line.startswith("# "):
            return line[2:].strip()
    return page.stem


def staged(page):
    """Where a page goes: MkDocs takes index.md for the page of a folder."""
    return page.with_name("index.md") if page.name == "README.md" else page


def slug(heading):
    """The name of a heading's place: of letters, digits and hyphens."""
    plain = re.sub(r"[`*]|\]\([^)]*\)|\[", "", heading).lower()
    return re.sub(r"[^a-z0-9_ -]", "", plain).strip().replace(" ", "-")


def places(page):
    text = FENCE.sub("", page.read_text())
    return {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, flags=re.M)}


def dead_links(root):
    """One line for each link of a page that leads nowhere."""
    dead = []
    for page in pages(root):
        text = re.sub(r"^```.*?^```|`[^`\n]*`", "", (root / page).read_text(), flags=re.S | re.M)
        for _, _, to, anchor in re.findall(r"(!?)\[([^\]]*)\]\(([^)\s#]*)(#[^)\s]*)?\)", text):
            if re.match(r"[a-z]+:", to):
                continue
            linked = (root / page.parent / to).resolve() if to else root / page
            if not linked.is_relative_to(root) or not linked.exists():
                dead.append(f"{page}: {to} does not exist")
            elif anchor and linked.suffix == ".md" and \
                    anchor[1:] not in places(linked):
                dead.append(f"{page}: {to}{anchor}: no such heading")
    return dead


def stage(page, target):
    """Copies a page and the files that it links to; a link to a folder leads to its list."""
    def link(match):
        mark, text, to, anchor = match.group(1), match.group(2), match.group(3), match.group(4) or ""
        if re.match(r"[a-z]+:", to):
            return match.group(0)
        linked = (ROOT / page.parent / to).resolve()
        if not linked.is_relative_to(ROOT) or not linked.exists():
            sys.exit(f"{page}: {to} does not exist")
        of_root = linked.relative_to(ROOT)
        if of_root.suffix == ".md":
            return f"{mark}[{text}]({to[:-len(of_root.name)]}{staged(of_root).name}{anchor})"
        if linked.is_dir():
            list_folder(of_root, target)
            return f"{mark}[{text}]({to.rstrip('/')}/contents.md)"
        copy_file(of_root, target)
        return match.group(0)

    to = target / staged(page)
    to.parent.mkdir(parents=True, exist_ok=True)
    parts = FENCE.split((ROOT / page).read_text())
    to.write_text("".join(part if FENCE.match(part) else LINK.sub(link, part) for part in parts))


def copy_file(of_root, target):
    (target / of_root).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / of_root, target / of_root)


def add_mathjax(target):
    """Copies what typesets formulas, and how it is set."""
    if not (MATHJAX / "MathJax.js").exists():
        sys.exit("site: libjs-mathjax is not installed; scripts/setup.sh docs installs it")
    for name in OF_MATHJAX:
        to = target / "mathjax" / name
        to.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (MATHJAX / name).is_dir() else shutil.copyfile)(MATHJAX / name, to)
    copy_file(pathlib.Path("site/formulas.js"), target)


def list_folder(folder, target):
    files = sorted(p.relative_to(ROOT) for p in (ROOT / folder).iterdir() if p.is_file())
    for file in files:
        if file.suffix != ".md":
            copy_file(file, target)
    (target / folder).mkdir(parents=True, exist_ok=True)
    lines = [f"- [{file.name}]({staged(file).name})" for file in files]
    (target / folder / "contents.md").write_text(f"# {folder}\n\n" + "\n".join(lines) + "\n")


def gallery(all_pages, target):
    """Every picture of the pages once, under the page that it belongs to."""
    lines, seen = ["# Gallery", ""], set()
    for page in all_pages:
        for mark, text, to, _ in LINK.findall(FENCE.sub("", (ROOT / page).read_text())):
            picture = (ROOT / page.parent / to).resolve()
            if not mark or picture in seen:
                continue
            seen.add(picture)
            lines += [f"![{text}]({picture.relative_to(ROOT)})", "",
                      f"{text} — [{title_of(page)}]({staged(page)})", ""]
    (target / "gallery.md").write_text("\n".join(lines) + "\n")


def tabs(all_pages):
    """The table of contents, as MkDocs reads it."""
    left, lines = list(all_pages), ["nav:"]

    def entry(page):
        left.remove(page)
        title = title_of(page).replace('"', "'")
        lines.append(f'      - "{title}": {staged(page)}')

    for tab, patterns in TABS.items():
        found = [p for pattern in patterns for p in sorted(left) if p.match(pattern) and
                 len(p.parts) == len(pathlib.Path(pattern).parts)]
        found = list(dict.fromkeys(found))
        if found:
            lines.append(f'  - "{tab}":')
        for page in found:
            entry(page)
        if tab == "Start":
            lines.append('      - "Gallery": gallery.md')
    if left:
        lines.append('  - "More":')
    for page in list(left):
        entry(page)
    return lines


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"VERSION (\d+\.\d+\.\d+)", text).group(1)


def run(command, **options):
    try:
        subprocess.run(command, check=True, **options)
    except FileNotFoundError:
        sys.exit(f"site: {command[0]} is not installed; scripts/setup.sh docs installs it")
    except subprocess.CalledProcessError as error:
        sys.exit(f"site: {command[0]} ended with status {error.returncode}")


def mend_summaries(api):
    """Doxygen links to a list of nested classes that it leaves out where all are private."""
    for page in api.glob("*.html"):
        text = page.read_text()
        if 'href="#nested-classes"' in text and 'name="nested-classes"' not in text:
            page.write_text(re.sub(r'<a href="#nested-classes">[^<]*</a>( &#124;)?\s*', "", text))


def build(output):
    work = output.with_name(output.name + "-pages")
    for folder in (work, output):
        shutil.rmtree(folder, ignore_errors=True)
    all_pages = pages()
    for page in all_pages:
        stage(page, work)
    gallery(all_pages, work)
    add_mathjax(work)
    # MkDocs looks for what its file names beside that file.
    configuration = work.with_suffix(".yml")
    configuration.write_text((ROOT / "site/mkdocs.yml").read_text() +
                             f"docs_dir: {work}\nsite_dir: {output}\n" +
                             "\n".join(tabs(all_pages) + ['  - "C++": api/index.html']) + "\n")
    run(["mkdocs", "build", "--quiet", "--config-file", str(configuration)])
    (output / "404.html").unlink()  # its links start at the root of a server
    doxyfile = ((ROOT / "site/Doxyfile").read_text() +
                f"OUTPUT_DIRECTORY = {output}\nPROJECT_NUMBER = {version()}\n")
    run(["doxygen", "-"], input=doxyfile.encode(), cwd=ROOT)
    mend_summaries(output / "api")
    shutil.rmtree(work)
    configuration.unlink()


if __name__ == "__main__":
    if len(sys.argv) != 2 and sys.argv[1:2] != ["--check"]:
        sys.exit(__doc__)
    if sys.argv[1] == "--check":
        root = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else ROOT
        dead = dead_links(root)
        if not pages(root):
            sys.exit(f"{root}: no pages")
        print("\n".join(dead) if dead else f"{len(pages(root))} pages: every link leads somewhere")
        sys.exit(1 if dead else 0)
    build(pathlib.Path(sys.argv[1]).resolve())
