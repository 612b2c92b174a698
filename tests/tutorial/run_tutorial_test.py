#!/usr/bin/env python3
"""Tests of run_tutorial.py: what it takes for a quotation of what was printed, and what it does not."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import run_tutorial as tutorial  # noqa: E402


class Quotation(unittest.TestCase):
    def missed(self, quoted, printed, tolerance=0.02):
        return tutorial.first_disagreement(quoted, printed, tolerance)

    def test_numbers_agree_within_the_tolerance_or_one_in_the_last_digit(self):
        self.assertIsNone(self.missed("D = 0.3521 in 31 steps", "D = 0.3533 in 32 steps"))
        self.assertIsNone(self.missed("D = 0.3521", "D = 0.35210001"))
        self.assertIsNotNone(self.missed("D = 0.3521", "D = 0.3621"))
        self.assertIsNotNone(self.missed("31 steps", "33 steps"))
        self.assertIsNotNone(self.missed("2 drops", "3 drops"))
        self.assertIsNone(self.missed("31 steps", "33 steps", 0.1))
        self.assertIsNone(self.missed("1.2e-05", "1.3e-05"))
        self.assertIsNotNone(self.missed("1.2e-05", "1.2e-04"))

    def test_words_agree_to_the_letter_and_blanks_by_being_there(self):
        self.assertIsNone(self.missed("t  L", "t     L"))
        self.assertIsNotNone(self.missed("t L", "t B"))
        self.assertIsNotNone(self.missed("steps (done)", "steps"))
        self.assertIsNone(self.missed("7 steps", "9 steps", None))
        self.assertIsNotNone(self.missed("7 steps", "9 stops", None))

    def test_dots_stand_for_a_part_of_a_line_or_for_lines(self):
        self.assertIsNone(self.missed("wrote … in … s", "wrote a/b.svg in 3.25 s"))
        self.assertIsNone(self.missed("a\n…\nd", "a\nb\nc\nd"))
        self.assertIsNone(self.missed("a\n…", "a\nb"))
        self.assertIsNotNone(self.missed("a\n…\nd", "a\nb"))

    def test_nothing_may_be_missing_or_left_over(self):
        self.assertEqual(self.missed("a\nb", "a"), "b")
        self.assertIsNotNone(self.missed("a", "a\nb"))


class Pages(unittest.TestCase):
    PAGE = """Words.

<!-- test: within 10 % -->
```sh
echo 11
```

```text
10
```

<!-- test: run --set time.end=1 -->
```sh
meniscus run a.toml -q
echo meniscus run
```
"""

    def test_blocks_carry_what_comments_say(self):
        first, second = tutorial.blocks(self.PAGE)
        self.assertEqual((first.quoted, first.tolerance, first.line), ("10\n", 0.1, 5))
        self.assertEqual(tutorial.as_run(second), "meniscus run a.toml --set time.end=1 -q\necho meniscus run\n")

    def test_an_unknown_instruction_is_refused(self):
        with self.assertRaisesRegex(tutorial.Fault, "no such instruction"):
            tutorial.blocks("<!-- test: skip -->\n```sh\ntrue\n```\n")

    def test_commands_that_fail_or_print_something_else_are_faults(self):
        with tempfile.TemporaryDirectory() as folder:
            environment = {"PATH": "/usr/bin:/bin"}
            tutorial.run_block(tutorial.Block("echo 12\n", 1, "10\n", 0.2), folder, environment)
            with self.assertRaisesRegex(tutorial.Fault, "quoted but not printed: 10"):
                tutorial.run_block(tutorial.Block("echo 12\n", 1, "10\n", 0.01), folder, environment)
            with self.assertRaisesRegex(tutorial.Fault, "status 1"):
                tutorial.run_block(tutorial.Block("false\ntrue\n", 1), folder, environment)


if __name__ == "__main__":
    unittest.main()
