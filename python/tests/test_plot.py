"""Figures of numbers: what they show, orders of convergence, what is refused, the bytes of a file."""
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from common import SHEAR  # noqa: E402
from meniscus import Simulation, plot  # noqa: E402
from misfits import WRONG_PATHS, WRONG_TEXTS  # noqa: E402

NODES = np.array([110.0, 200.0, 400.0])


class Figure(unittest.TestCase):
    def setUp(self):
        self.addCleanup(pyplot.close, "all")

    def file(self, ax, name="figure.svg"):
        """The bytes of the figure of the axes."""
        with tempfile.TemporaryDirectory() as folder:
            plot.save(ax, Path(folder) / name)
            return (Path(folder) / name).read_bytes()

    def texts(self, ax):
        return ["".join(element.itertext()).strip() for element in xml.fromstring(self.file(ax)).iter()
                if element.tag.endswith("}text")]

    def legend(self, ax):
        return [text.get_text() for text in ax.get_legend().get_texts()]


class LinesTest(Figure):
    def test_what_is_drawn_are_the_numbers(self):
        t, d = [0.0, 0.5, 1.0], [0.0, 0.1, 0.15]
        ax = plot.lines({"reference": (t, d), "N0 = 110": (t, np.array(d) + 0.01), "one": ([1.0], [0.2])}, x="t [1/G]", y="D")
        for line, (x, y) in zip(ax.lines, [(t, d), (t, np.array(d) + 0.01), ([1.0], [0.2])]):
            np.testing.assert_array_equal(line.get_data(), (x, y))
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("t [1/G]", "D"))
        self.assertEqual([line.get_linestyle() for line in ax.lines], [":", "-", "None"])
        self.assertEqual([line.get_marker() for line in ax.lines], ["None", "None", "^"])
        self.assertEqual(self.legend(ax), ["reference", "N0 = 110", "one"])
        self.assertGreater(ax.lines[0].zorder, ax.lines[1].zorder)

    def test_what_is_under_a_mask_is_not_drawn(self):
        ax = plot.lines({"a": ([1, 2, 3], np.ma.masked_greater([1, 2, 1000000], 100))}, x="x", y="y")
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), [1.0, 2.0, np.nan])

    def test_units_are_those_of_each_column_and_of_the_flow(self):
        shear = Simulation(SHEAR)
        for columns, label in ((["L", "B"], "L, B [R0]"), (["L", "D"], "L [R0], D"), ("D", "D"),
                               (["N1", "angle_deg"], "N1 [μ_out G], angle_deg [degrees]")):
            ax = plot.history(shear, columns)
            self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("t [1/G]", label))
        ax = plot.history(Simulation(SHEAR | {"flow": {"kind": "quiescent"}}), "N1")
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("t [μ_out R0/σ]", "N1 [σ/R0]"))

    def test_a_lone_line_has_no_legend(self):
        self.assertIsNone(plot.lines({"D": ([0, 1], [0, 1])}, x="t", y="D").get_legend())

    def test_styles_and_colours_are_those_asked_for(self):
        ax = plot.lines({"theory": ([0, 1], [0, 1]), "runs": ([0, 1], [0, 1.1])}, x="Ca", y="D",
                        styles={"theory": "--", "runs": "o"}, colours={"theory": 4})
        self.assertEqual([(line.get_linestyle(), line.get_marker(), line.get_color()) for line in ax.lines],
                         [("--", "None", "#000000"), ("None", "o", "#d55e00")])

    def test_logarithmic_axes_have_plain_numbers(self):
        ax = plot.lines({"a": ([0.01, 0.1, 10.0], [0.05, 0.1, 0.2])}, x="λ", y="Ca", log="xy")
        self.assertEqual((ax.get_xscale(), ax.get_yscale()), ("log", "log"))
        texts = self.texts(ax)
        for text in ("λ", "Ca", "0.01", "1", "10", "0.05", "0.1", "0.2"):
            self.assertIn(text, texts)
        self.assertEqual(plot.lines({"a": ([1, 2], [1, 2])}, x="x", y="y", log="y").get_xscale(), "linear")

    def test_more_lines_go_into_the_same_axes(self):
        upper, lower = plot.panels(2)
        self.assertIs(plot.lines({"a": ([0, 1], [0, 1])}, x="t", y="D", ax=lower), lower)
        plot.lines({"b": ([0, 1], [1, 0])}, x="t", y="D", ax=lower)
        self.assertEqual((len(upper.lines), self.legend(lower)), (0, ["a", "b"]))
        self.assertIs(upper.figure, lower.figure)
        self.assertGreater(upper.get_position().y0, lower.get_position().y1)

    def test_what_cannot_be_drawn_is_refused(self):
        for said, series in [
                ("series holds nothing", {}), ("series must be a dict", [1, 2]), ("a label of series", {1: ([0], [0])}),
                (r"series\['a'\] must be a pair", {"a": [0.0]}), (r"series\['a'\] must be a pair", {"a": 3}),
                ("x and y must have as many numbers", {"a": ([0.0, 1.0], [0.0])}),
                ("x and y must have as many numbers", {"a": ([], [])}),
                (r"series\['a'\]: x must be a row", {"a": (np.zeros((2, 2)), np.zeros((2, 2)))}),
                (r"series\['a'\]: y must be a row", {"a": ([0.0, 1.0], ["0", "1"])})]:
            for draw in (plot.lines, plot.errors):
                with self.subTest(said=said), self.assertRaisesRegex(ValueError, said):
                    draw(series, x="N0", y="D")
        series = {"a": ([1.0, 2.0], [2.0, 1.0])}
        for wrong in WRONG_TEXTS:
            for name in ("x", "y"):
                for draw in (plot.lines, plot.errors):
                    with self.subTest(name=name, wrong=wrong), self.assertRaisesRegex(ValueError, f"^{name} "):
                        draw(series, **{"x": "N0", "y": "D", name: wrong})
            if wrong is not None:
                with self.subTest(log=wrong), self.assertRaisesRegex(ValueError, "^log must"):
                    plot.lines(series, x="t", y="D", log=wrong)
            with self.subTest(style=wrong), self.assertRaisesRegex(ValueError, "^styles"):
                plot.lines(series, x="t", y="D", styles={"a": wrong})
        for said, more in [("log must", {"log": "z"}), ("styles: there is no label 'b'", {"styles": {"b": "--"}}),
                           ("styles must be a dict", {"styles": "--"}), (r"styles\['a'\] must", {"styles": {"a": "k--"}}),
                           (r"styles\['a'\] must", {"styles": {"a": ""}}), ("colours: there is no", {"colours": {"b": 1}}),
                           (r"colours\['a'\] must be", {"colours": {"a": 7}}),
                           (r"colours\['a'\] must be", {"colours": {"a": "red"}}), ("ax must be axes", {"ax": 3})]:
            with self.subTest(said), self.assertRaisesRegex(ValueError, said):
                plot.lines(series, x="t", y="D", **more)
        for wrong in (0, -1, 1.0, True, "2", None):
            with self.subTest(count=wrong), self.assertRaisesRegex(ValueError, "count must be"):
                plot.panels(wrong)
        self.assertEqual(pyplot.get_fignums(), [])

    def test_every_mark_and_line_is_taken(self):
        for mark in ".,ov^<>12348spP*hH+xXdD|_":
            for line in ("", "-", "--", "-.", ":"):
                drawn, = plot.lines({"a": ([0, 1], [0, 1])}, x="t", y="D", styles={"a": mark + line}).lines
                self.assertEqual((drawn.get_marker(), drawn.get_linestyle()), (mark, line or "None"))
                pyplot.close("all")


