"""The paper's statements one by one, each with our measured number and the verdict.

Statements and their ranges are in statements.py, and the rule for verdicts in verdicts.py. This file says which number is
compared with which statement.
"""
import math

import combined
import statements as paper
import tables
import verdicts
from measured import Value, line_fit, plain


class Target:
    """A statement, our number as text, and the pairs (value, statement) whose worst verdict counts.

    `one_of`: name of the independent statement of the paper of which this is one form; "" if the paper has neither a number nor
    a claim. `numbers`: names in combined.TARGETS of the numbers in the statement."""

    def __init__(self, name, statement, ours, points, why, one_of=None, numbers=()):
        self.name, self.statement, self.ours, self.points, self.why = name, statement, ours, points, why
        self.one_of, self.numbers = name if one_of is None else one_of, numbers
        self.point = verdicts.worst(points)
        self.by_likely_choices = False

    def verdict(self):
        found = verdicts.verdict(*self.point) if self.point else verdicts.NOT_YET
        return verdicts.LIKELY if self.by_likely_choices and found != verdicts.AGREES else found

    def difference(self):
        return verdicts.difference(*self.point) if self.point else math.nan

    def cells(self):
        met = allowed(self.point[1] if self.point and len(self.points) == 1 else self.statement)
        if self.verdict() == verdicts.NOT_YET:
            return [self.name, self.statement.text, met, "–", verdicts.NOT_YET]
        pull = signed(self.difference())
        return [self.name, self.statement.text, met, "<br>".join(filter(None, (self.ours, self.why))), self.verdict() + (f" ({pull})" if pull != "–" else "")]


def allowed(statement):
    """The range of the statement as text, with as many digits as needed."""
    return statement.range_text(lambda x: f"{x:.2g}" if 0 < abs(x) < 0.001 else f"{x:.4g}".replace("-", "−"))


def signed(number):
    """Text of a difference in standard errors, with its sign."""
    if math.isnan(number):
        return "–"
    text = f"{number:+.1f}" if abs(number) < 10 else f"{number:+.0f}"
    return text.replace("-", "−")


def number(name, statement, value, digits, why, one_of=None, numbers=()):
    """The Target for one number."""
    return Target(name, statement, value.text(digits), [(value, statement)], why, one_of, numbers)


def judged(m, section):
    """Yields the targets of a section. Sets by_likely_choices if the choices that meet most of the paper's numbers meet the target."""
    for target in section(m):
        target.by_likely_choices = bool(target.numbers) and m.likely is not None and all(combined.meets(m.likely, name) for name in target.numbers)
        yield target


def independent(targets):
    """The verdict on each independent statement: the worst over its judged forms."""
    of = {}
    for target in targets:
        if target.one_of:
            of.setdefault(target.one_of, []).append(target.verdict())
    return [max(found, key=verdicts.FROM_BEST_TO_WORST.index) for found in of.values()]


def contact_stress(m):
    """Targets of figures 1 and 2 and of section III."""
    yield from separated(m)
    yield from pressure_profile(m)
    b = m.fit("mixtures", "paper_B")
    yield number("2b: slope of σ^S/σ^L over φ_S/φ_L", paper.SLOPE, m.fit("mixtures", "paper_s"), 3,
                 f"all heights {m.fit('mixtures', 'paper_s', heights='all').text(3)}", "2b", ("slope",))
    yield number("2b: B by size", paper.B, b, 3,
                 f"ratio of sums {m.fit('mixtures').text(3)}, by mixture {m.range_over_mixtures(3)}; "
                 f"all heights {m.fit('mixtures', 'paper_B', heights='all').text(3)}; nominal 2/3 "
                 f"{m.fit('mixtures', 'paper_B', rule='uniform:0.66667').text(3)}", "2b", ("slope",))
    yield sign_of_b(m)
    yield number("Control, all grains alike: B", paper.CONTROL, m.fit("control"), 3,
                 "two runs; [eight of 60 s meet it](open-questions.md#the-control-equal-grains)")
    yield from mixed_contacts(m)
    yield number("B from pressures", paper.B_PRESSURE, m.fit("mixtures", "paper_B", component="pressure"), 3, "", "pressure", ("pressure",))
    yield number("... minus B from σ_yy", paper.PRESSURE_LESS_YY, m.number("mixtures", "pressure_less_yy"), 3,
                 "", "pressure", ("pressure", "slope"))
    yield from other_rules(m)
    yield slopes(m)
    yield from stages(m)


