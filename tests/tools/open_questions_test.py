#!/usr/bin/python3
"""questions, stages, closures, denser, rigid-limit and answers, on runs and rows whose results are known in advance.

Usage: open_questions_test.py SCRIPTS
"""
import math
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest

sys.dont_write_bytecode = True
from known_campaign import D, G, Pipeline, campaign, fitted  # noqa: E402
import answers  # noqa: E402
import closures  # noqa: E402
import numpy as np  # noqa: E402
import questions  # noqa: E402
import stages  # noqa: E402
import tables  # noqa: E402

SPEED = math.sqrt(G * D)
BEADS = math.pi / 4 * (2 * D) ** 2  # area of a bead, which is as large as a large grain


def rows_of_bed(t, large_below=0.0, y_large=0.5, rate=0.0):
    """Tables of stress and of segregation with one window of 1 s: a layer of 4 d_S and the bed."""
    key = {"t0": t, "t1": t + 1, "frames": 20}
    layer = {**key, "y0": 0.0, "y1": 4 * D}
    stress = {**layer, "area_S": 1.0, "area_L": large_below * BEADS}
    segregation = [{**layer, "yL": math.nan, "height": math.nan, "shear_rate": math.nan},
                   {**key, "y0": math.nan, "y1": math.nan, "yL": y_large * 60 * D, "height": 60 * D, "shear_rate": rate}]
    return stress, segregation


