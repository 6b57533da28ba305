#!/usr/bin/python3
"""grseg.py on files whose numbers are known: the run that tests/three_grains.hpp writes, and neutral contacts, with
values computed by hand.
Usage: three_grains_test.py SOURCE
"""
import dataclasses
import math
import os
import sys

import numpy as np

sys.dont_write_bytecode = True
source = sys.argv[1]
sys.path.insert(0, os.path.join(source, "analysis", "python"))
import grseg

inputs = os.path.join(source, "tests", "inputs")


def is_near(value, expected):
    return np.allclose(value, expected, rtol=1e-14, atol=1e-20)


def the_head_says_what_was_written(run, version, finished):
    assert (run.version, run.finished, run.dimension, len(run)) == (version, finished, 2, 4)
    assert run.species == (("small", 0.005), ("large", 0.01))
    assert is_near(run.gravity, [3.8, -9]) and is_near(run.gravity_at(7), [3.8, -9])
    assert (run.length, run.width, run.periodic) == (0.35, None, (True, False))
    assert list(run.id) == [7, 8, 9] and list(run.kind) == [1, 0, 2] and list(run.mobile) == [True, True, False]
    assert is_near(run.mass, math.pi * run.radius**2)
    assert run.history == ["three grains by hand"] and run.digest == "0b611f173e81fd6a"
    assert run.observables == ["translational_energy"]
    assert is_near(run.observable("translational_energy"), [0, 0.5, 1, 1.5])
    assert is_near(run.times, (np.arange(4) * 500 + 0.5) * 1e-4)
    assert is_near([run.metres(text) for text in ("4dS", "2dL", "20mm", "2cm", "0.02m", 0.02)], 0.02)
    assert run.metres("0") == 0


def a_frame_holds_its_grains_and_contacts(run):
    frame = run[-2]
    assert (frame.number, frame.step, round(frame.time, 9)) == (2, 1000, 0.10005)
    assert is_near(frame.position, [[0.052, 0.005], [0.052, 0.0125], [0.052, -0.005]])
    assert is_near(frame.velocity, [[0.1, 0.2], [0.3, -0.4], [0, 0]])
    assert is_near(frame.angular_velocity, [1, -2, 0])
    assert is_near(frame.force, [[1e-6, 2e-6], [3e-6, 4e-6], [0, 0]])
    assert list(frame.image[0]) == [1, 0] and list(frame.present) == [True, True, False]
    contacts = frame.contacts
    assert len(contacts) == 2 and list(contacts.i) == [0, 0] and list(contacts.j) == [1, 2]
    assert list(contacts.kind_i) == [1, 1] and list(contacts.kind_j) == [0, 2]
    assert is_near(contacts.force, [[1e-4, -2e-4], [-3e-4, 1e-3]])
    assert is_near(contacts.share_i, [2 / 3, 1 / 2])  # shares 5 mm/7.5 mm and 5 mm/10 mm
    assert is_near(contacts.point, [[0.052, 0.010], [0.052, 0.0]])


def frames_begin_at_a_time_and_end_before_one(run):
    assert [f.number for f in run.frames()] == [0, 1, 2, 3]
    assert [f.number for f in run.frames(begin=0.05, end=0.15)] == [1, 2]
    assert [f.number for f in run.frames(stride=3)] == [0, 3]
    assert [f.position[0, 0] for f in run.frames()] == [f.position[0, 0] for f in (run[k] for k in range(4))]
    assert [list(w.frames) for w in run.windows(0.1)] == [[0, 1], [2, 3]]
    assert [list(w.frames) for w in run.windows(0.15)] == [[0, 1, 2]]  # the second window is incomplete