def with_and_without_a_row(m, flow):
    """True if the base traps a row of large grains in some runs only; then an interval over runs has no meaning. A whole row
    has 35 grains; runs without a row have up to 4 in the lowest layer."""
    trapped = m.number(flow, "lowest_large")
    return trapped.has_interval() and trapped.value > 5 and trapped.high > 1.5 * trapped.value


def separated(m):
    """Targets of figure 1: from large grains below to large grains above."""
    def of_flow(flow, name):
        value = m.number(flow, name)
        return Value(value.value) if name != "mixed" and with_and_without_a_row(m, flow) else value
    at = lambda name: of_flow("phi0.30-s23", name)
    others = [flow for flow in m.flows_with("way") if flow != "phi0.30-s23"]
    others = "".join(f"; {flow}: {of_flow(flow, 'way').text(2)}" for flow in others)
    yield number("1: way of y_L/H from 0.15 (large below) to 0.85 (above)", paper.FIGURE_1_END, at("way"), 2,
                 f"{at('lowest_large').text(0)} large grains stay in the lowest layer, 35 or none in a run{others}", one_of="")
    yield number("1: mean of φ_L φ_S over its value in a mixed bed", paper.FIGURE_1_MIXED, at("mixed"), 2,
                 "mixed 1, separated 0; the edge is our reading", one_of="")


def pressure_profile(m):
    """Targets of figure 2a, for both interpretations of the volume V."""
    at = lambda name: m.number("phi0.30-s23", name)
    yield number("2a: P(z) falls by, over ρ g, per area of grains", paper.FIGURE_2A, at("P_solid_slope"), 3,
                 f"σ_yy + σ^κ_yy is {at('weight').text(3)} of the weight above", one_of="2a")
    yield number("2a: the same per area with voids", paper.FIGURE_2A, at("P_slope"), 3, f"smaller by ν = {at('nu').text(3)}", one_of="")


def sign_of_b(m):
    """The target of B > 0 in every mixture."""
    points = [(m.fit(row["flow"]), paper.SIGN) for row in m.mixtures()]
    least = min((value.low for value, _ in points), default=math.nan)
    return Target("2b: B > 0", paper.SIGN, f"{m.range_over_mixtures(3)} by mixture, lowest end of an interval {plain(least, 3)}", points,
                  f"B = 0 at p* = {m.of_scan('p_zero').text(3)}", "2b")


def mixed_contacts(m):
    """Targets of figure 2c."""
    at = lambda name: m.number("mixtures", name)
    yield number("2c: largest share of mixed contacts", paper.MIXED_MOST, at("mixed_most"), 3, "neutral 0.500")
    yield number("2c: φ_L where it is largest", paper.MIXED_MOST_AT, at("mixed_most_at"), 2, "", one_of="")
    least, most = at("mixed_off_least"), at("mixed_off_most")
    yield Target("2c: share of mixed contacts minus the neutral share", paper.MIXED_CURVE,
                 f"{least.text(3)} to {most.text(3)}", [(least, paper.MIXED_CURVE), (most, paper.MIXED_CURVE)],
                 "by composition, base excluded", one_of="")


def other_rules(m):
    for rule, statement in paper.RULES.items():
        p = 0.5 if rule == "half" else float(rule.split(":")[1])
        row = m.row("mixtures", rule=rule) or {}
        yield number(f"B, p = {p:g}", statement, m.fit("mixtures", "paper_B", rule=rule), 3, f"ratio of sums {m.fit('mixtures', rule=rule).text(3)}", f"rule {p:g}", (f"B {p:g}",))
        yield number("... minus B by size", paper.RULES_LESS_SIZE[rule], m.fit("mixtures", "B_minus_size", rule=rule), 3,
                     f"neutral {plain(row.get('neutral', math.nan), 3)}", f"rule {p:g}", (f"B {p:g}", "slope"))