class Questions(Pipeline):
    """One row per flow, with results of grseg-fit for it and for the choice of Staron & Phillips."""

    def run_of(self, name, **bed):
        windows = [rows_of_bed(0, large_below=100, y_large=0.1, rate=1000), rows_of_bed(10, **bed)]
        self.campaign.run(name, stress=[stress for stress, _ in windows], segregation=[row for _, both in windows for row in both],
                          micro=[{"t1": t, **{f"n_{pair}": 1.0 for pair in ("SS", "LS", "LL", "Sb", "Lb")}, "sum_f_SS": 1.0, "sum_f_LS": 2.0,
                                  "sum_f_LL": 3.0, "sum_f_Sb": 4.0, "sum_f_Lb": late} for t, late in ((10, 900.0), (30, 7.0))],
                          record=[{"name": "small_diameter", "value": D}, {"name": "summary_mean_overlap", "value": 1e-3 * D}])

    def answer(self, flow, value, *words, half=0.01, freedom=1.0):
        numbers = {name: (value, value - half, value + half) for name in ("B", "paper_B", "p_zero")}
        self.campaign.answer("grseg-fit", f"{flow}-seed1/stress.tsv", *words, rows=fitted(freedom=freedom, **numbers))

    def asked_of(self, flow):
        return [words for words in self.campaign.asked() if any(f"/{flow}-seed1/" in word for word in words)]

    def test_a_flow_is_compared_with_the_paper_s_choice_over_its_own_time(self):
        for flow in ("phi0.30-s23", "phi0.30-s23-irregular"):
            for seed in (1, 2):
                self.run_of(f"{flow}-seed{seed}")
        self.answer("phi0.30-s23-irregular", 0.05, half=0.003 * 4.303, freedom=2)
        self.answer("phi0.30-s23", 0.03, half=0.004 * 12.706, freedom=1)
        rows = {row["flow"]: row for row in self.campaign.made_by("questions")}
        row = rows["phi0.30-s23-irregular"]
        self.assertEqual((row["runs"], row["end"]), (2, 11))
        self.assertAlmostEqual(row["less_B"], 0.02)
        # Standard errors of 0.003 and 0.004 combine to 0.005, with 5^4/(3^4/2 + 4^4/1) = 2.11 degrees of freedom.
        self.assertAlmostEqual(row["less_B_reach"], 0.005 * 4.13, delta=0.005 * 0.1)
        self.assertTrue(math.isnan(rows["phi0.30-s23"]["less_B"]))
        for words in self.asked_of("phi0.30-s23"):
            self.assertEqual(words[words.index("--end") + 1], "11.0")

    def test_more_rules_than_one_are_refused(self):
        self.run_of("phi0.30-s23-seed1")
        self.campaign.answer("grseg-fit", "phi0.30-s23-seed1/stress.tsv", rows=fitted("size", B=0.1) + fitted("half", B=0.2))
        with self.assertRaisesRegex(AssertionError, "printed 2 rules"):
            self.campaign.made_by("questions")

    def test_another_program_is_compared_with_the_time_from_its_start_on(self):
        for flow in ("phi0.45-s23", "phi0.45-s23-lammps100000"):
            self.run_of(f"{flow}-seed1")
            self.answer(flow, 0.03)
        self.campaign.made_by("questions")
        between = {(words[words.index("--begin") + 1], words[words.index("--end") + 1]) for words in self.asked_of("phi0.45-s23")}
        self.assertIn(("10", "21.0"), between)

    def test_layers_keep_their_distance_from_base_and_surface_in_a_deeper_bed(self):
        deep = "phi0.45-s23-cell140dS-depth120dS-t60"
        self.run_of(deep + "-seed1")
        self.answer(deep, 0.03)
        self.campaign.made_by("questions")
        heights = {words[words.index("--heights") + 1] for words in self.asked_of(deep) if "--heights" in words}
        self.assertEqual(heights, {"4dS:116dS", "all"})

    def test_grains_that_are_alike_are_fitted_with_random_labels(self):
        alike = "phi0.45-s23-ratio1-t60"
        self.run_of(alike + "-seed1")
        os.link(os.path.join(self.campaign.tables, alike + "-seed1", "stress.tsv"), os.path.join(self.campaign.tables, alike + "-seed1", "stress-random.tsv"))
        self.campaign.answer("grseg-fit", "stress-random.tsv", rows=fitted(freedom=3.0, B=(0.001, 0.0, 0.002)))
        row, = self.campaign.made_by("questions")
        self.assertEqual((row["B"], row["B_high"]), (0.001, 0.002))

    def test_a_ratio_of_1_5_is_not_the_control(self):
        flow = "phi0.45-s23-ratio1.5-t60"
        self.run_of(flow + "-seed1")
        self.answer(flow, 0.03)
        row, = self.campaign.made_by("questions")
        self.assertEqual(row["B"], 0.03)

    def test_the_bed_at_the_end_is_that_of_the_last_window(self):
        flow = "phi0.30-s23"
        self.run_of(flow + "-seed1", large_below=7, y_large=0.7, rate=11)
        self.run_of(flow + "-seed2", large_below=9, y_large=0.8, rate=13)
        self.answer(flow, 0.03)
        row, = self.campaign.made_by("questions")
        self.assertAlmostEqual(row["trapped"], 8, 6)
        self.assertAlmostEqual(row["yL_end"], 0.75)
        self.assertAlmostEqual(row["rate"], 12 * math.sqrt(D / G), 6)
        self.assertAlmostEqual(row["overlap"], 1e-3)
        self.assertAlmostEqual(row["f_ratio"], (3 + 2 + 7) / (1 + 2 + 4))  # from the last 15 s only
        self.assertAlmostEqual(row["trapped_reach"], 12.706 * math.sqrt(2) / math.sqrt(2), 4)

    def test_a_run_of_150_s_counts_instead_of_a_shorter_one_of_its_mixture(self):
        self.answer("phi0.60-s23-e0.5-t150", 0.05, "--over", "flows")
        for flow in ("phi0.30-s23-e0.5", "phi0.60-s23-e0.5", "phi0.60-s23-e0.5-t150"):
            self.run_of(f"{flow}-seed1")
            self.answer(flow, 0.04)
        self.run_of("phi0.60-s23-e0.5-seed2")
        every = self.campaign.made_by("questions")[-1]
        self.assertEqual((every["flow"], every["runs"], every["B"]), ("mixtures-e0.5", 2, 0.05))

    def test_all_mixtures_of_one_restitution_make_a_row(self):
        self.answer("phi0.60-s23-e0.5", 0.05, "--over", "flows")
        for phi in ("0.30", "0.60"):
            self.run_of(f"phi{phi}-s23-e0.5-seed1")
            self.answer(f"phi{phi}-s23-e0.5", 0.04)
        self.run_of("phi0.60-s23-e0.5-seed2")
        rows = self.campaign.made_by("questions")
        every = rows[-1]
        self.assertEqual((every["flow"], every["runs"], every["B"]), ("mixtures-e0.5", 3, 0.05))
        asked = [words for words in self.campaign.asked() if "--over" in words][0]
        self.assertEqual(asked[asked.index("--flows") + 1], "1,2")
        self.assertTrue(math.isnan(every["phi"]))


