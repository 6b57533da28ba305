"""The generated parts of docs/studies/reproduction.md and of its annex."""
import math
import os

import combined
import errata
from measured import Measured, Value, plain
from tables import shared
import targets
import verdicts

markdown = shared.markdown
# Captions of the figures, in the order of the paper.
CAPTIONS = {
    "snapshots": "Figure 1. Φ_L = 0.30, 23°, at the start and at the end",
    "pressure-profile":
        "Figure 2a. The line with cosθ is the one in the text, the other the one in the caption",
    "stress-ratio": "Figure 2b: the layers and windows of the fit, from 4 to 56 d_S, and its line",
    "mixed-share": "Figure 2c, with the curve of contacts that ignore grain size",
    "kinetic-profile":
        "Figure 3a, for both definitions of a velocity fluctuation; right: kinetic stress over contact stress",
    "kinetic-ratio": "Figure 3b, likewise; beside them the lowest layer, with the row that the base traps",
    "kinetic-shear-rate": "Figure 4, with the paper's line",
    "pressure-estimates": "Figure 5 with 1/(πd), and Π from contact ends and normal forces",
    "micro-over-time": "Figure 6, first seed, with the forces expected if they ignored grain size",
    "b-of-p": "B over the share of a mixed contact that goes to its large grain, with the rules of published codes",
    "b-of-flows": "B and −B_κ of each flow, early and late",
    "balance":
        "Which mechanism pushes the large grains of Φ_L = 0.30 in which direction ([balance.md](balance.md))",
    "combinations": "Of the combinations with a choice the part that meets each number of the paper",
    "step": "Contacts per grain, mean force, and their product over the time step",
}


def sections(m):
    return [(title, list(targets.judged(m, section))) for title, section in targets.SECTIONS]


def verdict_tables(m):
    heads = ["target", "paper", "met if", "measured here", "difference", "verdict", "remarks"]
    return "\n\n".join(f"### {title}\n\n" + markdown(heads, [target.cells() for target in section])
                       for title, section in sections(m))


def counts(m):
    all_targets = [target for _, section in sections(m) for target in section]

    def text(what, found):
        each = [f"{found.count(verdict)} {'is' if found.count(verdict) == 1 else 'are'} {verdict.strip('*')}" for verdict in verdicts.FROM_BEST_TO_WORST
                if found.count(verdict)]
        return f"Of {len(found)} {what} {', '.join(each)}."
    return "\n".join((text("independent statements", targets.independent(all_targets)), text("rows below", [target.verdict() for target in all_targets])))


def ranges(m):
    rows = [[target.name, target.statement.text, targets.allowed(target.statement), target.statement.source]
            for _, section in sections(m) for target in section]
    return markdown(["target", "paper", "met if", "why this range"], rows)


def pictures(m):
    """The figures that could be drawn from the flows there are."""
    drawn = [name for name in CAPTIONS if os.path.exists(os.path.join(m.folder, name + ".png"))]
    return markdown(["", ""], [[f"![{name}](figures/reproduction/{name}.png)", CAPTIONS[name]]
                            for name in drawn])


def flows(m):
    def line(row):
        value = lambda name, digits: m.of_flow(row["flow"], name).text(digits)
        return [f"{row['phi']:g}", f"{row['slope']:g}", f"{row['seeds']:.0f}", plain(row["duration"], 0),
                plain(row["small"], 0),
                plain(row["large"], 0), value("H0", 1), value("yL0", 3), value("yL1", 3),
                value("rate", 3), value("t50", 0)]
    heads = ["Φ_L", "θ", "seeds", "s", "small", "large", "H/d_S, first window", "y_L/H, first window",
             "y_L/H, last window", "γ̇ / √(g/d_S)", "t50 (s)"]
    return markdown(heads, [line(row) for row in m.plain_flows()])


def all_heights(m, flow):
    """B of all heights, without an interval where some runs keep the row of large grains that the base traps, and others do not."""
    value = m.fit(flow, heights="all")
    return f"{plain(value.value, 3)} ¹" if targets.with_and_without_a_row(m, flow) else value.text(3)