def slopes(m):
    flows = [row for row in m.plain_flows() if row["phi"] == 0.45 and not math.isnan(row["B"])]
    trend, _ = line_fit([row["slope"] for row in flows], [row["B"] for row in flows])
    mean = sum(row["B"] for row in flows) / max(1, len(flows))
    off = max((abs(row["B"] - mean) for row in flows), default=math.nan)
    return Target("B does not depend on the slope: dB/dθ per degree", paper.TREND, trend.text(4), [(trend, paper.TREND)],
                  f"{len(flows)} slopes, at most {plain(off, 3)} from their mean")


def stages(m):
    early, late = m.fit("mixtures", stage="early"), m.fit("mixtures", stage="late")
    yield number("B of early minus late stages, all mixtures", paper.STAGES, m.number("mixtures", "early_less_late"), 3,
                 f"t < {tables.EARLY} s {early.text(3)}, t > {tables.LATE} s {late.text(3)}", "stages")
    each = [(row, m.number(row["flow"], "early_less_late")) for row in m.mixtures()]
    yield Target("... in every mixture", paper.STAGES,
                 ", ".join(f"{value.text(3)} at {row['phi']:g}" for row, value in each),
                 [(value, paper.STAGES) for _, value in each], "", "stages")


def kinetic_stress(m):
    """Targets of figures 3 and 4 and of section IV."""
    yield from kinetic_profile(m)
    kinetic = {"quantity": "kinetic"}
    yield number("3b: prefactor of σ^κS/σ^κL", paper.KINETIC_PREFACTOR, m.fit("mixtures", "paper_k", **kinetic), 3,
                 f"exponent one: {m.fit('mixtures', 'paper_s', **kinetic).text(3)}; "
                 f"all heights {m.fit('mixtures', 'paper_s', heights='all', **kinetic).text(3)}", "B_kappa", ("prefactor",))
    yield number("3b: its exponent", paper.KINETIC_EXPONENT, m.fit("mixtures", "paper_a", **kinetic), 3, "", numbers=("exponent",))
    yield number("B_κ", paper.B_KAPPA, m.fit("mixtures", "paper_B", **kinetic), 3,
                 f"ratio of sums {m.fit('mixtures', **kinetic).text(3)}; all heights "
                 f"{m.fit('mixtures', 'paper_B', heights='all', **kinetic).text(3)}", "B_kappa", ("prefactor",))
    yield number("\\|B_κ\\| over B", paper.B_KAPPA_OVER_B, m.number("mixtures", "B_kappa/B"), 1, "", "")
    points = [(m.number("phi0.30-s23", f"Kyy/syy_{end}"), paper.KINETIC_OVER_CONTACT) for end in ("least", "most")]
    yield Target("Kinetic over contact stress", paper.KINETIC_OVER_CONTACT,
                 " to ".join(value.text(4) for value, _ in points), points,
                 "the paper's own figure 3a gives 0.98/55 = 0.018")
    yield from shear_rate(m)


def kinetic_profile(m):
    """Targets of figure 3a, for both interpretations of V, with fluctuations about the profile of the mean velocity."""
    at = lambda name: m.number("phi0.30-s23", name)
    for volume, suffix in (("per area of grains", "_solid"), ("per area with voids", "")):
        yield number(f"3a: P^κ at the base over ρ g d_S, {volume}", paper.P_KAPPA, at(f"K{suffix}_prefactor"), 2,
                     f"about the layer's mean {at(f'K_layer{suffix}_prefactor').text(2)}", "" if suffix else "3a level", ("3a level",))
        yield number(f"3a: decay length of P^κ in d_L, {volume}", paper.P_KAPPA_DECAY, at(f"K{suffix}_decay"), 1,
                     f"about the layer's mean {at(f'K_layer{suffix}_decay').text(1)}", "" if suffix else "3a decay", ("3a decay",))


