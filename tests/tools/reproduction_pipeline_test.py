#!/usr/bin/python3
"""numbers, fits, flows, choices and mixtures as whole programs, on runs whose results are known in advance.

Usage: reproduction_pipeline_test.py SCRIPTS
"""
import argparse
import math
import os
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
from unittest import mock

import numpy as np

sys.dont_write_bytecode = True
from known_campaign import Campaign, D, G, HEAD, Pipeline, RHO, SLOPE, UNIT, campaign, fitted, scripts, text_of  # noqa: E402
import flows  # noqa: E402
import keep  # noqa: E402
import measured  # noqa: E402
import measures as numbers  # noqa: E402
import profiles  # noqa: E402
import questions  # noqa: E402
import rise  # noqa: E402
import rounding  # noqa: E402
import stages  # noqa: E402
import statements  # noqa: E402
import tables  # noqa: E402
import targets  # noqa: E402
import verdicts  # noqa: E402


NAN = math.nan


def layer(n, t=0, small=0.5, large=0.5, frames=1, **sums):
    """A row of layer n, 4 d_S high, in a cell of 70 d_S, filled to 0.8 by both species in these proportions."""
    height, volume = 4 * D, 70 * D * 4 * D
    row = {"t0": t, "t1": t + 1, "y0": n * height, "y1": (n + 1) * height, "frames": frames, "V": volume,
           "area_S": 0.8 * volume * small, "area_L": 0.8 * volume * large}
    for part in profiles.CONTACTS:
        row.update({f"{part}_{c}": sums.get(f"{part}_{c}", 0.0) for c in ("xx", "yy")})
    return row


def moving(n, t=0, energy=0.0, bias=0.0):
    """Row of the kinetic table: energy of each species in xx and yy, and the part that the layer's mean adds to xx."""
    row = {"t0": t, "t1": t + 1, "y0": n * 4 * D, "y1": (n + 1) * 4 * D, "frames": 1}
    for s in "SL":
        row.update({f"K_{s}_xx": energy / 2, f"K_{s}_yy": energy / 2, f"layer_bias_{s}_xx": bias, f"layer_bias_{s}_yy": 0})
    return row


