#!/usr/bin/python3
"""B of a real run from sums with all digits, and from the same sums as scripts/reproduce/campaign/keep.py rounds them. They differ
by no more than rounding explains; both bounds are computed from the digits alone (scripts/reproduce/campaign/rounding.py).
Usage: rounding_test.py SOURCE BIN"""
import json
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
source, programs = sys.argv[1:]
sys.path.insert(0, os.path.join(source, "scripts", "reproduce", "campaign"))
import keep  # noqa: E402
import rounding  # noqa: E402

HEIGHTS = "0.02m:0.12m"  # m, without the lowest layer
DIGITS = 2


class Run:
    """One finished run in the form that keep expects."""
    flow = "sample"

    def __init__(self, path):
        self.stress = path

    def path(self, _):
        return self.stress


def b_of(table):
    fit = subprocess.run([os.path.join(programs, "grseg-fit"), table, "--heights", HEIGHTS,
                          "--json", "--quiet"], check=True, capture_output=True, text=True)
    return next(row["value"] for row in json.loads(fit.stdout)["numbers"] if row["quantity"] == "B")


def kept(whole, path, digits):
    keep.STRESS_DIGITS = {"stress": digits}
    with open(path, "w") as out:
        out.write(keep.small_table(Run(whole), "stress"))
    return path


def main():
    assert keep.STRESS_DIGITS["stress"] == DIGITS and keep.DIGITS == rounding.AREA_DIGITS
    with tempfile.TemporaryDirectory() as work:
        whole = os.path.join(work, "stress.tsv")
        subprocess.run([os.path.join(programs, "grseg-stress"), os.path.join(source, "data", "sample", "chute.h5"),
                        "--window", "0.5", "--quiet", "-o", whole], check=True)
        exact = b_of(whole)
        rounded = b_of(kept(whole, os.path.join(work, "kept.tsv"), DIGITS))
        coarse = b_of(kept(whole, os.path.join(work, "coarse.tsv"), 1))
        bound = rounding.of_tables([os.path.join(work, "kept.tsv")], heights=HEIGHTS)
        change, rms = rounded - exact, bound["rms"]
        print(f"B {exact:.5f} rounded {rounded:.5f}: {change:+.5f}, rms {rms:.5f}, worst {bound['worst']:.5f}; "
              f"one digit {coarse - exact:+.5f}")
        assert change != 0, "nothing was rounded"
        assert abs(rounded - bound["B"]) < 1e-6, "the points of grseg-fit are others"
        # Errors are uniform within half a unit: they exceed four standard deviations once in 16,000 cases.
        assert abs(change) < 4 * rms
        assert abs(change) < bound["worst"]
        # Half the digits are coarser by a factor of ten.
        of_coarse = rounding.of_tables([os.path.join(work, "coarse.tsv")], heights=HEIGHTS)
        assert abs(of_coarse["rms"] / rms - 10) < 2 and rms < abs(coarse - exact) < 4 * of_coarse["rms"]


main()