def shear_rate(m):
    """Targets of figure 4, the line 0.310 + 0.205 x: B_kappa of each slope of the base compared with the line, by the estimator
    of the paper's -0.373."""
    flows = [row for row in m.plain_flows() if row["phi"] == 0.45 and not math.isnan(row["rate"])]
    flows.sort(key=lambda row: row["rate"])
    kinetic = [(row, -m.fit(row["flow"], "paper_B", quantity="kinetic")) for row in flows]
    kinetic = [(row, value) for row, value in kinetic if not math.isnan(value.value)]
    if len(kinetic) < 3:
        kinetic = []
    points = [(value, paper.figure_4(row["rate"])) for row, value in kinetic]
    off = [value.minus(line.value) for value, line in points] or [Value(math.nan)]
    off.sort(key=lambda value: value.value)
    line = paper.figure_4(0)
    room = (line.high - line.low) / 2
    yield Target("4: −B_κ minus the paper's line, over x = γ̇/√(g/d_S)",
                 paper.number(line.text, 0, room, line.source), f"{off[0].text(3)} to {off[-1].text(3)}", points,
                 "x from " + " to ".join(plain(row["rate"], 2) for row, _ in kinetic[:1] + kinetic[-1:]), "4", ("4 level", "4 slope"))
    slope, level = line_fit([row["rate"] for row, _ in kinetic], [value.value for _, value in kinetic])
    yield Target("4: −B_κ grows with x: slope of the line", paper.FIGURE_4_RISES, slope.text(3), [(slope, paper.FIGURE_4_RISES)],
                 f"fitted line {level.text(3)} + {slope.text(3)} x", "4", ("4 slope",))


def micro_structure(m):
    """Targets of figures 5 and 6 and of section V."""
    at = lambda name: m.number("mixtures", name)
    for name, end in (("Π", ""), ("Π^L", "_L"), ("Π^S", "_S")):
        mean, most = paper.FIGURE_5[end]
        yield number(f"5: mean error of {name}, %", mean, at(f"contacts_error{end}_mean"), 1,
                     f"over ends, with f_n: {at(f'ends_error{end}_mean').text(2)}")
        yield number(f"5: largest error of {name}, %", most, at(f"contacts_error{end}_most"), 1, "")
    first = lambda name: m.number("phi0.45-s23", name)
    yield number("6a: y_L/H at the start", paper.START, first("yL_first"), 3, "", one_of="")
    yield number("6a: y_L/H at the end", paper.END, first("yL_last"), 3,
                 f"falls {first('yL_falls').text(0)} times in {first('windows').text(0)} windows", one_of="")
    yield from orderings(first)


def orderings(first):
    yield number("6b: least z_L/z_S of all windows", paper.Z_ORDER, first("z_least"), 2,
                 f"start {first('z_first').text(2)}, end {first('z_last').text(2)}")
    yield number("6b: largest z_L/z_S over that at the ends", paper.Z_MOST, first("z_most/ends"), 2,
                 f"{first('z_most').text(2)}, at {first('z_most_at').text(0)} s; neutral: up to 2")
    yield number("6c: least f_L/f_S of all windows", paper.F_ORDER, first("f_least"), 2,
                 f"start {first('f_first').text(2)}, end {first('f_last').text(2)}; neutral {first('neutral_last').text(2)} at the end; measured over neutral "
                 f"{first('f_over_neutral').text(2)} on average")
    yield number("6c, inset: the same over the pressure at their depth", paper.F_DEPTH_ORDER, first("hat_least"), 2,
                 f"start {first('hat_first').text(2)}, end {first('hat_last').text(2)}; neutral r z_S/z_L")


SECTIONS = (("Contact stress (section III)", contact_stress),
            ("Kinetic stress (section IV)", kinetic_stress),
            ("Micro-structure (section V)", micro_structure))
