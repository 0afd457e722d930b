"""The parts of bench/experiments that judge and draw the studies of guiding curves: python3 -m unittest discover -s tests/experiments
-p '*_test.py'."""
import os
import re
import sys
import unittest
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "experiments"))

import boxes  # noqa: E402
import curves  # noqa: E402
import curves_results  # noqa: E402
from results import at_shares, quartiles, rank_test  # noqa: E402


class Statistics(unittest.TestCase):
    def test_quartiles_lie_between_neighbours(self):
        self.assertEqual(quartiles([4, 1, 3, 2, 5]), (2, 3, 4))
        self.assertEqual(at_shares([0, 10], (0.05, 0.95)), (0.5, 9.5))

    def test_ranks_apart_are_told_and_equal_ones_are_not(self):
        self.assertLess(rank_test(range(20), range(15, 35)), 0.001)
        self.assertGreater(rank_test(range(0, 40, 2), range(1, 41, 2)), 0.5)
        self.assertEqual(rank_test([7] * 5, [7] * 9), 1)

    def test_the_statistic_is_that_of_the_textbook(self):
        # U = 3 of 4 and 5 values: mean 10, deviation sqrt(20 * 10 / 12); two-sided normal tail of 7 / 4.0825
        self.assertAlmostEqual(rank_test([1, 2, 3, 7], [4, 5, 6, 8, 9]), 0.0864, places=4)

    def test_the_order_of_samples_does_not_matter_but_ties_do(self):
        a, b = [1, 2, 2, 3, 9], [2, 3, 3, 8, 8, 11]
        self.assertAlmostEqual(rank_test(a, b), rank_test(b, a))
        self.assertNotAlmostEqual(rank_test(a, b), rank_test([1, 2.1, 2.2, 3, 9], [2, 3.1, 3.2, 8, 8.5, 11]), places=3)


class Verdicts(unittest.TestCase):
    def verdict(self, first, second):
        return curves_results.below(first, second, "{:g}".format).split(":")[0]

    def test_a_claim_needs_its_order_and_more_than_chance(self):
        low, high = list(range(30)), list(range(20, 50))
        self.assertEqual(self.verdict(low, high), "holds")
        self.assertEqual(self.verdict(high, low), "**does not**")
        self.assertEqual(self.verdict([1, 2, 3], [2, 3, 4]), "undecided")

    def test_equal_medians_decide_nothing(self):
        self.assertEqual(self.verdict([0] * 60 + [1] * 10, [0] * 60 + [1] * 50), "undecided")


class Pairs(unittest.TestCase):
    def test_a_ring_has_each_model_twice(self):
        self.assertEqual(curves.ring(["a", "b", "c"]), [("a", "b"), ("b", "c"), ("c", "a")])

    def test_batches_keep_all_pairs_in_order_and_few_models_each(self):
        pairs = curves.ring([str(i) for i in range(600)])
        for most in (1, 250, 1000):
            found = list(curves.batches(pairs, most))
            self.assertEqual([pair for batch in found for pair in batch], pairs)
            for batch in found:
                self.assertLessEqual(len(batch), most)
                self.assertLessEqual(len({model for pair in batch for model in pair}), 256, "what one call may compare")


class Boxes(unittest.TestCase):
    def chart(self, **more):
        groups = [{"name": "some <long> name", "values": [0, 1, 2, 3, 4], **more}, {"name": "b", "values": [2, 2, 2, 2, 8]}]
        return boxes.box_chart("A & B", groups, "y")

    def test_it_is_well_formed(self):
        root = ElementTree.fromstring(self.chart(mark=9))
        self.assertEqual(root.find("{*}title").text, "A & B")
        self.assertEqual(len(root.findall("{*}path")), 1, "one published number")
        self.assertEqual(len(ElementTree.fromstring(self.chart()).findall("{*}path")), 0)

    def test_boxes_reach_from_quartile_to_quartile(self):
        root = ElementTree.fromstring(self.chart())
        scale = {}  # of the y axis, from its labels
        for text in root.findall("{*}text"):
            if text.get("text-anchor") == "end" and re.fullmatch(r"[\d.]+", text.text):
                scale[float(text.text)] = float(text.get("y")) - 4
        per_unit = (scale[0] - scale[2]) / 2
        box = root.findall("{*}rect")[1]
        self.assertAlmostEqual(float(box.get("height")), 2 * per_unit, delta=0.2)
        self.assertAlmostEqual(float(box.get("y")), scale[0] - 3 * per_unit, delta=0.2)

    def test_names_break_at_blanks(self):
        self.assertEqual(boxes.lines_of("same silhouette, hybrid", 12), ["same", "silhouette,", "hybrid"])
        self.assertEqual(boxes.lines_of("short one", 12), ["short one"])


if __name__ == "__main__":
    unittest.main()