class Closures(Pipeline):
    """Gray & Thornton's coefficients for each mixture, from the runs whose tables have the flux of every layer."""

    def test_a_mixture_is_closed_by_all_its_runs_inside(self):
        for name in ("phi0.30-s23-seed1", "phi0.30-s23-e0.25-seed1", "phi0.30-s23-e0.25-seed2", "phi0.60-s23-e0.25-seed1", "phi0.60-s22-e0.25-seed1"):
            self.campaign.run(name)
        numbers = ("B_over_c[s]", "d_over_c[m^2/s]", "p_zero", "dc_dp[1/s]", "c@size[1/s]", "c@half[1/s]", "d@size[m^2/s^2]", "error_factor")
        for phi, first in (("0.30", 1.0), ("0.60", 101.0)):
            self.campaign.answer("grseg-closure", f"phi{phi}-s23-e0.25-seed1/stress.tsv",
                                 rows=[{"quantity": name, "value": first + n, "low": first + n - 0.5, "high": math.nan} for n, name in enumerate(numbers)])
        thirty, sixty = self.campaign.made_by("closures")
        self.assertEqual((thirty["flow"], thirty["runs"], sixty["phi"], sixty["runs"]), ("phi0.30-s23-e0.25", 2, 0.6, 1))
        self.assertEqual([thirty[name] for name in ("B_over_c", "d_over_c", "p_star", "dc_dp", "c_size", "c_half")], [1, 2, 3, 4, 5, 6])
        self.assertEqual((sixty["c_size"], sixty["c_size_low"]), (105, 104.5))
        asked = self.campaign.asked()[0]
        self.assertEqual(sum(word.endswith("/segregation.tsv") for word in asked), 2)
        self.assertEqual(asked[asked.index("--heights") + 1], "12dS:56dS")


def points(j, k, shape, n=400, seed=1):
    """Points in which large grains carry phi_L phi_S P + j q + k G more than their share, with any flux q and gradient G."""
    random = np.random.default_rng(seed)
    t, y, phi = random.uniform(0, 600, n), random.uniform(0.1, 0.9, n), random.uniform(0.1, 0.9, n)
    q, gradient = random.normal(0, 1e-3, n), random.normal(0, 0.02, n)
    p = shape[0] + shape[1] * phi + shape[2] * y + shape[3] * phi * y
    return np.stack([t, y, phi, phi * (1 - phi) * p + j * q + k * gradient, random.uniform(1, 9, n), q, gradient, np.full(n, 1e-8)], 1)


