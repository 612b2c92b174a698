#!/usr/bin/env python3
"""The check of the metadata finds each kind of fault, and none in the tree itself."""
import shutil
import tempfile
import unittest
from pathlib import Path

import check_metadata

ROOT = Path(__file__).resolve().parents[2]
FILES = ("CMakeLists.txt", "CITATION.cff", "codemeta.json", "README.md", "CHANGELOG.md")


def faults(name=None, old="", new=""):
    with tempfile.TemporaryDirectory() as folder:
        for file in FILES:
            shutil.copy(ROOT / file, folder)
        if name:
            file = Path(folder) / name
            text = file.read_text(encoding="utf-8")
            assert old in text, (name, old)
            file.write_text(text.replace(old, new), encoding="utf-8")
        return list(check_metadata.faults(Path(folder)))


class Metadata(unittest.TestCase):
    def rejects(self, name, old, new, *words):
        found = faults(name, old, new)
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])

    def test_the_tree(self):
        self.assertEqual(faults(), [])

    def test_versions(self):
        self.rejects("CITATION.cff", "version: 0.1.0\nl", "version: 0.2.0\nl", "CITATION.cff: version 0.2.0")
        self.rejects("codemeta.json", '"version": "0.1.0"', '"version": "0.2.0"', "codemeta.json: version 0.2.0")

    def test_unreadable(self):
        self.rejects("CITATION.cff", "title: ", "title ", "CITATION.cff:4")
        self.rejects("CITATION.cff", "license: GPL", "license: GPL: ", "CITATION.cff:7")
        self.rejects("codemeta.json", '"name"', "name", "codemeta.json")

    def test_what_is_missing_or_differs(self):
        self.rejects("CITATION.cff", "type: software\n", "", "has no type")
        self.rejects("codemeta.json", "GPL-3.0-or-later", "MIT", "license")
        self.rejects("codemeta.json", "The Meniscus developers", "Somebody", "author")
        self.rejects("codemeta.json", '"readme": "README.md"', '"readme": "READ.md"', "readme")


if __name__ == "__main__":
    unittest.main()
