"""Generated parts of docs/studies/reproduction.md and of its annex."""
import math
import os

import errata
from measured import Measured, Value
from rise import CLASSES
from tables import shared
import targets
import verdicts

markdown = shared.markdown
# Captions of the figures, in the order of the paper.
CAPTIONS = {
    "snapshots": "1",
    "pressure-profile": "2a",
    "stress-ratio": "2b",
    "mixed-share": "2c",
    "kinetic-profile": "3a, about profile and layer",
    "kinetic-ratio": "3b; the lowest layer beside it",
    "kinetic-shear-rate": "4",
    "pressure-estimates": "5, also over ends",
    "micro-over-time": "6, first seed",
    "b-of-p": "B over the share p",
    "b-of-flows": "B and −B_κ, early and late",
    "b-of-composition": "B of layers over their φ_L",
    "balance": "forces on large grains",
    "combinations": "choices that meet each number",
    "step": "z, f and z f over the step",
}


def sections(m):
    return [(title, list(targets.judged(m, section))) for title, section in targets.SECTIONS]


def verdict_tables(m):
    heads = ["target", "paper", "met if", "measured here", "verdict"]
    return "\n\n".join(f"### {title}\n\n" + markdown(heads, [target.cells() for target in section])
                       for title, section in sections(m))


def counts(m):
    found = targets.independent([target for _, section in sections(m) for target in section])
    each = [f"{found.count(verdict)} {verdict.strip('*')}" for verdict in verdicts.FROM_BEST_TO_WORST if found.count(verdict)]
    return f"{len(found)} independent statements: {', '.join(each)}."


def pictures(m):
    """Table of the figures that could be drawn from the finished flows."""
    drawn = [f"![{name}](figures/reproduction/{name}.png)<br>{caption}" for name, caption in CAPTIONS.items()
             if os.path.exists(os.path.join(m.folder, name + ".png"))]
    return markdown(["", ""], [drawn[k:k + 2] for k in range(0, len(drawn), 2)])


def flows(m):
    def line(row):
        value = lambda name, digits: m.of_flow(row["flow"], name).text(digits)
        push = lambda name, digits: m.number(row["flow"], name).text(digits)
        return [flow_name(row), value("yL1", 3), value("rate", 3), value("t50", 0),
                push("push", 1), push("push_kinetic", 2)]
    heads = ["Φ_L, θ", "y_L/H, last window", "γ̇/√(g/d_S)", "t50 (s)", "contact push", "kinetic push"]
    return markdown(heads, [line(row) for row in m.plain_flows()])


def flow_name(row):
    return f"{row['phi']:g}, {row['slope']:g}°"


def choices(m):
    rows = []
    for row in m.choices:
        value = lambda name: Value(*(row[name + end] for end in ("", "_low", "_high")))
        text = lambda name: "" if math.isnan(row[name]) else value(name).text(3)
        less = lambda name: "" if math.isnan(row[name]) else f"{row[name]:+.3f}".replace("-", "−")
        based = row["choice"] in ("first 60 s", "all times")
        rows.append([f"**{row['choice']}**" if based else row["choice"], text("B"),
                     "–" if based else less("less"), text("K"), "–" if based else less("K_less")])
    if not rows:
        return "Not measured yet."
    heads = [f"{m.choices[0]['flow']}, choice", "B", "difference", "B_κ", "difference"]
    return markdown(heads, rows)


def scan(m):
    return (f"B = 0 at p* = {m.of_scan('p_zero').text(4)} (neutral contacts: 2/3); "
            f"there dB/dp = {m.of_scan('dB_dp').text(3)}.")


