"""The paper's statements one by one: what it says, what was measured, how far the two may differ.

A tolerance is the range that the paper's own ambiguities leave open (definitions, estimators, contacts at
the base), not an error of measurement. A target is met where the 95 % interval overlaps the paper's
value +- tolerance; a line is met where every measured point is.
"""
import math

from measured import Value, line_fit, plain

NOT_YET = "not measured yet"
DIFFERS = "**differs**"
FROM_BEST_TO_WORST = ("agrees", "undecided", DIFFERS, NOT_YET)
B_KAPPA_TOLERANCE = 0.04


class Target:
    def __init__(self, name, paper, ours, verdict, why):
        self.name, self.paper, self.ours, self.verdict, self.why = name, paper, ours, verdict, why

    def cells(self):
        if self.verdict == NOT_YET:
            return [self.name, self.paper, "–", NOT_YET, "its flows have not been run"]
        return [self.name, self.paper, self.ours, self.verdict, self.why]


def judged(value, paper, tolerance):
    met = value.meets(paper - tolerance, paper + tolerance)
    if met is None:
        return NOT_YET
    if met and value.high - value.low > 2 * tolerance:
        return "undecided"  # the interval is wider than the tolerance
    return "agrees" if met else DIFFERS


def worst(verdicts):
    return max(verdicts, key=FROM_BEST_TO_WORST.index, default=NOT_YET)


def judged_line(points, line, tolerance):
    """Verdict on (x, value) pairs against line(x): that of the worst point."""
    return worst(judged(value, line(x), tolerance) for x, value in points)


def distance_from_line(points, line, tolerance):
    """How far the points lie off the line, in words: in its units and in tolerances."""
    off = [value.value - line(x) for x, value in points]
    if not off:
        return "none"
    if min(off) <= 0 <= max(off):
        return f"from {plain(min(off), 3)} to {plain(max(off), 3)} off that line"
    sizes = sorted(map(abs, off))
    return (f"{'below' if max(off) < 0 else 'above'} that line by {plain(sizes[0], 3)} to {plain(sizes[-1], 3)}, "
            f"{plain(sizes[0] / tolerance, 1)} to {plain(sizes[-1] / tolerance, 1)} tolerances")


def number(name, text, value, digits, paper, tolerance, why):
    """A target that is one number."""
    return Target(name, f"{text} (± {tolerance:g})", value.text(digits),
                  judged(value, paper, tolerance), why)


def claim(name, text, ours, holds, why, otherwise=DIFFERS):
    """A target that is a statement; `holds` may be None where nothing was measured."""
    verdict = NOT_YET if holds is None else "agrees" if holds else otherwise
    return Target(name, text, ours, verdict, why)