def strengths(m):
    rows = []
    names = [("23°, all six mixtures pooled", "mixtures"), ("Φ_L = 0.45, all six slopes pooled", "slopes")]
    names += [(f"Φ_L = {row['phi']:g}, {row['slope']:g}°", row["flow"]) for row in m.plain_flows()]
    for title, name in names:
        kinetic = {"quantity": "kinetic"}
        if m.row(name) is None:
            continue
        rows.append([title, f"{m.row(name)['seeds']:.0f}", m.fit(name).text(3),
                     m.fit(name, stage="early").text(3), m.fit(name, stage="late").text(3),
                     all_heights(m, name), m.fit(name, component="pressure").text(3),
                     m.fit(name, "paper_B", **kinetic).text(3), m.fit(name, "paper_a", **kinetic).text(3)])
    heads = ["flow", "runs", "B", "t < 60 s", "t > 100 s", "all heights", "from the pressure", "B_κ", "exponent of B_κ's fit"]
    return markdown(heads, rows)


def estimators(m):
    names = (("B", "B, the ratio of sums"), ("paper_s", "slope s of the paper's fit"), ("paper_B", "B of that slope"),
             ("paper_k", "prefactor k of the power law k x^a"), ("paper_a", "its exponent a"))
    rows = [[title] + [m.fit("mixtures", name, **how).text(3)
                       for how in ({}, {"component": "pressure"}, {"quantity": "kinetic"})]
            for name, title in names]
    return markdown(["estimator, 23°, six mixtures pooled", "from σ_yy", "from the pressure", "kinetic, yy"], rows)


def choices(m):
    rows = []
    for row in m.choices:
        value = lambda name: Value(*(row[name + end] for end in ("", "_low", "_high")))
        text = lambda name: "" if math.isnan(row[name]) else value(name).text(3)
        less = lambda name: "" if math.isnan(row[name]) else f"{row[name]:+.3f}".replace("-", "−")
        based = row["choice"] in ("first 60 s", "all times")
        rows.append([f"**{row['choice']}**" if based else row["choice"], f"{row['runs']:.0f}", text("B"),
                     "–" if based else less("less"), text("H"), text("K"),
                     "–" if based else less("K_less"), text("K_P")])
    if not rows:
        return "Not measured yet."
    heads = [f"{m.choices[0]['flow']}, choice", "runs", "B, size", "difference", "B, half", "B_κ, yy", "difference", "B_κ, pressure"]
    return markdown(heads, rows)


def scan(m):
    return (f"B = 0 at p* = {m.of_scan('p_zero').text(4)} (neutral contacts: 2/3); "
            f"there dB/dp = {m.of_scan('dB_dp').text(3)}.")


def by_mixture(m):
    """B, p* and B_kappa of each mixture, and by the paper's fit."""
    flows = m.mixtures()
    if not flows:
        return "Not measured yet."
    rows = [[f"{row['phi']:g}", f"{row['seeds']:.0f}"]
            + [m.fit(row["flow"], name).text(digits) for name, digits in (("B", 3), ("p_zero", 4))]
            + [m.number(row["flow"], "rise_early_less_late").text(3), m.fit(row["flow"], "paper_B").text(3)]
            + [m.fit(row["flow"], name, quantity="kinetic").text(3) for name in ("B", "paper_B")] for row in flows]
    return markdown(["Φ_L", "runs", "**B**", "p*", "B before 60 s minus B after 100 s", "B by the paper's fit",
                           "B_κ", "B_κ by the paper's fit"], rows)


def pooled(m):
    """One B for all mixtures: what each such number is a number of."""
    flows, row = m.mixtures(), m.row("mixtures")
    if not flows or not row:
        return "Not measured yet."
    total = sum(flow["weight"] for flow in flows)
    shares = ", ".join(f"{100 * flow['weight'] / total:.0f} % from Φ_L = {flow['phi']:g}" for flow in flows)
    over = (("compositions: these layers' compositions, weighted, if B were one function of composition", ""),
            ("flows: these mixtures, weighted", "_flows"),
            ("equal flows: these mixtures, each counting the same", "_equal_flows"),
            ("random flows: all mixtures of which these are a random sample", "_random_flows"))
    rows = [[title, m.fit("mixtures", "B" + end).text(3)] for title, end in over]
    return markdown(["over", f"B of these {row['seeds']:.0f} runs"], rows) + f"\n\nOf the weight, {shares}."