def sums_are_force_times_branch(run):
    sums = run.contact_sums(window=0.1, power=2)
    assert len(sums) == 2 and is_near(sums["t1"], [0.1, 0.2]) and is_near(sums["V"], 0.02 * 0.35)
    assert is_near(sums["area_L"], math.pi * 0.005**2) and is_near(sums["area_S"], math.pi * 0.0025**2)
    assert list(sums["n_LS"]) == [1, 1] and list(sums["n_Lb"]) == [1, 1] and not sums["n_SS"].any()
    mixed = [[0, -0.75e-6], [0, 1.5e-6]]
    base = [[0, -3e-6], [0, 1e-5]]
    assert is_near(sums.tensor("M"), [mixed, mixed]) and not sums.tensor("A_LL").any()
    for stem, share in (("Msize", 2 / 3), ("Mcp", 2 / 3), ("Mpower", 4 / 5)):
        assert is_near(sums.tensor(stem)[0], share * np.array(mixed)), stem
    assert is_near(sums.tensor("F_Lb")[1], base) and is_near(sums.tensor("A_Lb")[1], np.array(base) / 2)


def rules_share_the_mixed_contact(run):
    sums = run.contact_sums(window=0.2, power=2)
    volume, large_at_base = 0.02 * 0.35, 1e-5 / 2
    for rule, share in (("size", 2 / 3), ("contact-point", 2 / 3), ("half", 1 / 2), ("uniform:0.9", 0.9),
                        ("power:2", 4 / 5)):
        of_species, total = grseg.partial_stress(sums, rule)
        yy = of_species[0, :, 1, 1] * volume
        assert is_near(yy, [(1 - share) * 1.5e-6, share * 1.5e-6 + large_at_base]), rule
        assert is_near(of_species.sum(axis=1), total), rule
    of_species, total = grseg.partial_stress(sums, "drop", base="none")
    assert not of_species.any() and is_near(total[0, 1, 1] * volume, 1.5e-6)


def a_rule_of_ones_own_sees_the_contact_from_the_larger_grain(run):
    """Radii 5 and 2.5 mm; force (0.1, -0.2) mN on the large grain, branch (0, -7.5) mm to it."""
    seen = {}

    def own(r_large, r_small, d_large, d_small, gap, force, branch, times=1e5):
        seen.update(locals())
        return times * (force * branch).sum(axis=1)
    sums = run.contact_sums(window=0.2, rule=own)
    expected = {"r_large": [0.005], "r_small": [0.0025], "d_large": [0.01], "d_small": [0.005], "gap": [0], "force": [[1e-4, -2e-4]],
                "branch": [[0, -0.0075]]}
    for name, values in expected.items():  # the same contact in each of four frames
        assert is_near(seen[name], np.repeat(values, 4, axis=0)), name
    yy = grseg.partial_stress(sums, own)[0][0, :, 1, 1] * 0.02 * 0.35
    assert is_near(yy, [0.85 * 1.5e-6, 0.15 * 1.5e-6 + 1e-5 / 2])


def a_table_takes_rules_of_nominal_diameters(run):
    sums = run.contact_sums(window=0.2)
    for rule, share in ((lambda d_large, d_small: d_large**2 / (d_large**2 + d_small**2), 4 / 5), (lambda: -0.25, -0.25)):
        yy = grseg.partial_stress(sums, rule)[0][0, :, 1, 1] * 0.02 * 0.35
        assert is_near(yy, [(1 - share) * 1.5e-6, share * 1.5e-6 + 1e-5 / 2]), share


def fluctuations_are_about_the_mean_of_the_layer(run):
    """m = pi r^2: the large grain's velocity differs from the mean by 1/5 of the difference, the small grain's by 4/5."""
    kinetic = run.kinetic_sums(window=0.1, mean="layer")
    m_large, m_small, difference = math.pi * 25e-6, math.pi * 6.25e-6, np.array([0.2, -0.6])
    square = np.outer(difference, difference)
    assert is_near(kinetic.tensor("K_L")[0], m_large * square / 25)
    assert is_near(kinetic.tensor("K_S")[0], m_small * square * 16 / 25)
    assert is_near(kinetic["Kr_L"], m_large * 0.005**2 / 2 * 0.6**2)  # from spins 1 and -2
    assert is_near(kinetic["u"], 0.1 + 0.2 / 5) and is_near(kinetic["du_dy"], 0.2 / 0.0075)
    # Relative to a line through two grains nothing is left.
    assert abs(run.kinetic_sums(window=0.1).tensor("K_S")).max() < 1e-30