class Stages(Pipeline):
    """Excess of the large grains' contact stress over their share, as a function of composition and height, flux, and gradient."""

    SHAPE = (0.03, 0.01, -0.02, 0.05)

    def test_a_contribution_of_flux_and_gradient_is_found_beside_any_quadratic_of_composition_and_height(self):
        found = stages.fit(points(1.7, -0.3, self.SHAPE))
        self.assertAlmostEqual(found["both", "j"], 1.7, 9)
        self.assertAlmostEqual(found["both", "k"], -0.3, 10)
        self.assertAlmostEqual(found["both", "r2"], 1, 12)
        self.assertLess(found["+q", "r2"], 1 - 1e-3)
        self.assertLess(found["+gradient", "r2"], 1 - 1e-3)

    def test_a_flux_measured_with_noise_is_corrected_by_its_reliability(self):
        exact = points(1.7, 0, self.SHAPE, n=20000)
        noise = 5e-4
        exact[:, 5] += np.random.default_rng(2).normal(0, noise, len(exact))
        exact[:, 7] = noise**2
        found = stages.fit(exact)
        self.assertAlmostEqual(found["q", "reliability"], 1 / 1.25, 1)
        self.assertLess(found["+q", "j"], 1.45)
        self.assertAlmostEqual(found["+q", "j_true"], 1.7, 1)

    def test_leaving_out_runs_tells_how_runs_differ(self):
        starts = {"a": [points(j, 0, self.SHAPE, seed=n) for n, j in enumerate((1.0, 2.0, 3.0))]}
        found = {row[:2]: row[2:] for row in stages.jackknife(starts)}
        value, low, high, _ = found["both", "j"]
        self.assertAlmostEqual(value, 2, 0)
        self.assertAlmostEqual((high - low) / 2, 4.303 / math.sqrt(3), delta=0.4)  # Student's t of three values that are 1 apart
        # A second start with two runs that agree halves the weight of the first start and adds no variance.
        starts["b"] = [points(2, 0, self.SHAPE, seed=n) for n in (7, 7)]
        found = {row[:2]: row[2:] for row in stages.jackknife(starts)}
        self.assertAlmostEqual((found["both", "j"][2] - found["both", "j"][1]) / 2, 3 / 5 * 4.303 / math.sqrt(3), delta=0.4)
        # For a single run the units are blocks: a run of ten equal blocks adds no variance; a run with j = 1 before 300 s and 3
        # after has one.
        changing = points(1, 0, self.SHAPE)
        late = changing[:, 0] > 300
        changing[late] = points(3, 0, self.SHAPE)[late]
        steady, lonely = ({row[:2]: row[2:] for row in stages.jackknife({"c": [run]})} for run in (points(2, 0, self.SHAPE), changing))
        self.assertEqual(steady["both", "j"][3], "blocks of 60 s")
        self.assertLess(steady["both", "j"][2] - steady["both", "j"][1], 1e-9)
        # Five values of 1 and five of 3: Student's t, standard deviation, and root of their number.
        self.assertAlmostEqual((lonely["both", "j"][2] - lonely["both", "j"][1]) / 2, 2.262 * math.sqrt(10 / 9) / math.sqrt(10), delta=0.25)
        alike = {row[:2]: row[2:] for row in stages.jackknife({"a": [points(1, 0, self.SHAPE, seed=n) for n in range(3)]})}
        self.assertAlmostEqual(alike["both", "j"][1], alike["both", "j"][2], 9)

    def test_b_at_equal_composition_and_height_does_not_see_where_a_start_has_its_points(self):
        whole = points(0, 0, (0.02, 0.0, 0.04, 0.0), n=4000)
        low = whole[(whole[:, 1] < 0.35) | ((np.arange(len(whole)) % 5 == 0) & (whole[:, 1] < 0.66))]
        found = {row[0]: row[2] for row in stages.by_time({"all": [whole], "low": [low]}, 0) if row[1] != "B"}
        self.assertAlmostEqual(found["all 300-600 s"], found["low 300-600 s"], 2)
        of = lambda p: (p[:, 4] * p[:, 3]).sum() / (p[:, 4] * p[:, 2] * (1 - p[:, 2])).sum()
        self.assertGreater(of(whole) - of(low), 0.005)

    def test_a_window_counts_where_all_of_it_lies(self):
        # Windows from 0 to 10 s, when the flow begins, and from 10 to 20 s: the first is not inside 5 to 20 s.
        points = np.array([[t, 0.5, 0.5, excess, 1, 0, 0, 0] for t, excess in ((5, 0.01), (15, 0.03))])
        as_it_is, in_class = stages.by_time({"a": [points]}, 10)
        self.assertEqual(as_it_is[:2], ("a 5-20 s", "B"))
        self.assertEqual(in_class[:2], ("a 5-20 s", "B over 1 classes"))
        for row in (as_it_is, in_class):
            self.assertAlmostEqual(row[2], 0.03 / 0.25)
            self.assertTrue(math.isnan(row[3]), "one block tells no interval")

    def test_b_of_one_run_has_the_interval_of_its_blocks(self):
        # Three windows of 10 s that differ only in their excess: Student's t of three means, 0.01/0.25 apart.
        points = np.array([[t, 0.5, 0.5, excess, 1, 0, 0, 0] for t, excess in ((25, 0.01), (35, 0.02), (45, 0.03))])
        row = next(iter(stages.by_time({"a": [points]}, 10)))
        self.assertEqual((row[0], row[1], row[5]), ("a 20-60 s", "B", "3 blocks"))
        self.assertAlmostEqual(row[2], 0.02 / 0.25)
        self.assertAlmostEqual((row[4] - row[3]) / 2, 4.3027 / math.sqrt(3) * 0.01 / 0.25, 4)

    def test_a_point_is_a_layer_inside_over_ten_seconds(self):
        content = dict(A_SS_yy=2.0, A_LL_yy=3.0, M_yy=6.0, Msize_yy=4.0, A_Sb_yy=0.0, A_Lb_yy=0.0)
        stress, flux = [], []
        for t, frames, q in ((0.0, 10, 1e-3), (5.0, 30, 5e-3)):
            for n in (0, 1, 14):
                key = {"t0": t, "t1": t + 5, "y0": 4 * n * D, "y1": 4 * (n + 1) * D, "frames": frames}
                stress.append({**key, "area_S": 3.0, "area_L": 1.0, **content})
                flux.append({**key, "q_L": q, "q_L_error": 1e-4, "dphi_dy": 2.0})
            flux.append({"t0": t, "t1": t + 5, "y0": math.nan, "y1": math.nan, "frames": frames, "q_L": math.nan, "q_L_error": math.nan, "dphi_dy": math.nan})
        self.campaign.run("phi0.45-s23-t600-seed1", stress=stress, segregation=flux)
        run, = tables.runs_in(self.campaign.tables)

        class Options:
            window = 10
        point, = stages.points_of(run, Options)
        share = (3 + 4) / (3 + 4 + 2 + 2)
        expected = [5, 6 / 60, 0.25, share - 0.25, 40, 4e-3 / SPEED, 2 * D, (1e-4 * math.hypot(10, 30) / 40 / SPEED) ** 2]
        np.testing.assert_allclose(point, expected, rtol=1e-12)