def contact_stress(m):
    """Figures 1 and 2 and section III."""
    yield segregated(m)
    b = m.fit("mixtures")
    every = m.fit("mixtures", heights="all")
    pressure = m.fit("mixtures", component="pressure")
    slope = m.number("phi0.30-s23", "P_solid_slope")
    yield number("2a: P(z) falls by ρ g cosθ per unit of height", "0.9205 ρ g", slope, 3, 0.9205, 0.046,
                 "per area of grains; per bulk volume it is ν times that, "
                 f"{m.number('phi0.30-s23', 'P_slope').text(3)}. σ_yy + σ^κ_yy is "
                 f"{m.number('phi0.30-s23', 'weight').text(3)} of the weight above")
    yield number("2b: slope of σ^S/σ^L over φ_S/φ_L", "0.9660 ± 0.003", m.fit("mixtures", "s"), 3, 0.966,
                 0.035, f"with the lowest layer and the surface {m.fit('mixtures', 's', heights='all').text(3)}")
    yield number("2b: B by size", "0.034 to 0.035", b, 3, 0.0345, 0.03,
                 f"pooled over the six mixtures; {m.range_over_mixtures(3)} by mixture; all heights {every.text(3)}, "
                 "with the row of large grains that the base traps; "
                 f"nominal 2/3 instead of actual radii {m.fit('mixtures', rule='uniform:0.66667').text(3)}")
    yield sign_of_b(m)
    yield number("Control, all grains alike: B", "0 by symmetry", m.fit("control"), 3, 0, 0.03,
                 "size ratio 1, small and large labels assigned at random")
    most = m.number("mixtures", "mixed_most")
    yield number("2c: largest share of mixed contacts", "\"locally 50 %\"", most, 3, 0.5, 0.04,
                 "neutral contacts: 0.500")
    yield number("2c: φ_L where it is largest", "neutral contacts: 2/3", m.number("mixtures", "mixed_most_at"), 2, 0.635,
                 0.085, "the text gives no number; 0.55 to 0.72 counts as met")
    yield neutral_curve(m)
    yield number("B from pressures", "0.045 to 0.047", pressure, 3, 0.046, 0.03, "half the trace instead of σ_yy")
    yield number("B from pressures minus B from σ_yy", "0.011", Value(pressure.value - b.value), 3, 0.011, 0.015,
                 "normal stresses differ")
    for rule, paper, text in (("uniform:0.8", 0.33, "≈ 0.33"), ("uniform:0.6", -0.1, "≈ −0.1"),
                              ("half", -0.32, "≈ −0.32")):
        p = {"half": 0.5}.get(rule) or float(rule.split(":")[1])
        row = m.row("mixtures", rule=rule) or {}
        less = Value(*(row.get(f"minus_size{end}", math.nan) for end in ("", "_low", "_high")))
        yield number(f"B, mixed contacts {p:g} to the large grain", text,
                     m.fit("mixtures", rule=rule), 3, paper, 0.05, "at φ = 1/2")
        yield number("... minus B by size", plain(paper - 0.0345, 3), less, 3, paper - 0.0345, 0.05,
                     f"direct fit; neutral contacts: {plain(row.get('neutral', math.nan), 3)}")
    yield slope_and_b(m)
    yield stages(m)


def neutral_curve(m):
    least, most = (m.number("mixtures", f"mixed_off_{end}") for end in ("least", "most"))
    holds = None if math.isnan(least.value) else max(-least.value, most.value) <= 0.04
    return claim("2c: share of mixed contacts over φ_L", "a curve; neutral contacts: 4 φ_L φ_S/(1 + φ_S)² (± 0.04)",
                 f"{least.text(3)} to {most.text(3)} off that curve", holds, "compositions inside, without contacts with the base")


def segregated(m):
    """Figure 1: y_L/H goes from Phi_L/2 to 1 - Phi_L/2 if the species separate."""
    start, end = (m.of_flow("phi0.30-s23", name) for name in ("yL0", "yL1"))
    way = (end.value - 0.15) / (0.85 - 0.15)
    holds = None if math.isnan(way) else way > 0.8
    return claim("1: large grains end on top, with a thin mixed zone", "snapshots at 0 and 150 s",
                 f"y_L/H from {start.text(3)} to {end.text(3)}", holds,
                 f"{plain(100 * way, 0)} % of the way from 0.15 to 0.85, the value of fully separated species; "
                 "80 % counts as met. The first row stays at the base")


def sign_of_b(m):
    """B > 0 asks for four seeds of each mixture, whose intervals all lie above 0."""
    flows = m.mixtures()
    seeds = min((row["seeds"] for row in flows), default=0)
    least = min((row["B_low"] for row in flows), default=math.nan)
    holds = None if math.isnan(least) else least > 0 and seeds >= 4
    return claim("2b: B > 0", "\"supports the plausibility of gravity-driven segregation\"",
                 f"{m.range_over_mixtures(3)} by mixture, lowest end of an interval {plain(least, 3)}", holds,
                 f"{seeds:.0f} seeds per mixture; four are required. The rule for mixed contacts matters more: "
                 f"B = 0 at p = {m.of_scan('p_zero').text(3)}", "undecided")


def slope_and_b(m):
    flows = [row for row in m.plain_flows() if row["phi"] == 0.45 and not math.isnan(row["B"])]
    trend, _ = line_fit([row["slope"] for row in flows], [row["B"] for row in flows])
    mean = sum(row["B"] for row in flows) / max(1, len(flows))
    off = max((abs(row["B"] - mean) for row in flows), default=math.nan)
    holds = None if len(flows) < 3 else trend.meets(0, 0) and off < 0.02
    return claim("B does not depend on the slope", "none seen",
                 f"dB/dθ = {trend.text(4)} per degree over {len(flows)} slopes", holds,
                 f"the slope farthest from the mean differs from it by {plain(off, 3)}; up to 0.02 counts as met")