def by_flow(m):
    """B, p* and B_kappa of each flow, by stage, component, rule and estimator."""
    named = [(flow_name(row), row["flow"]) for row in m.plain_flows()] + [("pooled", "mixtures")]
    kinetic = {"quantity": "kinetic"}
    rows = [[f"{title} ({m.row(name)['seeds']:.0f})", m.fit(name).text(3), m.fit(name, "p_zero").text(4), m.fit(name, rule="half").text(3),
             m.fit(name, stage="early").text(3), m.fit(name, stage="late").text(3), m.fit(name, component="pressure").text(3),
             m.fit(name, "paper_B").text(3), m.fit(name, **kinetic).text(3), m.fit(name, "paper_B", **kinetic).text(3)]
            for title, name in named if m.row(name)]
    return markdown(["Φ_L, θ (runs)", "**B**", "p*", "B, half", "B, t < 60 s", "B, t > 100 s", "B of the pressure", "B, paper's fit",
                     "B_κ", "B_κ, paper's fit"], rows)


def pooled(m):
    """B of all mixtures together over each population, and the weights of the mixtures."""
    flows, row = m.mixtures(), m.row("mixtures")
    if not flows or not row:
        return "Not measured yet."
    total = sum(flow["weight"] for flow in flows)
    shares = ", ".join(f"{100 * flow['weight'] / total:.0f}" for flow in flows)
    over = ("`flows`", ""), ("`windows`", "_windows")
    rows = [[title, m.fit("mixtures", "B" + end).text(3)] for title, end in over]
    return markdown(["over", f"B of these {row['seeds']:.0f} runs"], rows) + f"\n\nWeights of the mixtures: {shares} %."


def rise(m):
    """Tables of the factors of B by mixture, of the trend of B over mixtures, and of B of layers (rise.py)."""
    flows = m.mixtures()
    of = lambda row, name, digits: m.number(row["flow"], f"rise_{name}").text(digits)
    one = lambda row: m.number("mixtures", f"rise_one_{row['phi']:g}").text(4)
    factors = markdown(
        ["Φ_L", "p_size − p*", "mixed", "geometry", "B with one p*"],
        [[f"{row['phi']:g}", of(row, "beyond", 4), of(row, "mixed", 3), of(row, "geometry", 3), one(row)] for row in flows])
    both = lambda name: [m.number("mixtures", f"rise_{prefix}{name}").text(3) for prefix in ("", "upper_")]
    trends = markdown(["change per unit of Φ_L", "all six mixtures", "Φ_L from 0.30 on"],
                      [["B, sums"] + both("trend_B"), ["B with one p*"] + both("trend_one")])
    two = lambda name: [m.number("mixtures", f"rise_{which}_{name}").text(3) for which in ("excess", "kept")]
    local = markdown(["φ_L of the layer", "B", "B of the layers' means"],
                     [[f"{k / CLASSES:g} to {(k + 1) / CLASSES:g}"] + two(f"of_{k}") for k in range(CLASSES)])
    follows = {"whole": "Φ_L of the flow, 0 to 1", "phi": "φ_L of the layer, 0 to 1", "y": "height, 0 to 60 d_S", "t": "time, 0 to 150 s"}
    followed = markdown(["B of a layer changes over", "by", "B of the layers' means by"],
                        [[title] + two(f"over_{name}") for name, title in follows.items()])
    return "\n\n".join((factors, trends, local, followed))


def source(m):
    """Words on the flows, seeds, windows and programs of the tables."""
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


MAIN = {"source": source, "counts": counts, "by-flow": by_flow, "scan": scan, "targets": verdict_tables}
ANNEX = {"pictures": pictures, "flows": flows, "pooled": pooled, "rise": rise, "choices": choices,
         "errata": lambda m: markdown(["paper", "what is wrong or open"], errata.rows(m))}


def document(options):
    """Rewrites the generated parts of docs/studies/reproduction.md and its annex from the tables that document.mk makes.

    A generated part is the text between <!-- NAME --> and <!-- /NAME -->; the rest of a file does not change.
    """
    m = Measured(options.work)
    for path, parts in zip(options.documents, (MAIN, ANNEX)):
        shared.rewrite("document", [path], {name: part(m) for name, part in parts.items()})