class ErrorsTest(Figure):
    def test_the_order_of_a_power_is_its_exponent(self):
        for exponent in (-0.5, -1.0, -2.0):
            for factor in (3.0, -3.0):
                self.assertAlmostEqual(plot.order(NODES, factor * NODES**exponent), exponent, places=12)
        # Of three errors, in closed form: the covariance of the logarithms over their variance.
        self.assertAlmostEqual(plot.order([1.0, 2.0, 4.0], [1.0, 0.5, 0.125]), -1.5, places=12)

    def test_errors_without_an_order_have_none(self):
        for nodes, errors in [([110], [0.1]), ([110, 200], [0.1, -0.05]), ([110, 200], [0.1, 0.1]),
                              ([110, 200, 400], [0.1, 0.05, 0.06]), ([110, 200], [0.1, 0.0]),
                              ([110, 200], [0.1, np.nan]), ([], [])]:
            self.assertIsNone(plot.order(nodes, errors), (nodes, errors))
        for nodes, errors in [([110], []), (110, 0.1), ([110], ["0.1"]), ([110], [None])]:
            with self.assertRaisesRegex(ValueError, "nodes|errors"):
                plot.order(nodes, errors)

    def test_what_is_no_row_of_resolutions_has_no_order(self):
        for nodes in ([0, 110], [-1, 110], [np.nan, 110], [110, 110], [200, 110]):
            with self.subTest(nodes=nodes), self.assertRaisesRegex(ValueError, "nodes must be positive and rise"):
                plot.order(nodes, [1.0, 0.5])
        self.assertIsNone(plot.order(NODES, [np.inf, 0.2, 0.1]))
        self.assertIsNone(plot.order(NODES, np.ma.masked_less([1.0, 0.5, 1e-9], 1e-3)))

    def test_the_figure_shows_magnitudes_orders_and_signs(self):
        ax = plot.errors({"second": (NODES, 100.0 * NODES**-2.0), "mixed": (NODES[:2], [-0.1, 0.2])}, y="error [%]")
        second, none_below, mixed, below = ax.lines
        np.testing.assert_allclose(second.get_data(), (NODES, 100.0 * NODES**-2.0))
        np.testing.assert_array_equal(mixed.get_ydata(), [0.1, 0.2])
        self.assertEqual(len(none_below.get_xdata()), 0)
        np.testing.assert_array_equal(below.get_data(), ([110.0], [0.1]))
        self.assertEqual((below.get_marker(), below.get_markerfacecolor()), (mixed.get_marker(), "white"))
        self.assertEqual(self.legend(ax), [r"second: $\mathregular{N0^{-2.0}}$", "mixed"])
        np.testing.assert_array_equal(ax.xaxis.get_major_locator()(), NODES)
        self.assertEqual((ax.get_xscale(), ax.get_yscale(), ax.get_xlabel()), ("log", "log", "N0"))
        self.assertTrue({"110", "200", "400"} <= set(self.texts(ax)))

    def test_slopes_drawn_before_stay_beside_the_errors(self):
        ax = plot.lines({"1/N0": (NODES, 1.0 / NODES)}, x="N0", y="", log="xy", styles={"1/N0": "--"})
        plot.errors({"a": (NODES, 2.0 / NODES)}, y="error", colours={"a": 4}, ax=ax)
        self.assertEqual([line.get_linestyle() for line in ax.lines[:2]], ["--", "-"])
        self.assertEqual((ax.lines[1].get_color(), ax.lines[1].get_marker()), ("#000000", "v"))
        self.assertEqual(self.legend(ax)[0], "1/N0")

    def test_what_has_no_logarithm_is_refused(self):
        for nodes, errors in [([110, 200], [0.1, 0.0]), ([110, 200], [0.1, np.nan]), ([200, 110], [0.1, 0.2]),
                              ([110, 110], [0.1, 0.2]), ([0, 110], [0.1, 0.2])]:
            with self.subTest(nodes=nodes, errors=errors), self.assertRaisesRegex(ValueError, "N0 must be positive"):
                plot.errors({"a": (nodes, errors)}, y="error")
        self.assertEqual(pyplot.get_fignums(), [])


