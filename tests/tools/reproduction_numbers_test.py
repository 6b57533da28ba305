#!/usr/bin/python3
"""Numbers of the reproduction study, from tables whose results are known in advance.

Usage: reproduction_numbers_test.py SCRIPTS
"""
import math
import os
import sys
import tempfile
import unittest

import numpy as np

scripts = sys.argv.pop(1)
sys.path.insert(0, os.path.join(scripts, "reproduce", "campaign"))
import keep  # noqa: E402
import measured  # noqa: E402
import measures as numbers  # noqa: E402
import profiles  # noqa: E402
import rise  # noqa: E402
import statements  # noqa: E402
import tables  # noqa: E402
import targets  # noqa: E402
import verdicts  # noqa: E402


COLUMNS = ["t0[s]", "t1[s]", "y0[m]", "y1[m]", "frames", "V[m^2]", "area_S[m^2]", "area_L[m^2]"] + [
    f"{part}_{c}[N m]" for part in profiles.CONTACTS for c in ("xx", "yy")]
G, SLOPE, D, LENGTH, NU, LAYERS = 9.8, math.radians(30), 0.01, 1.0, 0.8, 10


def at_rest(path, frames=(1, 1)):
    """A bed of ten layers of 1 d in two windows, whose contacts carry exactly the weight above; xx equals yy."""
    volume = LENGTH * D
    with open(path, "w") as table:
        table.write(f"# small_diameter: {D}\n# large_diameter: {2 * D}\n# gravity_x: {G * math.sin(SLOPE)}\n"
                    f"# gravity_y: {-G * math.cos(SLOPE)}\n# length: {LENGTH}\n# window: 1\n")
        table.write("\t".join(COLUMNS) + "\n")
        for window, n in enumerate(frames):
            for k in range(LAYERS):
                above = NU * G * math.cos(SLOPE) * (LAYERS - k - 0.5) * D
                sums = [above * volume, above * volume] + [0] * (2 * len(profiles.CONTACTS) - 2)
                row = [window, window + 1, k * D, (k + 1) * D, n, volume, NU * volume * 0.75,
                       NU * volume * 0.25, *sums]
                table.write("\t".join(f"{x:.17g}" for x in row) + "\n")


def contacts(y, phi, beyond=0.0, more_ends=1.0, t=0, frames=10):
    """A row of grseg-micro: neutral contacts of discs of 1 d and 2 d in a layer of 4 d, isotropic. Of the stress of mixed
    contacts the large grains get `beyond` more than 2/3. There are `more_ends` times as many SS contacts, with forces smaller
    by this factor."""
    r, area, number, force, pressure = 2, 100.0, 1000.0, 3.0, 1.0
    x = phi / (phi + r * (1 - phi))  # fraction of ends on large grains
    n = {"SS": (1 - x) ** 2 * number, "LS": 2 * x * (1 - x) * number, "LL": x ** 2 * number, "Sb": 0.0, "Lb": 0.0}
    whole = pressure * area
    m = (1 + r) * phi * (1 - phi) / (phi + r * (1 - phi)) * whole
    large = phi * whole - m * r / (1 + r)
    row = {"t0": t, "y0": y, "y1": y + 4 * D, "frames": frames, "area_S": area * (1 - phi), "area_L": area * phi, "grains_S": 99, "grains_L": 99}
    row.update({f"{name}_{c}": value for c in ("xx", "yy") for name, value in (
        ("A_LL", large), ("M", m), ("Msize", m * (r / (1 + r) + beyond)), ("A_SS", whole - large - m), ("A_Sb", 0.0), ("A_Lb", 0.0))})
    n["SS"] *= more_ends
    row.update({f"n_{pair}": value for pair, value in n.items()})
    row.update({f"sum_fn_{pair}": value * force / (more_ends if pair == "SS" else 1) for pair, value in n.items()})
    return row


def layers_of(path, rows):
    with open(path, "w") as table:
        table.write(f"# small_diameter: {D}\n# large_diameter: {2 * D}\n" + "\t".join(rows[0]) + "\n")
        for row in rows:
            table.write("\t".join(f"{x:.17g}" for x in row.values()) + "\n")
    return rise.layers_of(path)


