import copy
import math
import pickle
import unittest

import numpy as np

import meniscus
from common import SHEAR, FolderCase, program
from meniscus import Case
from misfits import WRONG_PATHS, WRONG_TEXTS


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
        other = case.copy()
        other.set("time.end", 7)
        self.assertEqual(case.to_toml(), before)

    def test_copies_and_pickles_are_cases_of_their_own(self):
        case = Case.from_dict(SHEAR, self.folder)
        for made in (copy.copy(case), copy.deepcopy(case), pickle.loads(pickle.dumps(case))):
            made.set("time.end", 7)
            self.assertEqual((made["time.end"], case["time.end"]), (7.0, 0.2))
            self.assertEqual(made._core.folder, case._core.folder)

    def test_every_character_of_a_title_reads_back(self):
        title = "".join(map(chr, range(1, 256)))
        self.assertEqual(Case.from_dict(SHEAR | {"title": title})["title"], title)

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
        for wrong, words in (({"drop": [{}, 3]}, "drop: a list of tables holds dicts alone, not 3"),
                             ({"title": None}, "title: the value is missing"),
                             ({"title": "\ud800"}, "title = .* half of a surrogate pair"),
                             ({"time": {"end": 10**400}}, r"time.end must be a whole number from -2\^63")):
            with self.assertRaisesRegex(ValueError, words):
                Case(SHEAR | wrong)
        endless = {}
        endless["flow"] = endless
        with self.assertRaisesRegex(ValueError, "without end"):
            Case(endless)

    def test_takes_nested_dicts_and_settings(self):
        case = Case(SHEAR, {"time.end": 0.3})
        self.assertEqual(case["time.end"], 0.3)
        case.set("time.end", 0.2)
        self.assertEqual(case.to_toml(), Case.from_dict(SHEAR).to_toml())
        with self.assertRaisesRegex(ValueError, "^time.end = -1.0 must be at least 0"):
            Case(SHEAR, {"time.end": -1})

    def test_wrong_types_are_refused_by_name(self):
        case = Case(SHEAR)
        for wrong in WRONG_PATHS:
            if not isinstance(wrong, dict):
                with self.assertRaisesRegex(ValueError, "^path ", msg=wrong):
                    Case(wrong)
        for wrong in WRONG_TEXTS:
            with self.assertRaisesRegex(ValueError, "^folder ", msg=wrong):
                Case.from_toml(case.to_toml(), wrong)
            with self.assertRaisesRegex(ValueError, "^folder ", msg=wrong):
                Case.from_dict(SHEAR, wrong)
            for use, name in ((Case.from_toml, "text"), (case.__getitem__, "key"), (case.get, "key"),
                              (lambda given: case.set(given, 1), "key"), (meniscus.explain, "key"),
                              (meniscus.set_log_level, "level")):
                if not (isinstance(wrong, dict) and use.__name__ == "<lambda>"):
                    with self.assertRaisesRegex(ValueError, f"^{name} ", msg=wrong):
                        use(wrong)
        for wrong in (3, "", [], True):
            with self.assertRaisesRegex(ValueError, "settings must be a dict"):
                Case(SHEAR, wrong)

    def test_set_says_what_is_wrong_without_options_of_the_program(self):
        case = Case(SHEAR)
        before = case.to_toml()
        for arguments, words in ((("time.end",), "time.end: the value is missing"),
                                 (("time.end", -1), "time.end = -1.0 must be at least 0"),
                                 (("title", {"a": 1}), "title: a table is set key by key"),
                                 (("flow", "x"), 'flow is a table; .* such as "flow.kind"'),
                                 (("flow.colour", 'a: "b"'), "flow.colour: unknown key"),
                                 (("drop[7].nodes", 60), "drop.7..nodes: drop.7. does not exist"),
                                 (("time.end=0.1\n#", 3), "key = .* is none of a case"), (("", 3), "key = ''"),
                                 (({3: 4},), r"key must be a text \(str\), not 3"),
                                 (({"time.end": 3}, 4), "value = 4: a dict of keys holds the values"),
                                 (("title", "\ud800"), "title = .* half of a surrogate pair"),
                                 (("flow.kind", "quiescent"), "dict: flow.capillary-number = 0.2 must be")):
            with self.assertRaisesRegex(ValueError, f"^{words}"):
                case.set(*arguments)
        self.assertEqual(case.to_toml(), before)

    def test_keys_that_name_nothing_or_several_things(self):
        case = Case(SHEAR)
        for key in ("", "time.end[0]", "time..end", ".time.end", "drop.center[1]", "drop[1].nodes"):
            with self.assertRaises(KeyError, msg=key):
                case[key]
        self.assertIn("time.end", case)
        self.assertNotIn("flow.colour", case)
        two = Case(SHEAR | {"drop": [{"radius": 0.3, "nodes": 42}, {"center": [0, 0, 2], "radius": 0.3, "nodes": 60}]})
        self.assertEqual(two["drop[1].nodes"], 60)
        for use in (two.__getitem__, two.get):
            with self.assertRaisesRegex(ValueError, r"there are 2 \[\[drop\]\]"):
                use("drop.nodes")

    def test_explains_keys(self):
        self.assertIn("capillary", meniscus.explain("flow.capillary-number"))
        with self.assertRaisesRegex(ValueError, "capillary-number"):
            meniscus.explain("flow.capilary-number")


if __name__ == "__main__":
    unittest.main()
