#!/usr/bin/python3
"""scripts/reproduce/campaign combinations, on tables made from the numbers that it should find. Usage: combinations_test.py SCRIPTS"""
import math
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from known_campaign import D  # noqa: E402
import combinations  # noqa: E402
import combined  # noqa: E402
import numpy as np  # noqa: E402

H = 0.02  # thickness of a layer, m
PREFACTOR, EXPONENT, LEVEL, DECAY, SHARE = 1.4413, 1.0057, 0.98, 14.8, 0.65


def rows_of(contact, phi, of_slope=0.0):
    """Rows of twenty layers and windows of 10 s up to 150 s; the share of large grains goes from phi/2 to phi. Contact stress: half of it
    is in mixed contacts, and large grains have p* = SHARE. Kinetic stress: ratio and profile of Staron & Phillips, in a flow of shear rate 10 + of_slope."""
    rows = []
    for t in np.arange(0, 150, 10):
        for n in range(20):
            large = phi * (0.5 + 0.5 * n / 19)
            small, height = 1 - large, H * (n + 0.5)
            row = {"t0[s]": t, "t1[s]": t + 10, "y0[m]": H * n, "y1[m]": H * (n + 1), "frames": 25, "V[m^2]": 1.25}
            if contact:
                row.update({"area_S[m^2]": small, "area_L[m^2]": large})
                for axis in ("xx", "yy"):
                    row.update({f"A_SS_{axis}": 0.5 - large + 0.5 * SHARE, f"A_LL_{axis}": large - 0.5 * SHARE, f"M_{axis}": 0.5,
                                f"Msize_{axis}": 0.5 * SHARE, f"A_Sb_{axis}": 0, f"A_Lb_{axis}": 0})
            else:
                ratio = (PREFACTOR + of_slope) * (small / large) ** EXPONENT
                energy = LEVEL * 9.8 * D * math.exp(-height / (DECAY * 2 * D))
                row.update({"mass_S[kg]": small, "mass_L[kg]": large, "du_dy[1/s]": 10 + 100 * of_slope})
                for axis in ("xx", "yy"):
                    row.update({f"K_S_{axis}": energy * ratio / (1 + ratio), f"K_L_{axis}": energy / (1 + ratio)})
            rows.append(row)
    return rows


def write(path, rows):
    with open(path, "w") as out:
        out.write("\t".join(rows[0]) + "\n")
        for row in rows:
            out.write("\t".join(repr(float(cell)) for cell in row.values()) + "\n")


class Fits(unittest.TestCase):
    x = np.geomspace(0.1, 10, 30)

    def test_every_form_finds_a_law_without_noise(self):
        for form in combinations.FORMS:
            self.assertAlmostEqual(combinations.proportional(self.x, 0.966 * self.x, self.x, form), 0.966, 12)
            a, b = combinations.power(self.x, PREFACTOR * self.x**EXPONENT, self.x, form)
            self.assertAlmostEqual(a, PREFACTOR, 7)
            self.assertAlmostEqual(b, EXPONENT, 7)

    def test_least_squares_is_ruled_by_large_y_and_logarithms_are_not(self):
        y = np.where(self.x > 5, 2 * self.x, self.x)
        s = {form: combinations.proportional(self.x, y, np.ones_like(y), form) for form in combinations.FORMS}
        large = self.x > 5
        self.assertAlmostEqual(s["logarithms"], 2 ** large.mean(), 12)
        self.assertAlmostEqual(s["least squares"], 1 + (self.x[large] ** 2).sum() / (self.x**2).sum(), 12)

    def test_a_difference_counts_in_errors_of_both(self):
        self.assertAlmostEqual(combined.pull("slope", 0.966 + 0.005, 0.004), 1)

    def test_what_is_known_worse_than_the_paper_s_room_meets_nothing(self):
        room = 0.035  # of the slope
        row = lambda value, error: {"slope": value, "slope error": error}
        self.assertTrue(combined.meets(row(0.975, 0.01), "slope"))
        self.assertFalse(combined.meets(row(0.990, 0.01), "slope"))
        self.assertFalse(combined.meets(row(0.966, 1.01 * room / 1.96), "slope"))

    def test_one_run_scatters_with_the_error_of_the_mean_besides(self):
        scatter = {}
        value, error = combinations.summary([{"slope": 1.0}, {"slope": 2.0}, {"slope": 3.0}], scatter)["slope"]
        self.assertEqual(value, 2)
        self.assertAlmostEqual(error, math.sqrt(1 + 1 / 3))
        self.assertAlmostEqual(combinations.summary([{"slope": 7.0}], scatter)["slope"][1], math.sqrt(2))