def rise(m):
    """Factors and terms of B by mixture, and its trend over mixtures."""
    flows = m.mixtures()
    of = lambda row, name, digits: m.number(row["flow"], f"rise_{name}").text(digits)
    one = lambda row: m.number("mixtures", f"rise_one_{row['phi']:g}").text(4)
    factors = markdown(
        ["Φ_L", "B", "B of the factors", "p_size − p*", "mixed", "geometry", "B with one p*"],
        [[f"{row['phi']:g}", m.fit(row["flow"]).text(4), of(row, "B", 4), of(row, "beyond", 4), of(row, "mixed", 3),
          of(row, "geometry", 3), one(row)] for row in flows])
    terms = markdown(
        ["Φ_L", "ends", "forces", "pairing", "normal", "−ln s", "mixed contacts over neutral", "over random pairing"],
        [[f"{row['phi']:g}"] + [of(row, name, 3) for name in ("ends", "forces", "pairing", "normal", "log", "LS/neutral", "LS/random")]
         for row in flows])
    both = lambda name: [m.number("mixtures", f"rise_{prefix}{name}").text(3) for prefix in ("", "upper_")]
    alike = {"": "B of all layers, weighted by φ_L φ_S", "phi": "at equal φ_L", "phi_long": "the same in windows of 25 s", "y": "at equal height", "gradient": "at equal ∂φ_L/∂y",
             "phi_y": "at equal φ_L and height", "phi_y_t": "at equal φ_L, height and stage", "phi_y_gradient": "at equal φ_L, height and ∂φ_L/∂y"}
    trends = [["B, sums"] + both("trend_B"), ["B with one p*"] + both("trend_one")]
    trends += [[f"of −ln s: {name}"] + both(f"trend_{name}") for name in ("ends", "forces", "pairing", "normal", "log")]
    trends += [[title] + both("_".join(filter(None, ("alike", name)))) for name, title in alike.items()]
    return "\n\n".join((factors, terms, markdown(["change per unit of Φ_L", "all six mixtures", "Φ_L from 0.30 on"], trends)))


def forces(m):
    heads = ["flow", "contact stress", "kinetic stress", "drag"]
    rows = [[f"Φ_L = {row['phi']:g}, {row['slope']:g}°"]
            + [m.number(row["flow"], name).text(digits)
               for name, digits in (("push", 1), ("push_kinetic", 2), ("drag", 1))]
            for row in m.plain_flows()]
    return markdown(heads, rows)


def source(m):
    """Which part of the campaign the tables cover."""
    paper = [f"phi{phi}-s23" for phi in ("0.06", "0.15", "0.30", "0.45", "0.60", "0.75")]
    paper += [f"phi0.45-s{slope}" for slope in (21, 22, 24, 25, 26)]
    missing = [name for name in paper if m.flow(name) is None]
    seeds = sorted({int(row["seeds"]) for row in m.plain_flows()})
    frames = " to ".join(f"{n:.0f}" for n in sorted({min(row["frames"] for row in m.flows),
                                                     max(row["frames"] for row in m.flows)}))
    text = (f"**{len(paper) - len(missing)} of the paper's eleven flows, with "
            f"{' to '.join(str(n) for n in sorted({seeds[0], seeds[-1]}))} seed"
            f"{'' if seeds[-1] == 1 else 's'} each**; windows of "
            f"{m.flows[0]['window']:g} s with {frames} frames")
    if missing:
        text += f". Not run yet: {', '.join(missing)}"
    programs = sorted({name for row in m.flows for name in row["program"].split(" and ")})
    mixed = " **They were simulated by different programs**, which may explain differences between flows." \
        if len(programs) > 1 else ""
    return f"{text}. Simulated by {', '.join(programs)}.{mixed}"


def combinations(m):
    return "\n\n".join(combined.report(m.combinations)) if m.combinations else "Not measured yet."


MAIN = {"source": source, "counts": counts, "combinations": combinations, "by-mixture": by_mixture, "targets": verdict_tables}
ANNEX = {"ranges": ranges, "pictures": pictures, "flows": flows, "strengths": strengths, "pooled": pooled, "estimators": estimators,
         "scan": scan, "rise": rise, "forces": forces, "choices": choices,
         "errata": lambda m: markdown(["paper", "what is wrong or open", "measured"], errata.rows(m))}


def document(options):
    """Rewrites the generated parts of docs/studies/reproduction.md and its annex from the tables that document.mk makes.

    A generated part stands between <!-- NAME --> and <!-- /NAME -->; the rest of a file is left as it is.
    """
    m = Measured(options.work)
    for path, parts in zip(options.documents, (MAIN, ANNEX)):
        shared.rewrite("document", [path], {name: part(m) for name, part in parts.items()})