def stages(m):
    early, late = m.fit("mixtures", stage="early"), m.fit("mixtures", stage="late")
    holds = early.meets(late.low, late.high) if late.has_interval() else None
    return claim("Early and late stages give the same B", "no visible influence",
                 f"t < 60 s {early.text(3)}, t > 100 s {late.text(3)}", holds,
                 "see the figure of B by flow; later stages have other compositions at other heights")


def kinetic_stress(m):
    """Figures 3 and 4 and section IV."""
    at = lambda name: m.number("phi0.30-s23", name)
    about_layer = (f"about the mean of the layer {at('K_layer_solid_prefactor').text(2)} and "
                   f"{at('K_layer_solid_decay').text(1)} d_L, because the shear inside the layer adds "
                   f"{at('shear_share').text(2)} of P^κ")
    yield number("3a: P^κ at the base, over ρ g d_S", "0.98", at("K_solid_prefactor"), 2, 0.98, 0.49,
                 "about the profile of the mean velocity, per area of grains, 4 to 56 d_S; per bulk volume "
                 f"{at('K_prefactor').text(2)} (V is an open question, see below); " + about_layer)
    yield number("3a: decay length of P^κ, d_L", "14.8", at("K_solid_decay"), 1, 14.8, 5,
                 "an exponential is only a convenient fit: see the figure")
    kinetic = {"quantity": "kinetic"}
    yield number("3b: prefactor of σ^κS/σ^κL", "1.4413 ± 0.0022",
                 m.fit("mixtures", "prefactor_power", **kinetic), 3, 1.4413, 0.1,
                 f"logarithmic fit of exponent one {m.fit('mixtures', 's', **kinetic).text(3)}; "
                 f"with all heights {m.fit('mixtures', 's', heights='all', **kinetic).text(3)}")
    yield number("3b: its exponent", "1.0057", m.fit("mixtures", "exponent", **kinetic), 3, 1.0057, 0.02,
                 "a power law, as in the paper")
    half_sum = m.fit("mixtures", "B_paper", **kinetic)
    yield number("B_κ", "−0.373", half_sum, 3, -0.373, B_KAPPA_TOLERANCE,
                 "half the sum of the end values, which the paper compares with −0.39 (Hill & Tan) and −0.38 "
                 "(Weinhart et al.); at φ = 1/2 "
                 f"{m.fit('mixtures', **kinetic).text(3)}; all heights, with the row that the base traps, "
                 f"{m.fit('mixtures', 'B_paper', heights='all', **kinetic).text(3)}. For e and the mean "
                 "velocity see the choices below")
    ratio = -m.fit("mixtures", **kinetic).value / m.fit("mixtures").value
    yield number("|B_κ| over B".replace("|", "\\|"), "\"more than 10 times\", 10.8", Value(ratio), 1, 10.8, 5,
                 "both at φ = 1/2")
    least, most = at("Kyy/syy_least"), at("Kyy/syy_most")
    yield Target("Kinetic stress is \"about four orders of magnitude\" below contact stress", "1e-4",
                 f"least {least.text(4)}, largest {most.text(4)}, 4 to 56 d_S",
                 "paper inconsistent", "the paper's own figure 3a gives 0.98/55 = 0.018")
    yield from shear_rate(m)