class Folder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        mixtures = [(phi, 23, variant, seed) for phi in (0.3, 0.45, 0.75) for variant in ("", "e0.5-") for seed in (1, 2) if seed == 1 or not variant]
        slopes = [(0.45, slope, variant, 1) for slope in (21, 26) for variant in ("", "e0.5-")]
        for phi, slope, variant, seed in mixtures + slopes:
            folder = os.path.join(cls.work.name, f"phi{phi:.2f}-s{slope}-{variant}seed{seed}")
            os.mkdir(folder)
            for stride in ("stride1", "stride12"):
                write(os.path.join(folder, f"stress-{stride}.tsv"), rows_of(True, phi))
                for mean, velocity in [("", ""), ("layer-", ""), ("instant-", ""), ("others-", ""), ("", "middle-"), ("layer-", "middle-")]:
                    write(os.path.join(folder, f"kinetic-{mean}{velocity}{stride}.tsv"), rows_of(False, phi, 0.03 * (slope - 23)))
            with open(os.path.join(folder, "checksums"), "w"):
                pass
        combinations.FRAMES = {frames: combinations.FRAMES[frames] for frames in ("25", "2")}
        cls.found = [combined.judged(row) for row in combinations.rows(cls.work.name)]

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def test_there_is_a_row_of_every_combination(self):
        self.assertEqual(len(self.found), len(combinations.LAYERS) * len(combinations.FRAMES) * len(combinations.FORMS) * 6 * 2)
        self.assertEqual(len({tuple(row[axis] for axis in combinations.AXES) for row in self.found}), len(self.found))

    def test_numbers_of_the_paper_are_found_in_tables_made_from_them(self):
        for row in self.found:
            for name, value in {"prefactor": PREFACTOR, "exponent": EXPONENT, "3a level": LEVEL, "3a decay": DECAY}.items():
                if name[:2] != "3a" or row["layers"] == "4-56":
                    self.assertAlmostEqual(row[name] / value, 1, 6, name)
                    self.assertTrue(combined.meets(row, name))
            # Under size, and if the large grain gets p* of a mixed contact, sigma^L = phi_L sigma; the mixed part m = 1/2 shifts
            # it by (p - p*)/2.
            self.assertAlmostEqual(row["slope"], 1, 9)
            self.assertGreater(row["B 0.8"], 0)
            self.assertLess(row["B 0.5"], 0)

    def test_a_flow_that_shears_faster_has_a_stronger_b_kappa(self):
        row = self.found[0]
        b = lambda s: (s - 1) / 2 * (1 + 1 / s)
        self.assertGreater(row["4 slope"], 0)
        rates = [(10 + 100 * 0.03 * (slope - 23)) * math.sqrt(D / 9.8) for slope in (21, 23, 26)]
        # The exponent is not one: the mean ratio over composition is the ratio at 23 degrees times a constant.
        line = np.polyfit(rates, [b(PREFACTOR + 0.03 * (slope - 23)) for slope in (21, 23, 26)], 1)
        self.assertAlmostEqual(row["4 slope"] / line[0], 1, 1)

    def test_the_report_counts_what_is_met(self):
        text = "\n".join(combined.report(self.found))
        self.assertIn(f"Of {len([row for row in self.found if row['mean'] in combined.TRIED])} combinations", text)
        self.assertIn("| prefactor | 1.4413 | 1.441 ± 0 (−0.0)", text.replace("+0.0", "−0.0"))


if __name__ == "__main__":
    unittest.main()