class Numbers(Pipeline):
    """The measurements of scripts/reproduce/campaign numbers one by one, on a run and on answers that are known."""

    def part(self, **quantities):
        self.campaign.run("phi0.30-s23-seed1", **quantities)
        return numbers.Part(tables.runs_in(self.campaign.tables))

    def with_answers(self, answer, measure, part):
        """Replaces programs: `answer(words)` returns the rows that a program prints."""
        told, numbers.tables.program = numbers.tables.program, \
            lambda options, name, *words: ({}, answer([name, *map(str, words)]))
        try:
            return measure(None, part)
        finally:
            numbers.tables.program = told

    def bed(self, layers=15, prefactor=0.5, decay=7.5):
        """A bed at rest whose mixed contacts carry the weight above. Its temperature is
        prefactor exp(-y/(decay d_L)) rho g d_S, per bulk volume."""
        stress, kinetic = [], []
        for n in range(layers):
            y = (n + 0.5) * 4 * D
            volume = layer(n)["V"]
            above = 0.8 * G * math.cos(SLOPE) * (layers * 4 * D - y)
            hot = prefactor * math.exp(-y / (decay * 2 * D)) * UNIT
            stress.append(layer(n, M_xx=above * volume, M_yy=(above - hot) * volume))
            kinetic.append(moving(n, energy=hot * volume, bias=0.25 * hot * volume))
        return numbers.pressures(None, self.part(stress=stress, kinetic=kinetic))

    def test_kinetic_pressure_that_falls_exponentially_has_its_prefactor_at_the_base_and_its_length_in_large_diameters(self):
        found = self.bed()
        self.assertAlmostEqual(found["K_prefactor"], 0.5, 9)
        self.assertAlmostEqual(found["K_decay"], 7.5, 9)
        self.assertAlmostEqual(found["K_solid_prefactor"], 0.5 / 0.8, 9)
        # Heights from 4 to 56 d_S: the lowest layer, 4 d_S high, is around 6 d_S.
        self.assertAlmostEqual(found["K_lowest"], 0.5 * math.exp(-6 / 15), 9)
        # About the layer's mean, two biases of a quarter are added to xx; half of each is pressure.
        self.assertAlmostEqual(found["shear_share"], 0.25, 9)

    def test_mixed_contacts_alone_may_carry_the_whole_bed(self):
        self.assertAlmostEqual(self.bed()["weight"], 1, 9)

    def test_b_of_the_micro_structure_weighs_by_frames_and_grains_of_the_rarer_species_within_a_hundred_to_one(self):
        # ln s is -0.1 with weight 2 x 30 and -0.4 with 1 x 20; a layer of almost only small grains is left out.
        frames, weights, phis = (2, 1, 5), (30, 20, 1), (0.5, 0.3, 0.001)
        slopes = (math.exp(-0.1), math.exp(-0.4), 5.0)
        part = self.part(micro=[{"t0": 0.0, "y0": float(k), "grains_S": w, "grains_L": w + 7} for k, w in enumerate(weights)])
        rows = [{"t0": 0.0, "y0": float(k), "frames": frames[k], "phi_L": phis[k], "s_Pi": slopes[k]} for k in range(3)]
        s = math.exp((60 * -0.1 + 20 * -0.4) / 80)
        found = self.with_answers(lambda _: rows, lambda options, part: numbers.b_of_structure(options, part.runs, []), part)
        self.assertAlmostEqual(found, 2 * (1 - s) / (1 + s), 9)

    def test_errors_of_pi_are_sizes_and_the_mixed_share_lies_above_neutral_contacts_where_it_is_larger(self):
        bins = [{"phi_L": 0.6, "mixed_share": 0.49, "neutral_share": 0.50, "error": -0.02, "error_S": 0.05,
                 "error_L": -0.01, "error_printed": 0.96, "error_S_printed": 1.1, "error_L_printed": 0.98},
                {"phi_L": 0.1, "mixed_share": 0.13, "neutral_share": 0.10, "error": 0.04, "error_S": 0.07,
                 "error_L": 0.01, "error_printed": 1.08, "error_S_printed": 1.14, "error_L_printed": 1.02}]
        layers = [{"t0": 0.0, "y0": 0.0, "frames": 1, "phi_L": 0.5, "s_Pi": 1.0}]
        part = self.part(micro=[{"t0": 0.0, "y0": 0.0, "grains_S": 1, "grains_L": 1}])
        answer = lambda words: bins if "composition" in words else layers
        found = self.with_answers(answer, numbers.estimates, part)
        self.assertAlmostEqual(found["contacts_error_mean"], 3)
        self.assertAlmostEqual(found["contacts_error_most"], 4)
        self.assertAlmostEqual(found["contacts_error_S_signed"], 6)
        self.assertAlmostEqual(found["contacts_error_printed_most"], 108)
        found = self.with_answers(answer, numbers.mixed_share, part)
        self.assertAlmostEqual(found["mixed_off_least"], -0.01)
        self.assertAlmostEqual(found["mixed_off_most"], 0.03)
        self.assertEqual((found["mixed_most"], found["mixed_most_at"]), (0.49, 0.6))

    def test_the_end_of_figure_6_is_the_mean_of_its_last_twelve_and_a_half_seconds(self):
        rows = []
        for k in range(20):  # windows of 2.5 s; the last five are the end
            late = k >= 15
            rows.append({"t0": 2.5 * k, "t1": 2.5 * (k + 1), "y0": NAN, "yL/H": 0.02 * k, "z_S": 2.0,
                         "z_L": 2.0 + (0.5 + 0.1 * (k - 17) if late else 1.0 if k == 4 else 0), "f_S": 1.0,
                         "f_L": 3.0 if late else 2.0, "f_depth_S": 1.0, "f_depth_L": 4.0,
                         "f_weight_neutral_S": 1.0, "f_weight_neutral_L": 2.5})
        found = self.with_answers(lambda _: rows, numbers.over_time, self.part(micro=[{"t0": 0}]))
        self.assertAlmostEqual(found["yL_last"], 0.02 * 17)
        self.assertAlmostEqual(found["z_last"], 1.25)
        self.assertEqual((found["z_most"], found["z_most_at"], found["f_below_neutral"]), (1.5, 10, 15))

    def test_a_push_in_the_direction_of_the_weight_is_negative_and_outside_of_the_middle_none_counts(self):
        rows = [{"t0": 0, "t1": 1, "y0": n * 4 * D, "y1": (n + 1) * 4 * D, "gravity_L_y": -2.0, "push": push,
                 "push_kinetic": -0.01, "drag": 0.0} for n, push in ((0, 9.0), (1, 0.05), (2, 0.03), (14, 9.0))]
        found = numbers.pushes(None, self.part(balance=rows))
        self.assertAlmostEqual(found["push"], 1000 * 0.08 / 4)
        self.assertAlmostEqual(found["push_kinetic"], -1000 * 0.02 / 4)

    def test_large_grains_have_gone_the_whole_way_where_they_fill_the_upper_part_of_the_bed(self):
        # 30 % of large grains: their centre of mass is at 0.15 of the height if they are below the small ones, at 0.85
        # if above.
        def way(height):
            micro = [{"t1": 1.0, "y0": 0.0, "area_S": 0.7, "area_L": 0.0, "grains_L": 0},
                     {"t1": 1.0, "y0": 1.0, "area_S": 0.0, "area_L": 0.3, "grains_L": 9}]
            with tempfile.TemporaryDirectory() as folder:
                self.campaign = Campaign(folder)
                return self.with_answers(lambda _: [{"t1": 1.0, "y0": NAN, "yL/H": height}], numbers.separation,
                                         self.part(micro=micro))["way"]
        self.assertAlmostEqual(way(0.15), 0)
        self.assertAlmostEqual(way(0.85), 1)

    def test_differences_are_early_minus_late_pressure_minus_yy_and_kinetic_over_contact(self):
        b = {"early": 0.05, "late": 0.03, "pressure": 0.045, "kinetic": -0.4, "all": 0.04}

        def answer(words):
            which = "early" if "--end" in words else "late" if "--begin" in words else \
                "pressure" if "pressure" in words else "kinetic" if "kinetic" in words else "all"
            self.assertEqual([words[words.index(name) + 1] for name in ("--end", "--begin") if name in words],
                             {"early": ["60"], "late": ["100"]}.get(which, []))
            return fitted(B=b[which], paper_B=b[which])

        found = self.with_answers(answer, numbers.differences, self.part())
        self.assertAlmostEqual(found["early_less_late"], 0.02)
        self.assertAlmostEqual(found["pressure_less_yy"], 0.005)
        self.assertAlmostEqual(found["B_kappa/B"], 10)

    def test_the_interval_of_a_number_is_students_t_times_its_standard_error_over_seeds(self):
        answers = iter([{"n": 1.0}, {"n": 2.0}, {"n": 3.0}])
        [line] = numbers.collected(None, "mixtures", [numbers.Part([]) for _ in range(3)], lambda *_: next(answers))
        self.assertAlmostEqual(line["error"], math.sqrt(1 / 3), 3)
        self.assertAlmostEqual(line["high"] - line["value"], 4.3026527 * math.sqrt(1 / 3), 3)