def a_table_becomes_a_data_frame(run):
    sums = run.contact_sums(layer="10mm", window=0.1)
    frame = sums.to_pandas()
    assert list(frame.columns) == sums.columns and len(frame) == len(sums) > 0
    assert (frame.A_LL_yy.to_numpy() == sums["A_LL_yy"]).all() and frame.t1.min() == sums["t1"].min()
    assert frame.attrs["input"] == f"xxh3 {run.digest}" and frame.attrs["history"] == sums.history
    assert frame.attrs["units"]["A_LL_yy"] == "N m" and frame.attrs["layer"] == sums.header["layer"]
    frame["t0"] += 1
    assert sums["t0"].min() < 1  # the original table is unchanged


def neutral_contacts_have_no_b_by_size():
    points = grseg.Points(grseg.read_table(os.path.join(inputs, "neutral-sums.tsv")), heights="all")
    assert is_near(points.x, [2, 1, 1 / 2])
    assert abs(points.fit("size").B) < 1e-15 and abs(points.fit("size").paper_B) < 1e-15
    # sigma^S : sigma^L = 16 + 12 (1 - p) : 2 + 12 p, 10 + 15 (1 - p) : 5 + 15 p, 5 + 15 (1 - p) : 10 + 15 p
    phi = np.array([1, 1.5, 2]) / 3
    for p in (0.5, 0.8):
        q = 1 - p
        logs = [math.log((16 + 12 * q) / (2 + 12 * p) / 2), math.log((10 + 15 * q) / (5 + 15 * p)),
                math.log((5 + 15 * q) / (10 + 15 * p) * 2)]
        # Large grains have 2, 3 and 4 quarters, small ones 4, 3 and 2: the weights of the rarer species are 2, 3 and 4.
        s = math.exp(np.average(logs, weights=[2, 3, 4]))
        fit = points.fit(f"uniform:{p}")
        assert is_near([fit.paper_s, fit.paper_B, fit.share], [s, (1 - s + (1 - s) / s) / 2, p])
        of_large = np.array([2 + 12 * p, 5 + 15 * p, 10 + 15 * p]) / 30
        assert is_near(fit.B, (of_large - phi).sum() / (phi * (1 - phi)).sum())
        assert is_near(points.b_of_p([p]), fit.B)
        own = grseg.fit(points.tables[0], lambda d_large: p, heights="all")
        assert own.B == fit.B and own.paper_s == fit.paper_s and own.rule == "<lambda>"
    # Of the total stress, 30, mixed contacts carry 12, 15 and 15.
    slope = (12 + 15 + 15) / 30 / (phi * (1 - phi)).sum()
    fit = points.fit()
    assert np.allclose([fit.p_zero, fit.dB_dp], [2 / 3, slope], rtol=1e-14) and fit.doubt == ""
    doubt_of = lambda *interval: dataclasses.replace(fit, p_zero_interval=interval).doubt
    assert doubt_of(0.01, 0.99) == "" and doubt_of(-2.9, 3.8).startswith("the interval of p*, [-2.9, 3.8], reaches beyond 0 to 1")
    assert doubt_of(1.1, 1.3).startswith("p* = 0.667 lies outside 0 to 1") and doubt_of(-0.1, 0.5) and doubt_of(0.5, 1.1)


with grseg.Run(os.path.join(inputs, "three-grains-closed.h5")) as closed, \
        grseg.Run(os.path.join(inputs, "three-grains-1.0.h5"), unfinished=True) as open_one:
    the_head_says_what_was_written(closed, "1.0", True)
    the_head_says_what_was_written(open_one, "1.0", False)
    for one in (closed, open_one):
        a_frame_holds_its_grains_and_contacts(one)
        frames_begin_at_a_time_and_end_before_one(one)
        sums_are_force_times_branch(one)
        rules_share_the_mixed_contact(one)
        a_rule_of_ones_own_sees_the_contact_from_the_larger_grain(one)
        a_table_takes_rules_of_nominal_diameters(one)
        fluctuations_are_about_the_mean_of_the_layer(one)
        a_table_becomes_a_data_frame(one)
neutral_contacts_have_no_b_by_size()
