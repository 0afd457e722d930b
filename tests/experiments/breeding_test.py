"""Judging of the study of breeding."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "bench", "experiments"))

import breeding  # noqa: E402
import page  # noqa: E402


def rows(method, ratings, noise="steady"):
    return [{"favourite": str(i), "method": method, "noise": noise, "ratings": str(r), "shape": "0.5"} for i, r in enumerate(ratings)]


class Judging(unittest.TestCase):
    def test_quartiles_lie_between_and_may_be_infinite(self):
        self.assertEqual(breeding.quartiles([4, 1, 3, 2]), (1.75, 2.5, 3.25))
        self.assertEqual(breeding.quartiles([1, 2, float("inf")])[1], 2)
        self.assertEqual(breeding.shown(breeding.quartiles([1, float("inf"), float("inf")])[1]), "> 600")

    def test_goals_are_held_against_the_classic_median(self):
        table = rows("classic", [100, 80, 90]) + rows("ours", [45, 44, 46]) + rows("taste", [31, 31, 20])
        self.assertEqual(breeding.goal(table, "ours", "steady"), "at most half: 50 %")
        self.assertEqual(breeding.goal(table, "taste", "steady"), "**more than** a third: 34 %")
        self.assertEqual(breeding.goal(table, "random", "steady"), "")
        self.assertIn("no median", breeding.goal(rows("classic", [0, 0, 90]) + rows("ours", [9]), "ours", "steady"))

    def test_shares_rise_to_what_was_found(self):
        curve = breeding.share_curve(rows("ours", [10, 0, 30, 20]), "ours", "steady")
        self.assertEqual(curve[-1], (600, 0.75))
        self.assertEqual([y for _, y in curve], sorted(y for _, y in curve))

    def test_a_section_takes_the_place_of_its_older_self(self):
        text = "# Page\n\n## A\n\none\n\n## B\n\ntwo\n\n## C\n\nthree\n"
        changed = page.with_section(text, "## B", "## B\n\nnew\n")
        self.assertEqual(changed, "# Page\n\n## A\n\none\n\n## B\n\nnew\n\n## C\n\nthree\n")
        self.assertEqual(page.with_section("# Page\n", "## B", "## B\n\nnew\n"), "# Page\n\n## B\n\nnew\n")
        self.assertEqual(page.with_section(changed, "## B", "## B\n\nnew\n"), changed)


if __name__ == "__main__":
    unittest.main()