class Fits(Pipeline):
    def test_each_set_has_its_runs_and_each_stage_its_times(self):
        for name in ("phi0.30-s23-seed1", "phi0.30-s23-seed2", "phi0.45-s23-seed1", "phi0.45-s21-seed1",
                     "phi0.45-s23-e0.5-seed1", "phi0.45-s23-ratio1-seed1"):
            self.campaign.run(name)
        self.campaign.answer("grseg-fit", rows=fitted(paper_s=(0.9, 0.8, 1.0)))
        rows = self.campaign.made_by("fits")
        seeds = {row["set"]: row["seeds"] for row in rows}
        self.assertEqual(seeds, {"mixtures": 3, "slopes": 2, "control": 1, "phi0.30-s23": 2, "phi0.45-s23": 1,
                                 "phi0.45-s21": 1})
        self.assertEqual({row["paper_s"] for row in rows}, {0.9})
        asked = self.campaign.asked()
        runs = lambda words: sorted(os.path.basename(os.path.dirname(word)) for word in words if word.endswith(".tsv"))
        slopes = [words for words in asked if runs(words) == ["phi0.45-s21-seed1", "phi0.45-s23-seed1"]]
        self.assertTrue(slopes)
        early = [words for words in slopes if "--end" in words]
        late = [words for words in slopes if "--begin" in words]
        self.assertTrue(early and late)
        for words in early:
            self.assertEqual(words[words.index("--end") + 1], "60")
            self.assertNotIn("--begin", words)
        for words in late:
            self.assertEqual(words[words.index("--begin") + 1], "100")
            self.assertNotIn("--end", words)
        control = [words for words in asked if runs(words) == ["phi0.45-s23-ratio1-seed1"]]
        self.assertTrue(control and all(words[1].endswith("stress-random.tsv") for words in control))
        # Without the lowest layer and the surface, unless all heights are asked for.
        self.assertEqual({words[words.index("--heights") + 1] for words in asked if "--heights" in words}, {"4dS:56dS", "all"})