class Reproduction(unittest.TestCase):
    def test_a_number_that_one_seed_lacks_is_none_of_the_flow(self):
        mean, half = tables.mean_and_half_width([1, 2, 3])
        self.assertAlmostEqual(mean, 2)
        self.assertAlmostEqual(half, 4.3026527 / math.sqrt(3), 3)
        self.assertTrue(all(math.isnan(x) for x in tables.mean_and_half_width([1, math.nan, 3])))

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.table = os.path.join(self.folder.name, "stress.tsv")

    def tearDown(self):
        self.folder.cleanup()

    def test_pressure_per_area_of_grains_is_that_of_the_column_above_and_falls_by_the_cosine(self):
        at_rest(self.table)
        profile = profiles.Profile([self.table])
        self.assertAlmostEqual(profile.height(), LAYERS * D, 12)
        for k, weight in enumerate(profile.weights()):
            column = {name: values[k] for name, (values, _) in profile.columns().items()}
            self.assertAlmostEqual(column["P_solid"], math.cos(SLOPE) * (LAYERS - k - 0.5), 9)
            self.assertAlmostEqual(column["P"], NU * column["P_solid"], 9)
            self.assertAlmostEqual(column["syy"] * profile.unit, weight, 9)
            self.assertAlmostEqual(column["phi_L"], 0.25, 12)

    def test_windows_outside_the_time_do_not_count(self):
        at_rest(self.table)
        profile = profiles.Profile([self.table], begin=1)
        self.assertEqual(profile.windows.tolist(), [1] * LAYERS)
        with self.assertRaises(ValueError):
            profiles.Profile([self.table], begin=1.5)

    def test_windows_taken_together_weight_by_frames_and_keep_the_sums(self):
        names = ["t0", "t1", "y0", "y1", "frames", "V", "sum"]
        rows = [[0, 1, 0, 1, 3, 7, 10], [0, 1, 1, 2, 3, 7, 4], [1, 2, 0, 1, 1, 7, 2]]
        # The upper layer is missing in the second window: it is empty in one frame of four.
        self.assertEqual(keep.coarse(rows, 2, names.index),
                         [[0, 2, 0, 1, 4, 7, 8], [0, 2, 1, 2, 4, 7, 3]])
        # Windows of another program are slightly shorter: 0.999 s each.
        short = [[0.999 * k, 0.999 * (k + 1), 0, 1, 1, 7, k] for k in range(4)]
        self.assertEqual([row[:2] for row in keep.coarse(short, 2, names.index)], [[0, 2 * 0.999], [2 * 0.999, 4 * 0.999]])
        # A composition is averaged over the frames that contain the layer.
        self.assertEqual(keep.coarse(rows, 2, names.index, of_present=[6]),
                         [[0, 2, 0, 1, 4, 7, 8], [0, 2, 1, 2, 4, 7, 4]])

    def test_a_straight_line_has_its_slope_and_level_and_no_error(self):
        slope, level = measured.line_fit([0, 1, 2, 3], [1, 3, 5, 7])
        self.assertEqual([slope.value, slope.low, slope.high, level.value], [2, 2, 2, 1])
        # Residuals 0.1, -0.2, 0.1: sum of squares over one degree of freedom, t = 12.706.
        slope, _ = measured.line_fit([-1, 0, 1], [0.1, -0.2, 0.1])
        self.assertAlmostEqual(slope.high, 12.706 * math.sqrt(0.06 / 2), 9)

    def test_a_statement_is_met_where_the_whole_interval_lies_in_its_range(self):
        value, about = measured.Value, statements.number("0.1", 0.1, 0.05, "")
        verdict = lambda *numbers: verdicts.verdict(value(*numbers), about)
        self.assertEqual(verdict(0.08, 0.06, 0.14), verdicts.AGREES)
        self.assertEqual(verdict(0.04, 0.03, 0.045), verdicts.DIFFERS)
        self.assertEqual(verdict(0.2, 0.16, 0.24), verdicts.DIFFERS)
        # If the interval crosses an edge, or both edges, the verdict is undecided, wherever the value is.
        self.assertEqual(verdict(0.1, 0.04, 0.12), verdicts.UNDECIDED)
        self.assertEqual(verdict(0.2, 0.14, 0.26), verdicts.UNDECIDED)
        self.assertEqual(verdict(0.04, 0.02, 0.06), verdicts.UNDECIDED)
        self.assertEqual(verdict(0.1, -0.2, 0.4), verdicts.UNDECIDED)
        # A value without an interval is not judged.
        self.assertEqual(verdict(0.1), verdicts.UNDECIDED)
        self.assertEqual(verdict(math.nan), "not measured yet")
        self.assertEqual(value(-0.0001, -0.02, 0.01).text(2), "0.00 [−0.02, 0.01]")

    def test_a_claim_is_met_by_its_edge_alone(self):
        value = measured.Value
        more_than_ten = statements.above("more than 10 times", 10, "")
        self.assertEqual(verdicts.verdict(value(1000, 11, 2000), more_than_ten), verdicts.AGREES)
        self.assertEqual(verdicts.verdict(value(10.5, 9, 12), more_than_ten), verdicts.UNDECIDED)
        self.assertEqual(verdicts.verdict(value(7.3, 7.1, 7.5), more_than_ten), verdicts.DIFFERS)
        self.assertEqual(verdicts.verdict(value(-5, -6, -4), statements.below("less than 9", 9, "")), verdicts.AGREES)

    def test_the_difference_is_in_standard_errors_of_both_sides(self):
        ours = measured.Value(3, -5, 11, 3)
        self.assertAlmostEqual(verdicts.difference(ours, statements.number("0 ± 4", 0, 1, "", error=4)), 0.6)
        # A number rounded to 0.1 has an error that is uniform between -0.05 and 0.05: 0.1/sqrt(12).
        rounded = statements.number("0.3", 0.3, 1, "", unit=0.1)
        self.assertAlmostEqual(verdicts.difference(measured.Value(0.3 + 0.1 / math.sqrt(12), 0, 1, 0), rounded), 1)
        # Differences count from the edge of a claim; for a range without a number there is nothing to count from.
        self.assertAlmostEqual(verdicts.difference(ours, statements.above("> 9", 9, "")), -2)
        self.assertTrue(math.isnan(verdicts.difference(ours, statements.Statement("", 0, 1, ""))))
        self.assertTrue(math.isnan(verdicts.difference(measured.Value(3), rounded.__class__("", 0, 1, "", 0))))

    def test_the_standard_error_of_four_runs_is_that_of_three_degrees_of_freedom(self):
        self.assertAlmostEqual(measured.of_student(1, 1 - 3.182, 1 + 3.182, 3).error, 1)
        self.assertAlmostEqual(measured.of_student(1, 1 - 12.706, 1 + 12.706, 1).error, 1)

    def test_several_points_are_judged_by_the_worst(self):
        value, about = measured.Value, statements.number("0", 0, 1, "")
        inside, nearer, crossing, outside, farther = (
            (value(x, x - 0.1, x + 0.1), about) for x in (0, 0.8, 1, -2, 3))
        self.assertIs(verdicts.worst([inside, nearer]), nearer)
        self.assertIs(verdicts.worst([nearer, crossing, inside]), crossing)
        self.assertIs(verdicts.worst([crossing, outside]), outside)
        self.assertIs(verdicts.worst([farther, outside]), farther)
        self.assertIs(verdicts.worst([inside, (value(0), about)])[0].has_interval(), False)
        self.assertIsNone(verdicts.worst([]))

    def test_forms_of_one_statement_count_once_and_by_the_worst(self):
        about = statements.number("", 0, 1, "")
        value = lambda x: measured.Value(x, x - 0.1, x + 0.1, 0.05)
        target = lambda x, one_of, *numbers: targets.Target("name", about, "", [(value(x), about)], "", one_of, numbers)
        inside, outside, uncounted, made = target(0, "a"), target(5, "a"), target(5, ""), target(5, "b", "slope")

        class Measured:
            likely = {"slope": 0.966 + 1.9 * 0.005, "slope error": 0.004}  # with the 0.003 of Staron & Phillips: 0.005
        found = list(targets.judged(Measured, lambda m: [inside, outside, uncounted, made]))
        self.assertEqual([one.verdict() for one in found], [verdicts.AGREES, verdicts.DIFFERS, verdicts.DIFFERS, verdicts.LIKELY])
        self.assertEqual(targets.independent(found), [verdicts.DIFFERS, verdicts.LIKELY])
        Measured.likely["slope"] = 0.966 - 2 * 0.005
        self.assertEqual([one.verdict() for one in targets.judged(Measured, lambda m: [inside, made])], [verdicts.AGREES, verdicts.DIFFERS])

    def test_the_paper_meets_its_own_statements_and_every_range_has_a_source(self):
        each = [x for x in vars(statements).values() if isinstance(x, statements.Statement)]
        each += [*statements.RULES.values(), *statements.RULES_LESS_SIZE.values(), statements.figure_4(0.5)]
        each += [x for pair in statements.FIGURE_5.values() for x in pair]
        self.assertGreater(len(each), 30)
        for statement in each:
            self.assertTrue(statement.source and statement.text)
            self.assertLess(statement.low, statement.high)
            if not math.isnan(statement.value):
                self.assertEqual(verdicts.verdict(measured.Value(*[statement.value] * 3), statement), verdicts.AGREES)

    def test_figure_4_is_judged_by_its_points_not_by_slope_and_level_of_a_fitted_line(self):
        # These points rise with the shear rate; slope and level of their line are near those of Staron & Phillips.
        rates, low = (0.3, 0.5, 0.7), (0.2765, 0.3125, 0.3535)

        class Flows:
            lift = 0

            def plain_flows(self):
                return [{"flow": k, "phi": 0.45, "slope": 21 + k, "rate": rate} for k, rate in enumerate(rates)]

            def fit(self, k, name, quantity):
                return measured.Value(*(-low[k] - self.lift + off for off in (0, -0.01, 0.01)), 0.005)

        target, rises = targets.shear_rate(Flows())
        self.assertEqual((target.verdict(), rises.verdict()), (verdicts.DIFFERS, verdicts.AGREES))
        # There the line has the values 0.3715, 0.4125, 0.4535.
        self.assertEqual(target.ours, "−0.100 [−0.110, −0.090] to −0.095 [−0.105, −0.085]")
        self.assertAlmostEqual(target.difference(), -0.1 / math.hypot(0.005, 0.001 / math.sqrt(12)), 3)
        Flows.lift = 0.09
        self.assertEqual(next(targets.shear_rate(Flows())).verdict(), verdicts.AGREES)
        Flows.lift = 0.065  # two points lie 0.035 below the line, with intervals of 0.01
        self.assertEqual(next(targets.shear_rate(Flows())).verdict(), verdicts.UNDECIDED)

    def test_neutral_contacts_have_no_B_and_what_large_grains_get_beyond_is_its_cause(self):
        mixed = [contacts(4 * k * D, phi) for k, phi in enumerate((0.3, 0.1, 0.4, 0.7))]
        # The lowest layer is not inside the range of heights.
        layers = layers_of(self.table, mixed)
        self.assertEqual([round(layer.phi, 9) for layer in layers], [0.1, 0.4, 0.7])
        found, terms = rise.factors(layers), rise.terms(layers)
        self.assertAlmostEqual(found["B"], 0, 12)
        self.assertAlmostEqual(found["mixed"], 1, 12)
        # For a single composition the geometry factor is 3/(1 + phi_S).
        self.assertAlmostEqual(rise.factors(layers[:1])["geometry"], 3 / 1.9, 12)
        for name in ("ends", "forces", "pairing", "normal", "log"):
            self.assertAlmostEqual(terms[name], 0, 12)
        self.assertAlmostEqual(terms["LS/neutral"], 1, 12)
        self.assertAlmostEqual(terms["LS/random"], 1, 12)
        # A share 0.02 above 2/3: B = 0.02 * 3/(1 + phi_S) at each composition.
        for phi in (0.1, 0.4, 0.7):
            found = rise.factors(layers_of(self.table, [contacts(4 * D, phi, 0.02)]))
            self.assertAlmostEqual(found["beyond"], 0.02, 12)
            # The share under size is 2/3, plus 0.02; with 2/3 B would be 0.
            self.assertAlmostEqual(found["p_star"], 2 / 3, 12)
            self.assertAlmostEqual(found["B"], 0.02 * 3 / (2 - phi), 12)

    def test_contacts_and_forces_take_apart_what_the_stress_says(self):
        # Twice as many SS contacts at half the force carry the same stress: s is 1, and the factors of ends and forces
        # cancel.
        phi = 0.5
        terms = rise.terms(layers_of(self.table, [contacts(4 * D, phi, more_ends=2)]))
        # Ends: SS 4/9, LS 4/9, LL 1/9 of the contacts; on small grains 2 * 8/9 + 4/9 instead of 2 * 4/9 + 4/9.
        self.assertAlmostEqual(terms["ends"], -math.log((16 + 4) / (8 + 4)), 12)
        self.assertAlmostEqual(terms["forces"] + terms["pairing"], math.log((16 + 4) / (8 + 4)), 12)
        # If paired at random, the 20 ends of small grains meet 6 ends of large ones: mean forces 3/2 and 3.
        at_random = (20 * 1.5 + 6 * 3) / (20 * 3 + 6 * 3)
        self.assertAlmostEqual(terms["forces"], -math.log(at_random), 12)
        self.assertAlmostEqual(terms["log"], 0, 12)
        self.assertAlmostEqual(terms["LS/random"], 4 / (13 * 2 * (20 / 26) * (6 / 26)), 12)
        # A layer of two large grains is left out of the logarithms.
        few = {**contacts(8 * D, phi), "grains_L": 2}
        self.assertAlmostEqual(rise.terms(layers_of(self.table, [contacts(4 * D, phi, more_ends=2), few]))["ends"], terms["ends"], 12)

    def test_windows_merge_by_frames(self):
        rows = [contacts(4 * k * D, 0.2 + 0.1 * k, t=t, frames=frames) for t, frames in ((0, 10), (2.5, 30)) for k in range(4)]
        for row in rows[:4]:  # the first 2.5 s have no large grain
            row.update({name: 0.0 for name in row if name in ("area_L", "grains_L") or "_LL" in name or "_LS" in name or name[0] == "M"})
        layers = layers_of(self.table, rows)
        for layer, phi in zip(layers, (0.3, 0.4)):
            small = 0.25 * (1 - phi) + 0.75 * (1 - phi)
            self.assertAlmostEqual(layer.phi, 0.75 * phi / (small + 0.75 * phi), 12)
            self.assertEqual((layer.frames, layer.grains), (40, 0.75 * 99))

    def test_a_trend_that_is_composition_is_none_of_the_mixture(self):
        bed = lambda t, phis, beyond: [contacts(4 * (k + 1) * D, phi, beyond(phi) / (3 / (2 - phi)), t=t) for k, phi in enumerate(phis)]
        runs = lambda beyond: [(whole, layers_of(self.table, bed(0, phis, lambda phi: beyond(whole, phi)) + bed(30, phis[::-1], lambda phi: beyond(whole, phi))))
                               for whole, phis in ((0.3, [0.15, 0.5, 0.3]), (0.5, [0.3, 0.7, 0.5]))]
        together = lambda mixtures: np.concatenate([layers for _, layers in mixtures]).view(np.recarray)
        local, whole = runs(lambda _, phi: 0.01 + 0.02 * phi), runs(lambda whole, _: 0.02 * whole)
        for mixtures, expected in ((local, {"phi": 0.02, "whole": 0}), (whole, {"phi": 0, "whole": 0.02})):
            found = rise.followed(mixtures, together(mixtures), "excess")
            for name, slope in ({"y": 0, "t": 0} | expected).items():
                self.assertAlmostEqual(found[name], slope, 12, name)
        self.assertAlmostEqual(rise.of_composition(together(local), "excess")[1], 0.01 + 0.02 * 0.15, 12)

    def test_what_gradients_inside_a_layer_add_is_no_part_of_b(self):
        """Straight profiles with B = 0: the mean of phi_L sigma in a layer of 4 d exceeds the product of means by 16/12 phi' sigma'."""
        rows = []
        for k in range(6):
            phi, pressure = 0.8 - 0.1 * k, 1.2 - 0.15 * k
            row = contacts(4 * k * D, phi)
            for name in [name for name in row if name.endswith(("_xx", "_yy"))]:
                row[name] *= pressure
            for c in ("xx", "yy"):  # given to contacts of large grains, taken from those of small ones
                row[f"A_LL_{c}"] += 100 * 0.1 * 0.15 / 12
                row[f"A_SS_{c}"] -= 100 * 0.1 * 0.15 / 12
            rows.append(row)
        layers = layers_of(self.table, rows)
        self.assertLess(abs(layers.excess).max(), 1e-14)
        self.assertGreater(layers.kept.min(), 1e-3)

    def test_separated_species_have_gone_all_the_way_and_mixed_ones_half_of_it(self):
        d, layers = 0.005, 10

        def bed(large_at):
            """Rise and mixing of a bed of ten layers; three tenths of its area are large grains."""
            with open(self.table, "w") as table:
                table.write("t1[s]\ty0[m]\tarea_S[m^2]\tarea_L[m^2]\tgrains_L\n")
                for t in (1, 2):  # in the first window large grains are in the lower layers
                    for k in range(layers):
                        large = large_at(k) if t == 2 else float(k < 3)
                        table.write(f"{t}\t{k * d}\t{1 - large}\t{large}\t{5 * large}\n")
                    table.write(f"{t}\tnan\t7\t3\t15\n")
            height = sum(large_at(k) * (k + 0.5) for k in range(layers)) / 3 / layers
            numbers.over_windows = lambda *_: [{"t1": 1, "yL/H": 0.15}, {"t1": 2, "yL/H": height}]

            class One:
                def path(self, _):
                    return bed_table

            part = numbers.Part([One()])
            return {**numbers.separation(None, part), **numbers.trapped(None, part)}

        bed_table = self.table
        for large_at, way, mixed in ((lambda k: float(k >= 7), 1, 0), (lambda k: 0.3, 0.5, 1),
                                     (lambda k: float(k < 3), 0, 0)):
            found = bed(large_at)
            self.assertAlmostEqual(found["way"], way, 9)
            self.assertAlmostEqual(found["mixed"], mixed, 9)
        self.assertEqual(found["lowest_large"], 5)


unittest.main()
