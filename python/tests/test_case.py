import math
import unittest

import numpy as np

import meniscus
from common import SHEAR, FolderCase, program
from meniscus import Case


class CaseTest(FolderCase):
    def file(self, text):
        path = self.folder / "case.toml"
        path.write_text(text, encoding="utf-8")
        return path

    def test_dict_file_and_text_are_one_case(self):
        from_dict = Case.from_dict(SHEAR)
        text = from_dict.to_toml()
        self.assertEqual(Case.from_toml(text).to_toml(), text)
        self.assertEqual(Case(self.file(text)).to_toml(), text)
        self.assertEqual(Case.from_dict(from_dict.to_dict()).to_toml(), text)

    def test_values_are_those_given_and_the_defaults(self):
        case = Case.from_dict(SHEAR)
        self.assertEqual(case["flow.capillary-number"], 0.2)
        self.assertEqual(case["drop[0].nodes"], 42)
        self.assertEqual(case["drop.nodes"], 42)
        self.assertEqual(case["drop.viscosity-ratio"], 1.0)
        self.assertIsNone(case.get("flow.gradient"))
        with self.assertRaisesRegex(KeyError, "flow.colour"):
            case["flow.colour"]

    def test_set_takes_values_of_every_kind(self):
        case = Case.from_dict(SHEAR)
        case.set("flow.capillary-number", math.inf)
        case.set({"drop.nodes": np.int64(60), "drop.center": np.array([0.0, 0.5, 0.0]),
                  "title": 'A "drop"\n', "output.interval": np.float64(0.1)})
        self.assertEqual(case["flow.capillary-number"], math.inf)
        self.assertEqual(case["drop.center"], [0.0, 0.5, 0.0])
        self.assertEqual(case["title"], 'A "drop"\n')
        self.assertEqual(case["drop.nodes"], 60)

    def test_set_leaves_the_case_where_it_fails(self):
        case = Case.from_dict(SHEAR)
        before = case.to_toml()
        for changes in ({"drop.nodes": 60, "time.end": -1}, {"flow.colour": 1}, {"drop.nodes": 2.5},
                        {"time.end": math.nan}, {"time.end": None}, {"drop.center": [0, 1]}):
            with self.assertRaises(ValueError, msg=changes):
                case.set(changes)
        self.assertEqual(case.to_toml(), before)
        copy = case.copy()
        copy.set("time.end", 7)
        self.assertEqual(case.to_toml(), before)

    def test_errors_are_the_lines_of_the_program(self):
        good = Case.from_dict(SHEAR).to_toml()
        for old, new in (("end = 0.2", "end = -1"), ("simple-shear", "simple-sheer"),
                         ("nodes = 42", "knodes = 42"), ("[flow]", "[flow")):
            path = self.file(good.replace(old, new))
            with self.assertRaises(ValueError) as caught:
                Case(path)
            self.assertIn(str(caught.exception), program("run", path, "-o", self.folder / "run", status=2))
        with self.assertRaises(ValueError) as caught:
            Case(self.folder / "none.toml")
        self.assertIn(str(caught.exception), program("run", self.folder / "none.toml", status=2))

    def test_what_is_no_case_is_refused(self):
        for wrong in (3, [1], {"flow": {1: 2}}, {"flow": {"kind": object()}}):
            with self.assertRaises(ValueError, msg=wrong):
                Case.from_dict(wrong)
        with self.assertRaisesRegex(ValueError, "^dict: .*flow.kind"):
            Case.from_dict({"flow": {"kind": "sheer"}, "drop": [{}]})
        with self.assertRaises(ValueError):
            Case.from_toml(b"")

    def test_explains_keys(self):
        self.assertIn("capillary", meniscus.explain("flow.capillary-number"))
        with self.assertRaisesRegex(ValueError, "capillary-number"):
            meniscus.explain("flow.capilary-number")


if __name__ == "__main__":
    unittest.main()