class Denser(Pipeline):
    """c of the closure, from a weight that only large grains have."""

    PHI = 0.45

    def point(self, excess, value):
        return {"D": excess, "phi": self.PHI, "value": value, "p_zero": 0.65, "dc_dp": 5000.0}

    def test_level_and_slope_of_the_driving_give_back_b_and_c(self):
        """Checks c q = (B (1 + phi D) - D) X for B from 0 to 1."""
        for b in np.linspace(0, 1, 11):
            c = 1000 * (1 + b)
            points = [self.point(excess, (b * (1 + self.PHI * excess) - excess) / c) for excess in (-0.2, 0, 0.2, 1)]
            found = {row["of"]: row["value"] for row in closures.conclusions(points)}
            expected = {"slope": -(1 - b * self.PHI) / c, "at_zero": b / c, "c": c, "B": b, "stops": 1 + b / (1 - b * self.PHI), "share": 0.65 + c / 5000}
            for name, value in expected.items():
                self.assertAlmostEqual(found[name], value, 9, f"{name} where B is {b}")

    def test_intervals_are_those_of_runs_that_scatter_about_the_line(self):
        def line(level, slope):
            return {row["of"]: row for row in closures.conclusions(
                [self.point(excess, level + slope * excess + off) for excess, off in ((-1, 1e-5), (0, -2e-5), (1, 1e-5))])}

        found = line(3e-4, -1e-3)
        # Residuals of 1, -2, 1 over one degree of freedom, t = 12.706: 6e-10; the sum of squares of D is 2.
        of_slope, of_level = 12.706 * math.sqrt(6e-10 / 2), 12.706 * math.sqrt(6e-10 / 3)
        small = 1e-9
        for name, row in found.items():
            by_level = (line(3e-4 + small, -1e-3)[name]["value"] - row["value"]) / small
            by_slope = (line(3e-4, -1e-3 + small)[name]["value"] - row["value"]) / small
            reach = math.hypot(by_level * of_level, by_slope * of_slope)  # level and slope are independent, because the mean of D is 0
            self.assertAlmostEqual((row["value_high"] - row["value"]) / reach, 1, 4, name)

    def test_a_ratio_is_the_mean_of_its_runs_as_sure_as_their_scatter_about_the_line(self):
        points = [self.point(excess, 1e-4 * value) for excess, value in ((0, 3), (0, 5), (1, 1), (1, 3))]
        one, two = closures.ratios(points)
        self.assertEqual((one["of"], one["runs"], two["of"]), ("D = 0", 2, "D = 1"))
        self.assertAlmostEqual(one["value"], 4e-4, 12)
        # Four residuals of 1e-4 over two degrees of freedom, t = 4.303, for the mean of two values.
        self.assertAlmostEqual(one["value_high"] - one["value"], 4.303 * 1e-4 * math.sqrt(4 / 2) / math.sqrt(2), 9)

    def test_ratios_of_one_flow_are_put_on_a_line(self):
        for ratio in ("1", "1.5", "0.5"):
            self.campaign.run(f"phi0.50-s23-mixed-density{ratio}-t60-seed1")
        numbers = ("d_over_c[m^2/s]", "p_zero", "dc_dp[1/s]", "c@size[1/s]", "c@half[1/s]", "d@size[m^2/s^2]", "error_factor")
        for ratio, factor in (("1.5", 2e-4 / 1.25), ("0.5", 6e-4 / 0.75), ("1", 4e-4)):
            rows = [{"quantity": name, "value": 1.0, "low": 1.0, "high": 1.0} for name in numbers]
            self.campaign.answer("grseg-closure", f"density{ratio}-t60-seed1/stress.tsv",
                                 rows=[{"quantity": "B_over_c[s]", "value": factor, "low": factor - 1e-5, "high": factor + 1e-5}, *rows])
        rows = {row["of"]: row for row in self.campaign.made_by("denser", "--flow", "phi0.50-s23-mixed")}
        self.assertAlmostEqual(rows["D = -0.5"]["value"], 6e-4)  # per volume instead of per mass
        self.assertEqual(rows["D = 0"]["value"], 4e-4)
        self.assertAlmostEqual(rows["c"]["value"], 1 / (0.5 * 4e-4 + 4e-4), 3)