def shear_rate(m):
    """Figure 4, the line 0.310 + 0.205 x: each slope's B_kappa against it, with the tolerance of B_kappa."""
    flows = [row for row in m.plain_flows()
             if row["phi"] == 0.45 and not math.isnan(row["K"] + row["rate"])]
    flows.sort(key=lambda row: row["rate"])
    line = lambda rate: 0.310 + 0.205 * rate
    points = [(row["rate"], -Value(row["K"], row["K_low"], row["K_high"])) for row in flows]
    rates, values = [rate for rate, _ in points], [value.value for _, value in points]
    slope, level = line_fit(rates, values)
    falls = sum(b < a for a, b in zip(values, values[1:]))
    yield Target("4: −B_κ over x = γ̇/√(g/d_S), six slopes", f"0.310 + 0.205 x (± {B_KAPPA_TOLERANCE:g})",
                 distance_from_line(points, line, B_KAPPA_TOLERANCE),
                 judged_line(points, line, B_KAPPA_TOLERANCE) if len(points) > 2 else NOT_YET,
                 "here (paper's line): "
                 + ", ".join(f"{plain(value, 3)} ({plain(line(row['rate']), 3)}) at {row['slope']:g}°, "
                             f"x = {plain(row['rate'], 2)}" if row is flows[0] or row is flows[-1] else
                             f"{plain(value, 3)} ({plain(line(row['rate']), 3)}) at {row['slope']:g}°"
                             for row, value in zip(flows, values))
                 + f"; fitted line {level.text(3)} + {slope.text(3)} x. In order of x −B_κ "
                 + ("grows from each slope to the next, as in the paper" if falls == 0
                    else f"falls {falls} times"))


def micro_structure(m):
    """Figures 5 and 6 and section V."""
    at = lambda name: m.number("mixtures", name)
    for name, end, mean, most in (("Π", "", 2.2, 3), ("Π^L", "_L", 1.9, 5), ("Π^S", "_S", 6.4, 9)):
        ours, largest = (at(f"contacts_error{end}_{which}") for which in ("mean", "most"))
        yield Target(f"5: mean (largest) error of {name}, %", f"{mean:g} ({most:g}) (up to twice that)",
                     f"{ours.text(1)} ({largest.text(1)})",
                     worst((judged(ours, mean, mean), judged(largest, most, most))),
                     f"with 1/(πd); as printed, 2/(πd): {at(f'contacts_error{end}_printed_mean').text(0)}; "
                     f"over ends and with f_n {at(f'ends_error{end}_mean').text(2)}")
    first = lambda name: m.number("phi0.45-s23", name)
    yield number("6a: y_L/H at the start", "large grains below: 0.225", first("yL_first"), 3, 0.225, 0.02,
                 "geometry")
    yield number("6a: y_L/H at the end", "no number in the text; 0.775 if separated, hence 0.705", first("yL_last"), 3,
                 0.705, 0.055, f"decreases from one window to the next {first('yL_falls').text(0)} times in "
                 f"{first('windows').text(0)}")
    yield from orderings(first)


def orderings(first):
    z, f = first("z_least"), first("f_least")
    none = lambda value, holds: None if math.isnan(value.value) else holds
    yield claim("6b: z_L > z_S, most so when most mixed", "always",
                f"z_L/z_S {first('z_first').text(2)} at the start, at most {first('z_most').text(2)}, "
                f"{first('z_last').text(2)} at the end", none(z, z.value > 1),
                f"largest at {first('z_most_at').text(0)} s; neutral contacts: up to 2")
    last, neutral = first("f_last"), first("neutral_last")
    yield claim("6c: f_L > f_S", "always, also \"as segregation proceeds\"",
                f"f_L/f_S {first('f_first').text(2)} at the start, at least {f.text(2)}, {last.text(2)} at the end",
                none(f, f.value > 1),
                f"forces that ignore grain size would give {neutral.text(2)} at the end, and 1 at y_L/H = 0.677; the measured "
                f"ratio over that one is {first('f_over_neutral').text(2)} on average, below 1 in {first('f_below_neutral').text(0)} of "
                f"{first('windows').text(0)} windows")
    hat = first("hat_last")
    yield claim("6c, inset: f over the pressure at its depth is larger for large grains", "significantly",
                f"ratio {first('hat_first').text(2)} at the start, at least {first('hat_least').text(2)}, "
                f"{hat.text(2)} at the end", none(hat, first("hat_least").value > 1),
                "neutral contacts: r z_S/z_L, because f ∝ d/z at a given pressure")


SECTIONS = (("Contact stress (section III)", contact_stress),
            ("Kinetic stress (section IV)", kinetic_stress),
            ("Micro-structure (section V)", micro_structure))