class SaveTest(Figure):
    def drawn(self):
        return plot.errors({"Γ": (NODES, 1.0 / NODES)}, y="error [%]")

    def test_the_same_figure_has_the_same_bytes(self):
        first = self.file(self.drawn())
        self.assertEqual(first, self.file(self.drawn()))
        self.assertLess(len(first), 20_000)
        for word in (b"<dc:date>", b"Matplotlib"):
            self.assertNotIn(word, first)
        with pyplot.rc_context({"svg.fonttype": "path", "svg.hashsalt": "other"}):
            self.assertEqual(first, self.file(self.drawn()))

    def test_its_text_is_text(self):
        self.assertIn("error [%]", self.texts(self.drawn()))

    def test_the_name_says_the_format_and_the_figure_is_closed(self):
        for name, head in (("figure.png", b"\x89PNG"), ("figure.pdf", b"%PDF")):
            self.assertTrue(self.file(self.drawn(), name).startswith(head))
        self.assertEqual(pyplot.get_fignums(), [])

    def test_what_is_no_axes_or_no_path_is_refused(self):
        ax = self.drawn()
        for wrong in (None, 3, "ax"):
            with self.subTest(ax=wrong), self.assertRaisesRegex(ValueError, "^ax must be"):
                plot.save(wrong, "figure.svg")
        for wrong in WRONG_PATHS:
            with self.subTest(path=wrong), self.assertRaisesRegex(ValueError, "^path"):
                plot.save(ax, wrong)


if __name__ == "__main__":
    unittest.main()