class RigidLimit(unittest.TestCase):
    """B of discs that do not overlap, extrapolated from discs that do."""

    def test_of_equal_errors_the_line_is_that_of_the_text_book(self):
        x, y, e = [1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 2.0, 4.0], 0.5
        level, slope, (of_level, _, of_slope), chi2 = tables.line(x, y, [1 / e**2] * 4)
        self.assertAlmostEqual(slope, 0.9)  # sxy/sxx = 4.5/5
        self.assertAlmostEqual(level, 0.0)
        self.assertAlmostEqual(math.sqrt(of_slope), e / math.sqrt(5))
        self.assertAlmostEqual(math.sqrt(of_level), e * math.sqrt(1 / 4 + 2.5**2 / 5))
        self.assertAlmostEqual(chi2, (0.1**2 + 0.2**2 + 0.7**2 + 0.4**2) / e**2)

    def test_a_power_law_is_extrapolated_to_its_limit(self):
        names = ("phi0.45-s23-draft-t150", "phi0.45-s23", "phi0.45-s23-reference-t150", "phi0.45-s23-finer-t150", "phi0.45-s22")
        rows = []
        for name, overlap in zip(names, (2e-3, 8e-4, 1e-4, 2e-5, 1e-1)):
            row = {"flow": name, "overlap": overlap}
            for of, value in {"B": 0.034 + 3 * overlap, "p_star": 0.65 - 0.2 * math.sqrt(overlap), "K": -0.3}.items():
                row.update({of: value, of + "_error": 0.002, of + "_freedom": 3})
            rows.append(row)
        with tempfile.TemporaryDirectory() as work:
            path, out = os.path.join(work, "questions.tsv"), os.path.join(work, "limit.tsv")
            tables.write(path, "rows", list(rows[0]), rows)
            subprocess.run(["/usr/bin/python3", "-B", campaign, "rigid-limit", path, "-o", out], check=True)
            found = {(row["of"], row["power"]): row for row in tables.read(out)[1]}
            self.assertAlmostEqual(found["B", 1]["limit"], 0.034, 7)
            self.assertAlmostEqual(found["B", 1]["k"], 3, 4)
            _, _, (of_limit, _, _), _ = tables.line([row["overlap"] for row in rows[:4]], [row["B"] for row in rows[:4]], [1 / 0.002**2] * 4)
            self.assertAlmostEqual(found["B", 1]["limit_high"] - 0.034, 3.182 * math.sqrt(of_limit), 6)
            self.assertLess(found["B", 1]["chi2"], 1e-6)
            self.assertGreater(found["B", 0.5]["chi2"], 1e-3)
            self.assertAlmostEqual(found["p_star", 0.5]["limit"], 0.65, 6)
            self.assertEqual(found["K", 1]["rows"], 4)
            tables.write(path, "rows", list(rows[0]), rows[:2])
            refused = subprocess.run(["/usr/bin/python3", "-B", campaign, "rigid-limit", path, "-o", out],
                                     capture_output=True, text=True)
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn("three are needed", refused.stderr)


def sphere_layers(whole, b):
    """Rows of grseg-stress, windows of 5 s, with stress that no height changes, in which B of a layer is b(phi_L)."""
    rows = []
    for t in (5, 10, 25, 60, 90):
        for k in range(3, 22):
            phi = (0.37 * k + 0.01 * t + whole) % 0.9 + 0.05
            large = 100 * (phi + b(phi) * phi * (1 - phi))
            rows.append({"t0": t, "t1": t + 5, "y0": k * D, "y1": (k + 1) * D, "frames": 50, "V": 1e-3, "volume_S": 1 - phi, "volume_L": phi,
                         "A_SS_yy": 100 - large, "A_LL_yy": large, **dict.fromkeys(("A_Sb_yy", "A_Lb_yy", "M_yy", "Msize_yy"), 0.0)})
    return rows