class Flows(Pipeline):
    def flow(self, fits):
        rows = [{"t0": t, "t1": t + 5.0, "y0": NAN, "frames": frames, "height": 60 * D, "yL": 15 * D, "shear_rate": rate,
                 "strain": 100.0} for t, frames, rate in ((0.0, 1, 900.0), (5.0, 1, 500.0), (10.0, 1, 10.0), (15.0, 3, 30.0))]
        record = [{"name": "program", "value": "grseg"}, {"name": "grains_small", "value": "4"},
                  {"name": "grains_large", "value": "2"}]
        summary = [{"quantity": "t50[s]", "value": 7.0}, {"quantity": "tau[s]", "value": 9.0}]
        contacts = [{**layer(n, small=0.5, large=0.5), "frames": 3} for n in range(15)]
        self.campaign.run("phi0.45-s23-seed1", segregation=rows, record=record, segregation_summary=summary,
                          stress=contacts)
        self.campaign.answer("--pool", "windows", rows=[{"z_S": 1.0, "z_L": 1.0, "f_weight_S": 1.0, "f_weight_L": 1.0},
                                                        {"z_S": 2.0, "z_L": 3.0, "f_weight_S": 5.0, "f_weight_L": 7.0}])
        self.campaign.answer("--scan", rows=[{"p": 0.6, "B": 0.0}], head=(("p_zero", 0.65),))
        path = os.path.join(self.temporary.name, "fits.tsv")
        with open(path, "w") as table:
            table.write(text_of(fits))
        return self.campaign.made_by("flows", path)[0]

    def fit(self, value, heights="inside", stage="all", component="yy", quantity="contact", rule="size"):
        return {"set": "phi0.45-s23", "quantity": quantity, "stage": stage, "component": component, "heights": heights,
                "rule": rule, **{name + end: value + off for name in ("B", "paper_B") for end, off in (("", 0), ("_low", -1), ("_high", 2))}}

    def test_the_mean_shear_rate_leaves_out_the_spin_up_and_is_in_units_of_the_root_of_g_over_d(self):
        row = self.flow([self.fit(1.0)])
        self.assertAlmostEqual(row["rate"], (10 + 3 * 30) / 4 * math.sqrt(D / G), 7)
        self.assertAlmostEqual(row["H0"], 60, 7)
        self.assertAlmostEqual(row["yL0"], 0.25, 7)
        self.assertEqual((row["zf_S"], row["zf_L"]), (10, 21))

    def test_a_flow_weighs_in_a_fit_by_frames_times_the_product_of_both_parts_inside(self):
        # 13 of 15 layers of three frames, half of each species.
        self.assertAlmostEqual(self.flow([self.fit(1.0)])["weight"], 3 * 13 / 4, 7)

    def test_b_of_a_flow_is_that_by_size_of_yy_inside_whatever_else_was_fitted(self):
        row = self.flow([self.fit(1.0, heights="all"), self.fit(2.0, component="pressure"), self.fit(3.0, rule="half"),
                         self.fit(4.0, stage="early"), self.fit(5.0), self.fit(6.0, quantity="kinetic", rule="kinetic")])
        self.assertEqual([row[name] for name in ("B", "B_low", "B_high", "B60", "K")], [5, 4, 7, 4, 6])


