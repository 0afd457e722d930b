"""Makes docs/experiments.md: python3 bench/experiments [--page] [--seconds S] [--seeds N] [--only NAME ...] [steps]."""
import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import breeding  # noqa: E402
import curves  # noqa: E402
import page  # noqa: E402
import plan  # noqa: E402

STEPS = ("tune", "compare", "study", "curves", "breeding")


def main():
    names = [name for name, _, _ in plan.SCENES]
    parser = argparse.ArgumentParser(prog="bench/experiments", description=__doc__)
    parser.add_argument("steps", nargs="*", help="of: tune, compare, study, curves, breeding (all)")
    parser.add_argument("--page", action="store_true", help="only write the page, from what is there")
    parser.add_argument("--seconds", type=float, default=30, help="budget of a search in the comparisons (30)")
    parser.add_argument("--seeds", type=int, default=5, help="of the comparisons (5)")
    parser.add_argument("--study-seeds", type=int, default=20, help="of the study of 2016 (20)")
    parser.add_argument("--favourites", type=int, default=50, help="of the study of breeding (50)")
    parser.add_argument("--threads", type=int, default=0, help="0 = one per core")
    parser.add_argument("--clock", choices=("wall", "computing"), default="wall")
    parser.add_argument("--only", nargs="*", default=[], choices=names, metavar="SCENE", help=", ".join(names))
    parser.add_argument("--out", default=os.path.join(plan.ROOT, "out", "experiments"))
    options = parser.parse_args()
    steps = [] if options.page else options.steps or STEPS
    for step in steps:
        if step not in STEPS:
            parser.error(f"no such step: {step}; there are {', '.join(STEPS)}")
    if "tune" in steps:
        plan.tune(options.out, options.only)
    if "compare" in steps:
        plan.compare(options.out, options.only, options.seconds, options.seeds, options.threads, options.clock)
    if "study" in steps:
        plan.study(options.out, options.study_seeds, options.threads)
    if "curves" in steps:
        curves.curves(os.path.join(options.out, "curves"))
    if "breeding" in steps:
        breeding.breeding(os.path.join(options.out, "breeding"), options.favourites, options.threads)
    page.write_page(options.out)


main()