class Spheres(Pipeline):
    """B of chutes of spheres."""

    def test_b_of_a_layer_is_found_by_its_composition_at_any_time(self):
        for seed, more in ((1, 0.001), (2, -0.001)):
            for whole in (0.3, 0.6):
                self.campaign.run(f"phi{whole:.2f}-s26-seed{seed}", stress_branch_1dS=sphere_layers(whole, lambda phi: 0.2 * phi - 0.02 + more))
        self.campaign.answer("grseg-fit", rows=fitted(B=(0.04, 0.03, 0.05), p_zero=0.64))
        rows = self.campaign.made_by("spheres")
        of = {row["name"]: row for row in rows if row["of"] == "phi_L"}
        self.assertAlmostEqual(of["excess over phi"]["value"], 0.2, 9)
        self.assertAlmostEqual(of["excess over whole"]["value"], 0, 9)
        for k in range(1, 9):
            self.assertAlmostEqual(of[f"all {k}"]["value"], 0.02 * (k + 0.5) - 0.02, delta=0.011)
        # Two seeds that differ by 0.002: the half-width is Student's 12.7 times 0.001.
        self.assertAlmostEqual(of["early 5"]["high"] - of["early 5"]["value"], 0.0127, 4)
        b = next(row for row in rows if row["of"] == 0.3 and row["name"] == "B 60-100")
        self.assertEqual((b["value"], b["low"], b["high"]), (0.04, 0.03, 0.05))

    def test_a_class_without_grains_has_no_b(self):
        layers = sphere_layers(0.3, lambda phi: 0.05)
        self.campaign.run("phi0.30-s26-seed1", stress_branch_1dS=[row for row in layers if row["volume_L"] < 0.5])
        rows = self.campaign.made_by("spheres")  # without an answer of grseg-fit, too
        of = {row["name"]: row["value"] for row in rows}
        self.assertAlmostEqual(of["all 2"], 0.05, 9)
        self.assertTrue(math.isnan(of["all 7"]))
        self.assertTrue(math.isnan(of["B 10-20"]))

    def test_tables_of_a_sweep_are_kept_under_names_of_the_campaign(self):
        sweep = os.path.join(self.temporary.name, "tables")
        layers = sphere_layers(0.3, lambda phi: 0.05)
        plain = {name: layers for name in ("stress", "stress_branch_1dS", "kinetic_2dS", "micro_2dS", "segregation")}
        self.campaign.run("a", **plain)
        os.makedirs(os.path.join(sweep, "unfinished"))
        with open(os.path.join(sweep, "runs.tsv"), "w") as runs:
            runs.write("run\tflow\tphi-large\tseed\na\tx\t0.3\t2\nunfinished\tx\t0.3\t3\n")
        archive = os.path.join(sweep, "spheres.tar.bz2")
        subprocess.run(["/usr/bin/python3", "-B", campaign, "keep", sweep, archive, "--spheres"], check=True)
        with tarfile.open(archive) as kept:
            self.assertEqual(sorted(kept.getnames()), sorted(f"phi0.30-s23-seed2/{name}" for name in
                             ["checksums", *(name.replace("_", "-") + ".tsv" for name in plain)]))
            text = kept.extractfile("phi0.30-s23-seed2/stress-branch-1dS.tsv").read().decode()
        self.assertIn("# window: 5", text)
        self.assertEqual(len(text.splitlines()) - text.count("#"), 1 + len(layers))