class Choices(Pipeline):
    def test_a_choice_is_compared_with_the_same_times_of_its_own_flow(self):
        for name in ("phi0.45-s23-seed1", "phi0.45-s23-e0.5-seed1"):
            self.campaign.run(name, stress=[layer(0)], kinetic=[moving(0)], stress_branch=[layer(0)])
        at = lambda b: fitted("size", B_windows=(b, b - 1, b + 1)) + fitted("half", B_windows=(b, b - 1, b + 1))
        self.campaign.answer("e0.5-seed1/stress.tsv", rows=at(0.5))
        self.campaign.answer("e0.5-seed1/kinetic.tsv", rows=at(-0.5))
        self.campaign.answer("stress-branch.tsv", rows=at(0.35))
        self.campaign.answer("stress.tsv", "--end", rows=at(0.1))
        self.campaign.answer("stress.tsv", rows=at(0.3))
        self.campaign.answer("kinetic.tsv", "--end", rows=at(-0.1))
        self.campaign.answer("kinetic.tsv", rows=at(-0.3))
        rows = {row["choice"]: row for row in self.campaign.made_by("choices")}
        # Another simulation is compared with the first 60 s of the flow; another evaluation of the same frames with all
        # of them.
        self.assertAlmostEqual(rows["restitution 0.5 instead of 0.25"]["less"], 0.4)
        self.assertAlmostEqual(rows["restitution 0.5 instead of 0.25"]["K_less"], -0.4)
        self.assertAlmostEqual(rows["contacts booked along the branch"]["less"], 0.05)
        self.assertEqual(rows["all times"]["less"], 0)

    def test_a_choice_whose_base_is_missing_is_compared_with_none(self):
        self.campaign.run("phi0.45-s23-seed1")
        for variant, b in (("e0.5", 0.5), ("draft", 0.7)):
            self.campaign.run(f"phi0.45-s23-{variant}-seed1", stress=[layer(0)])
            self.campaign.answer(f"{variant}-seed1/stress.tsv", rows=fitted("size", B_windows=b) + fitted("half", B_windows=b))
        rows = self.campaign.made_by("choices")
        self.assertEqual([(row["B"], row["less"]) for row in rows], [(0.5, 0), (0.7, 0)])


class Mixtures(Pipeline):
    def test_each_mixture_has_a_scan_and_a_row_for_each_rule(self):
        for name in ("phi0.30-s23-seed1", "phi0.30-s23-seed2", "phi0.45-s23-e0.5-seed1"):
            self.campaign.run(name, stress=[layer(0)])
        self.campaign.answer("--scan", rows=[{"p": 0.6, "B": 0.01}])
        self.campaign.answer("--partition", rows=fitted("size", B=(0.03, 0.02, 0.04), share=0.66) + fitted("half", B=-0.2, share=0.5))
        rows = self.campaign.made_by("mixtures", table="rules.tsv")
        self.assertEqual([[row[name] for name in ("flow", "phi", "runs", "rule", "B", "share")] for row in rows],
                         [["phi0.30-s23", 0.3, 2, "size", 0.03, 0.66], ["phi0.30-s23", 0.3, 2, "half", -0.2, 0.5]])
        _, scan = tables.read(os.path.join(self.campaign.folder, "made.tsv", "scan-phi0.30-s23.tsv"))
        self.assertEqual(scan, [{"p": 0.6, "B": 0.01}])


