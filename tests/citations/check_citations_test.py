#!/usr/bin/env python3
"""The citation check finds a key without an entry in comments and pages, and not in code."""
import tempfile
import unittest
from pathlib import Path

import check_citations

BIB = "@article{taylor1934,\n  year = {1934},\n}\n"


def faults(files, bib=BIB):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in (files | {"docs/references.bib": bib}).items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return [f.replace(folder, "") for f in check_citations.faults(root)]


class Citations(unittest.TestCase):
    def test_known_key(self):
        self.assertEqual(faults({"meniscus/flow/a.hpp": "/// Rate [taylor1934, eq. 3].\n"}), [])

    def test_unknown_key_in_a_docstring(self):
        found = faults({"meniscus/flow/a.hpp": "int a;\n/// Rate of tailor1934.\n"})
        self.assertEqual(found, ["/meniscus/flow/a.hpp:2: tailor1934 is not in docs/references.bib"])

    def test_unknown_key_in_a_page(self):
        self.assertEqual(len(faults({"README.md": "[nobody1999]\n", "docs/a.md": "nobody1999"})), 2)

    def test_code_does_not_cite(self):
        self.assertEqual(faults({"meniscus/core/a.cpp": "int year2001 = 2001;\n"}), [])

    def test_entry_twice(self):
        self.assertEqual(faults({}, BIB + BIB), ["docs/references.bib: taylor1934 is there twice"])


if __name__ == "__main__":
    unittest.main()