class Answers(unittest.TestCase):
    """The tables between markers in a document."""

    def rewritten(self, text, **of_folder):
        with tempfile.TemporaryDirectory() as work:
            for name, rows in of_folder.items():
                tables.write(os.path.join(work, name.replace("_", "-") + ".tsv"), name, list(rows[0]), rows)
            path = os.path.join(work, "page.md")
            with open(path, "w") as page:
                page.write(text)
            done = subprocess.run(["/usr/bin/python3", "-B", campaign, "answers", work, path], capture_output=True, text=True)
            with open(path) as page:
                return done, page.read()

    def test_only_the_part_between_markers_changes(self):
        stage = {"of": "both", "what": "k", "value": 0.1234, "low": 0.1, "high": 0.2, "over": "2 runs"}
        before = "one\n<!-- stages -->\nold\n<!-- /stages -->\ntwo\n"
        _, after = self.rewritten(before, stages=[stage])
        self.assertEqual(after, "one\n<!-- stages -->\n| model |  | value | 95 % over |\n|---|---|---|---|\n| both | k | 0.123 [0.100, 0.200] | 2 runs |\n<!-- /stages -->\ntwo\n")

    def test_runs_with_and_without_a_trapped_row_make_no_interval(self):
        def row_of(trapped, reach):
            row = {"flow": "phi0.30-s23", "runs": 4, **{name + end: 0.1 for name in ("B", "B_all", "K") for end in ("", "_low", "_high")},
                   **{name + end: 0.5 for name in ("yL_end", "f_ratio", "rate") for end in ("", "_reach")}, "trapped": trapped, "trapped_reach": reach}
            return [cell.strip("| ") for cell in answers.beds([row], ".*").splitlines()[-1].split(" | ")]
        self.assertEqual(row_of(26.0, 27.0)[3:6], ["0.100 ¹", "0.500 ¹", "26.0 ¹"])
        for trapped, reach in ((35.0, 0.5), (0.8, 1.6)):
            self.assertEqual(row_of(trapped, reach)[3], "0.100 [0.100, 0.100]")

    def test_each_table_stands_in_one_of_several_documents(self):
        with tempfile.TemporaryDirectory() as work:
            stage = {"of": "both", "what": "k", "value": 0.1234, "low": 0.1, "high": 0.2, "over": "2 runs"}
            tables.write(os.path.join(work, "stages.tsv"), "stages", list(stage), [stage])
            pages = [os.path.join(work, name) for name in ("a.md", "b.md")]
            for page, text in zip(pages, ("one\n", "two\n<!-- stages -->\n<!-- /stages -->\n")):
                with open(page, "w") as out:
                    out.write(text)
            words = ["/usr/bin/python3", "-B", campaign, "answers", work, *pages]
            subprocess.run(words, check=True)
            with open(pages[0]) as a, open(pages[1]) as b:
                self.assertEqual(a.read(), "one\n")
                self.assertIn("| both | k | 0.123 [0.100, 0.200] | 2 runs |", b.read())
            with open(pages[0], "a") as out:
                out.write("<!-- stages -->\n<!-- /stages -->\n")
            self.assertIn("once", subprocess.run(words, capture_output=True, text=True).stderr)

    def test_densities_stand_in_their_order(self):
        row = lambda ratio, value: {"flow": f"phi0.45-s23-mixed-density{ratio}-t60", "runs": 2, "end": 60,
                                    **{name + end: value for name in ("B", "p_star", "B_half_rule") for end in ("", "_low", "_high")}}
        lines = answers.beds_of_densities([row("2", 0.05), row("0.8", 0.03), {**row("1", 0.04), "flow": "phi0.45-s23"}]).splitlines()
        self.assertEqual([line.split(" | ")[0].strip("| ") for line in lines[2:]], ["0.8", "2"])
        self.assertIn("| 0.8 | 0.030 [0.030, 0.030] |", lines[2])

    def test_b_by_time_has_a_column_for_each_start(self):
        row = lambda of, what, value: {"of": of, "what": what, "value": value, "low": value - 0.01, "high": value + 0.01, "over": "4 blocks"}
        text = answers.stages([row("+q", "j", 0.2), row("a 5-20 s", "B", 0.05), row("b 5-20 s", "B", 0.03), row("a 5-20 s", "B over 3 classes", 0.04),
                               row("b 5-20 s", "B over 3 classes", 0.035)])
        self.assertIn("| time | a, B | b, B | 95 % over |", text)
        self.assertIn("| 5-20 s | 0.050 [0.040, 0.060] | 0.030 [0.020, 0.040] | 4 blocks |", text)
        self.assertIn("| +q | j | 0.200 [0.190, 0.210] | 4 blocks |", text)

    def test_spheres_have_a_row_for_each_mixture_and_each_class_of_composition(self):
        names = ["B 10-20", "B 20-30", "B 60-100", "B kept 4dS 60-100", "p_star", "B half", "B_kappa"]
        rows = [{"of": phi, "name": name, "value": value, "low": value - 0.01, "high": value + 0.01}
                for phi, value in (("0.30", 0.04), ("0.45", 0.06)) for name in names]
        rows += [{"of": "phi_L", "name": f"{name} {k}", "value": 0.1 if k < 9 else math.nan, "low": math.nan, "high": math.nan}
                 for name in ("all", "early", "late") for k in range(10)]
        _, after = self.rewritten("".join(f"<!-- {name} -->\n<!-- /{name} -->\n" for name in ("spheres", "spheres-composition")), spheres=rows)
        self.assertIn("\n| 0.30 | 0.040 [0.030, 0.050] |", after)
        self.assertIn("\n| 0.8 to 0.9 | 0.100 | 0.100 | 0.100 |\n| 0.9 to 1 |  |  |  |\n", after)

    def test_runs_without_a_place_in_the_document_are_refused(self):
        stage = {"of": "both", "what": "k", "value": 0.1234, "low": 0.1, "high": 0.2, "over": "2 runs"}
        done, after = self.rewritten("nothing\n", stages=[stage])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("<!-- stages -->", done.stderr)
        self.assertEqual(after, "nothing\n")

    def test_each_flow_stands_under_its_question(self):
        flows = {"control": "phi0.45-s23-ratio1-t60", "grains": "phi0.45-s23-ratio1.5-t60", "starts": "phi0.45-s23-mixed-t600",
                 "second-program": "phi0.45-s23-lammps100000"}
        row = lambda flow: {"flow": flow, "runs": 4, "end": 60, **{name + end: 0.03 for name in ("B", "p_star", "B_half_rule", "K")
                                                                   for end in ("", "_low", "_high")},
                            "less_B": 0.0, "less_B_reach": 0.1, "less_K": 0.0, "less_K_reach": 0.1}
        page = "".join(f"<!-- {name} -->\n<!-- /{name} -->\n" for name in flows)
        done, after = self.rewritten(page, questions=[row(flow) for flow in flows.values()])
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, flow in flows.items():
            part = after.split(f"<!-- {name} -->")[1].split(f"<!-- /{name} -->")[0]
            self.assertEqual([line.split("|")[1].strip() for line in part.strip().splitlines()[2:]], [flow])


if __name__ == "__main__":
    unittest.main()