class Profiles(unittest.TestCase):
    """scripts/profile --balance on tables that are known."""

    def profile(self, drifts, *words):
        """The script's exit code, rows and messages for one layer with these drifts, one in each window of 1 s."""
        zero = {f"{term}_{s}_{axis}": 0.0 for term in ("rate", "gravity", "contact", "kinetic", "interaction", "base", "residual")
                for s in "SL" for axis in "xy"}
        rows = [{"t0": t, "t1": t + 1, "y0": 0.0, "y1": 4 * D, "phi_L": 0.5, "psi_L": 0.6, "psik_L": 0.4, "push": 0.0,
                 "push_kinetic": 0.0, "scatter": 0.0, "rho_L": 1.0, **zero, "gravity_L_y": -1.0, "drag": -3.0, "drift": drift}
                for t, drift in enumerate(drifts)]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "balance.tsv")
            with open(path, "w") as table:
                table.write(text_of(rows, HEAD))
            done = subprocess.run(["/usr/bin/python3", "-B", os.path.join(scripts, "profile"), "--balance", path, *words],
                                  capture_output=True, text=True)
        return done.returncode, tables.parse(done.stdout)[1] if done.stdout else [], done.stderr

    def test_c_is_missing_only_where_the_drift_is_known_to_be_small(self):
        for drifts, c in (((2.0,), 1.5), ((2.0, 2.1, 1.9), 1.5), ((2.0, -1.9), NAN)):
            with self.subTest(drifts):
                _, [row], _ = self.profile(drifts)
                np.testing.assert_allclose(row["c"], c)

    def test_the_last_third_of_a_balance_leaves_out_earlier_windows(self):
        _, [row], _ = self.profile((1.0, 1.0, 6.0), "--last-third")
        self.assertEqual((row["windows"], row["drift"]), (1, 6))

    def test_tables_of_kinetic_stress_beside_a_balance_are_refused(self):
        code, _, words = self.profile((1.0,), "--kinetic", "kinetic.tsv")
        self.assertEqual(code, 2)
        self.assertIn("--kinetic is for stress tables; leave it out with --balance\n", words)


