#!/usr/bin/env python3
"""Checks a built site: no link within it is dead, and no page loads anything from elsewhere, or has what the theme's
script would load something for.

    site/check_links.py SITE
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

# What a browser fetches by itself, by element and attribute.
LOADED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("video", "src"),
          ("object", "data"), ("embed", "src")}
# What the theme's script loads something from elsewhere for, by attribute and word.
FETCHING = (("class", "mermaid"), ("data-md-component", "source"))
LOADED_RELATIONS = {"stylesheet", "icon", "preload", "preconnect", "dns-prefetch", "manifest"}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors, self.fetching = [], [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = {name: value or "" for name, value in attributes}
        self.anchors.update(values[name] for name in ("id", "name") if name in values)
        self.fetching += [f'{name}="{word}"' for name, word in FETCHING if word in values.get(name, "").split()]
        is_loaded = tag == "link" and LOADED_RELATIONS & set(values.get("rel", "").split())
        for name in ("href", "src", "data"):
            if name not in values or (name == "data" and tag != "object"):
                continue
            where = self.loaded if is_loaded or (tag, name) in LOADED else self.links
            where.append(values[name])


def faults_of(site):
    """One line for each dead link and each thing loaded from elsewhere."""
    pages = {path: Page(path.read_text(errors="replace")) for path in sorted(site.rglob("*.html"))}
    if not pages:
        return [f"{site}: no pages"]
    faults = []
    for path, page in pages.items():
        name = path.relative_to(site)
        faults += [f"{name}: {what} makes the theme load from elsewhere" for what in page.fetching]
        for link in page.links + page.loaded:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loaded and parts.scheme not in ("data", "javascript"):
                    faults.append(f"{name}: loads {link}")
                continue
            to = path if not parts.path else (path.parent / urllib.parse.unquote(parts.path))
            to = pathlib.Path(*to.parts).resolve()
            if to.is_dir():
                to = to / "index.html"
            if not to.is_relative_to(site.resolve()) or not to.exists():
                faults.append(f"{name}: {link} leads nowhere")
                continue
            anchor = urllib.parse.unquote(parts.fragment)
            if anchor and to in pages and anchor not in pages[to].anchors and \
                    not anchor.startswith("__"):
                faults.append(f"{name}: {link} has no such place")
    for path in sorted(site.rglob("*.css")):
        for url in re.findall(r"(?:@import\s+|url\()['\"]?((?:https?:)?//[^'\")\s]+)",
                              path.read_text(errors="replace")):
            faults.append(f"{path.relative_to(site)}: loads {url}")
    return faults


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = faults_of(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(found[:40]) if found else "every link leads somewhere; nothing is loaded from elsewhere")
    if len(found) > 40:
        print(f"and {len(found) - 40} more")
    sys.exit(1 if found else 0)
