#!/usr/bin/env python3
"""The report counts the words of sentences, and of nothing else on a page."""
import tempfile
import unittest
from pathlib import Path

from sentence_lengths import comments, long_sentences, quantile, report, sentence_lengths


class SentenceLengths(unittest.TestCase):
    def holds(self, text, *lengths):
        self.assertEqual(sentence_lengths(text), sorted(lengths))

    def test_sentences_of_a_paragraph_over_lines(self):
        self.holds("A drop\nstretches. It breaks! Does it?\n", 3, 2, 2)

    def test_points_within_a_sentence(self):
        self.holds("D is 0.05 at t = 1.5 in `case.toml`, e.g. with walls.", 11)
        self.holds("See Taylor et al. and eq. 3 by G. I. Taylor. It holds.", 11, 2)

    def test_end_behind_bracket_or_mark(self):
        self.holds("It falls (see below.) It *ends.* So.", 4, 2, 1)

    def test_list_items_end_sentences(self):
        self.holds("- one two\n  three\n- four\n1. five six\n", 3, 1, 2)

    def test_code_tables_headings_and_pictures_are_left_out(self):
        self.holds("# One two\n\n| a | b. c |\n\n```\nx = 1. y\n```\n\n    ρ = C0 κ. And\n\n"
                   "![A. B](a.svg)\n\nText here.\n", 2)

    def test_an_indented_line_of_a_paragraph_is_text(self):
        self.holds("- one\n    two three\n", 3)

    def test_bold_words_that_open_a_paragraph_are_left_out(self):
        self.holds("**Question.** Does it break?", 3)

    def test_a_link_counts_by_its_words(self):
        self.holds("See [the page](docs/a-b.md).", 3)

    def test_quantiles(self):
        self.assertEqual(quantile([1, 2, 3], 0.5), 2)
        self.assertEqual(quantile(list(range(1, 11)), 0.9), 9)
        self.assertEqual(quantile([], 0.5), 0)

    def test_comments_of_a_source(self):
        source = ("/// One two\n/// three. Four:\n///     ρ = 1. And\n/// five.\nint a = 1;  ///< six seven\n"
                  "           ///< eight\nint b;  // nine\n// ten eleven\nauto u = f(\"a//b\");\n")
        self.assertEqual(sentence_lengths(comments(source)), sorted([3, 1, 1, 3, 1, 2]))

    def test_a_row_for_each_page_and_room_and_one_for_all(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "docs").mkdir()
            (root / "meniscus/core").mkdir(parents=True)
            (root / "README.md").write_text("# Title\n\nOne two three.\n", encoding="utf-8")
            (root / "docs/a.md").write_text("One. Two three.\n", encoding="utf-8")
            (root / "meniscus/core/a.hpp").write_text("/// " + "word " * 25 + "end.\nint a;\n", encoding="utf-8")
            rows = [line.split() for line in report(root)]
            long = list(long_sentences(root))
        self.assertEqual(rows[1:4], [["README.md", "5", "1", "3", "3", "3", "0"],
                                     ["docs/a.md", "3", "2", "1", "2", "2", "0"],
                                     ["all", "8", "3", "2", "3", "3", "0"]])
        self.assertEqual(rows[6:], [["meniscus/core", "26", "1", "26", "26", "26", "1"],
                                    ["all", "26", "1", "26", "26", "26", "1"]])
        self.assertEqual(long, ["meniscus/core/a.hpp: 26: " + "word " * 25 + "end."])


if __name__ == "__main__":
    unittest.main()