class Files(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def test_a_table_with_a_changed_digit_is_refused_by_all_that_use_its_numbers(self):
        path, whole = (os.path.join(self.folder, name) for name in ("changed.tsv", "whole.tsv"))
        text = tables.shared.sealed("# program: grseg-stress\nt0[s]\tt1[s]\ty0[m]\n0\t1\t0\n")
        for name, of in ((whole, text), (path, text.replace("0\t1\t0\n", "0\t2\t0\n"))):
            with open(name, "w") as table:
                table.write(of)

        class Run:
            flow = "phi0.45-s23"

            def path(self, _):
                return path

            def has(self, _):
                return True

        run = Run()
        uses = {"last_third": lambda: profiles.last_third(path), "Profile": lambda: profiles.Profile([path]),
                "beside": lambda: profiles.Layers([whole], [path]), "rise": lambda: rise.layers_of(path),
                "flows": lambda: flows.weight([run]), "stages": lambda: stages.points_of(run, None),
                "rounding": lambda: rounding.of_tables([path]), "parts_of": lambda: numbers.parts_of([run]),
                "last_layers": lambda: numbers.last_layers(numbers.Part([run])),
                "b_of_structure": lambda: numbers.b_of_structure(None, [run], []), "of_bed": lambda: questions.of_bed(run),
                "force_ratio": lambda: questions.force_ratio(run), "line": lambda: questions.line(None, run.flow, [run], [])}
        for name, use in uses.items():
            with self.subTest(name), self.assertRaisesRegex(SystemExit, f"^{path}: does not agree with .*; it is damaged, make it again$"):
                use()
        for words in (["profile", path], ["archives/stress-atom", "run.h5", path, "atoms.dump"]):
            with self.subTest(words[0]):
                done = subprocess.run(["/usr/bin/python3", "-B", os.path.join(scripts, words[0]), *words[1:]], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertRegex(done.stderr, f"^{path}: does not agree with .*; it is damaged, make it again\n$")
        with self.assertRaisesRegex(SystemExit, "^nowhere.tsv: No such file or directory$"):
            profiles.last_third("nowhere.tsv")

    def test_unpacked_tables_are_newer_than_what_was_made_from_those_before(self):
        options = argparse.Namespace(kept=self.folder, folder=os.path.join(self.folder, "unpacked"))
        archive, stale = os.path.join(self.folder, "tables.tar.bz2"), os.path.join(options.folder, "stale.tsv")
        with tarfile.open(archive, "w:bz2") as kept:
            kept.addfile(tarfile.TarInfo("phi0.30-s23-seed1/stress.tsv"))
        os.mkdir(options.folder)
        with open(stale, "w"):
            pass
        before = time.time()
        keep.unpack(options)
        self.assertGreater(os.path.getmtime(os.path.join(options.folder, "phi0.30-s23-seed1", "stress.tsv")), before - 1)
        self.assertFalse(os.path.exists(stale))
        os.utime(archive, (before + 60, before + 60))
        with mock.patch("os.rmdir", side_effect=PermissionError), self.assertRaises(PermissionError):
            keep.unpack(options)

    def test_messages_of_a_tool_are_seen_and_the_log_has_only_the_cost_of_its_table(self):
        done = subprocess.run(["/usr/bin/python3", "-B", os.path.abspath(campaign), "table", "x.tsv", "sh", "-c", "echo doubt >&2; echo table"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", "doubt\n"))
        with open(os.path.join(self.folder, "x.tsv")) as table, open(os.path.join(self.folder, "run.log")) as log:
            self.assertEqual(table.read(), "table\n")
            self.assertRegex(log.read(), r"^x\.tsv made in \S+ s, processor \S+ \+ \S+ s\n$")


class Statistics(unittest.TestCase):
    def test_the_listed_quantiles_are_those_of_students_distribution(self):
        for freedom, t in tables.shared.STUDENT.items():
            if freedom > 1000:
                continue
            # Density of Student's t, integrated by Simpson's rule from 0 to the quantile: 0.475.
            log = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - math.log(freedom * math.pi) / 2
            density = lambda x: math.exp(log - (freedom + 1) / 2 * math.log1p(x * x / freedom))
            n = 2000
            h = t / n
            area = h / 3 * (density(0) + density(t) + sum((4 if k % 2 else 2) * density(k * h) for k in range(1, n)))
            self.assertAlmostEqual(area, 0.475, 4, f"{freedom} degrees of freedom")
        for freedom, t in ((2.5, 3.5582), (12, 2.1788), (45, 2.0141), (1e9, 1.96), (1e12, 1.96)):
            self.assertLess(abs(tables.student(freedom) / t - 1), 0.03, freedom)

    def test_the_error_of_a_ratio_with_equal_denominators_is_that_of_a_mean(self):
        [value], [error] = profiles.ratio(np.array([5.0, 10.0, 15.0, 30.0]), np.full(4, 5.0), np.zeros(4, int))
        self.assertAlmostEqual(value, 3)
        self.assertAlmostEqual(error, math.sqrt((4 + 1 + 0 + 9) / 3 / 4))

    def test_the_level_of_a_line_at_0_is_less_certain_the_farther_off_the_points_are(self):
        x, off = [9.0, 10.0, 11.0], [0.1, -0.2, 0.1]
        _, level = measured.line_fit(x, off)
        # Residual variance 0.06 over one degree of freedom; at x = 0, which is 10 from the mean: 1/3 + 100/2 of it.
        self.assertAlmostEqual(level.high - level.value, 12.706 * math.sqrt(0.06 * (1 / 3 + 50)), 9)

    def test_the_negative_of_an_interval_is_turned_round(self):
        value = -measured.Value(-0.3, -0.4, -0.1)
        self.assertEqual((value.value, value.low, value.high), (0.3, 0.1, 0.4))

    def test_the_last_third_of_150_seconds_begins_at_100(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "stress.tsv")
            with open(path, "w") as table:
                table.write(text_of([{"t1": 75.0}, {"t1": 150.0}]))
            self.assertAlmostEqual(profiles.last_third(path), 100)


class Verdicts(unittest.TestCase):
    def test_b_is_positive_only_where_that_of_every_mixture_is_however_sure_all_together_are(self):
        value = measured.Value

        class Mixtures:
            of = {"phi0.06-s23": value(0.03, -0.01, 0.07), "phi0.45-s23": value(0.04, 0.03, 0.05),
                  "mixtures": value(0.04, 0.035, 0.045)}

            def mixtures(self):
                return [{"flow": flow, "B": self.of[flow].value} for flow in self.of if flow != "mixtures"]

            def fit(self, which, *_, **__):
                return self.of[which]

            def range_over_mixtures(self, _):
                return ""

            def of_scan(self, _):
                return value(0.65)

        m = Mixtures()
        self.assertEqual(targets.sign_of_b(m).verdict(), verdicts.UNDECIDED)
        m.of["phi0.06-s23"] = value(0.03, 0.01, 0.05)
        self.assertEqual(targets.sign_of_b(m).verdict(), verdicts.AGREES)
        m.of["phi0.06-s23"] = value(-0.03, -0.05, -0.01)
        self.assertEqual(targets.sign_of_b(m).verdict(), verdicts.DIFFERS)

    def test_a_number_rounded_to_hundredths_is_as_uncertain_as_one_drawn_evenly_between_its_neighbours(self):
        # Variance of a uniform distribution of width w: w^2/12.
        self.assertAlmostEqual(statements.number("0.98", 0.98, 0.1, "", unit=0.01).error, 0.01 / math.sqrt(12), 12)

    def test_the_difference_is_in_standard_errors_of_both(self):
        statement = statements.number("1 ± 0.3", 1.0, 0.5, "", error=0.3)
        self.assertAlmostEqual(verdicts.difference(measured.Value(2.0, 1.0, 3.0, 0.4), statement), 2)

    def test_the_standard_error_of_four_seeds_is_half_of_their_interval_over_students_t_for_three_degrees(self):
        self.assertAlmostEqual(measured.of_student(1.0, 0.0, 2.0, 3).error, 1 / 3.1824463, 4)


class Tables(unittest.TestCase):
    def measured(self, fits, flows):
        with tempfile.TemporaryDirectory() as folder:
            numbers = [{"of": "mixtures", "name": "n", "value": 1.0, "low": 0.5, "high": 2.0, "error": 0.1, "runs": 4}]
            for name, rows in (("fits", fits), ("flows", flows), ("numbers", numbers), ("scan", [{"p": 0.5}]),
                               ("choices", [{"choice": "all times"}])):
                with open(os.path.join(folder, name + ".tsv"), "w") as table:
                    table.write(text_of(rows))
            return measured.Measured(folder)

    def test_a_mean_over_seeds_reaches_its_half_width_to_either_side(self):
        m = self.measured([{"set": "none"}], [{"flow": "phi0.30-s23", "rate": 0.5, "hw_rate": 0.125, "seeds": 4}])
        value = m.of_flow("phi0.30-s23", "rate")
        self.assertEqual((value.value, value.low, value.high), (0.5, 0.375, 0.625))

    def test_a_fit_is_that_of_all_times_by_size_of_yy_inside_unless_said_otherwise(self):
        usual = {"set": "mixtures", "rule": "size", "component": "yy", "heights": "inside", "stage": "all",
                 "quantity": "contact", "seeds": 4}
        others = ({"stage": "early"}, {"stage": "late"}, {"heights": "all"}, {"component": "pressure"}, {"rule": "half"},
                  {"rule": "kinetic", "quantity": "kinetic"}, {})
        fits = [{**usual, **other, "B": float(k), "B_low": k - 0.5, "B_high": k + 0.5, "degrees_of_freedom": 3.0}
                for k, other in enumerate(others)]
        m = self.measured(fits, [{"flow": "none"}])
        self.assertEqual(m.fit("mixtures").value, 6)
        self.assertEqual(m.fit("mixtures", stage="late").value, 1)
        self.assertEqual(m.fit("mixtures", quantity="kinetic").value, 5)


unittest.main()
