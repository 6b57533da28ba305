"""Fits of the campaign's runs by grseg-fit: sets, choices and rules."""
import concurrent.futures
import math
import os
import sys

import tables
from tables import ENDS, WHERE

RULES = "size,uniform:0.66667,half,uniform:0.8,uniform:0.6"
STAGES = {"all": [], "early": ["--end", tables.EARLY], "late": ["--begin", tables.LATE]}
HEIGHTS = {"inside": ["--heights", "4dS:56dS"], "all": ["--heights", "all"]}
# Fits: quantity, component, rules, and pairs of stage and heights.
EVERY = [("early", "inside"), ("late", "inside"), ("all", "all")]
KINDS = [("contact", "yy", RULES, [("all", "inside")]), ("contact", "yy", "size", EVERY),
         ("contact", "pressure", "size", [("all", "inside")]),
         ("kinetic", "yy", "", [("all", "inside")] + EVERY)]


def sets_of(runs):
    """Lists of runs by the name of the set; see fits()."""
    plain = [run for run in runs if not run.variant]
    sets = {"mixtures": [run for run in plain if run.slope == 23],
            "slopes": [run for run in plain if run.phi == 0.45],
            "control": [run for run in runs if run.variant == tables.CONTROL], **tables.by_flow(plain)}
    return {name: chosen for name, chosen in sets.items() if chosen}


def cases_of(sets, kinds):
    for name, runs in sets.items():
        one = name == runs[0].flow
        for quantity, component, rules, parts in kinds:
            if name == "control" and quantity != "contact":
                continue
            for stage, heights in parts:
                yield {"set": name, "phi": runs[0].phi if one else math.nan, "slope": runs[0].slope if one else math.nan,
                       "seeds": len(runs), "stage": stage, "heights": heights, "quantity": quantity,
                       "component": component}, runs, rules


def fit(options, case, runs, rules):
    """Rows of grseg-fit for one case, each with the columns of the case before those of grseg-fit."""
    kind = "stress-random" if case["set"] == "control" else \
        "stress" if case["quantity"] == "contact" else "kinetic"
    words = ["--quantity", case["quantity"], "--component", case["component"], "--quiet",
             *STAGES[case["stage"]], *HEIGHTS[case["heights"]], *tables.sizes_of(runs)]
    if len(tables.by_flow(runs)) > 1:
        words += ["--over", "flows"]
    if rules:
        words += ["--partition", rules]
    label = f"fits: {case['set']}, {case['stage']}, {case['heights']}"
    return [{**case, **row} for row in tables.fits_if_any(options, label, *(run.path(kind) for run in runs), *words)]


def fits(options):
    """Writes all fits of the reproduction into one table: grseg-fit applied to the runs of each set.

    TABLES is a folder with sums of runs, NAME/stress.tsv and NAME/kinetic.tsv. With --partition: only B by these rules, over
    all times. The first columns describe the fit:
        set       mixtures (all runs at 23 degrees), slopes (all runs with phi_L = 0.45), control (equal grains with
                  random labels), or one flow (phi0.30-s23), with its phi and slope
        seeds     number of runs
        stage     all, early (t < EARLY) or late (t > LATE; both in tables.py)
        heights   inside (4dS:56dS: without the lowest layer and the surface) or all
        quantity component
    Then follows a column for each number of grseg-fit, with NAME_low and NAME_high. Intervals of a flow are over its runs.
    Those of `mixtures` and `slopes` are over flows (docs/studies/uncertainty.md). All rules are fitted for all times inside; other stages and all heights only by
    size. A set without any usable point has no row.
    """
    sets = sets_of(tables.runs_in(options.tables))
    kinds = [("contact", "yy", options.partition, [("all", heights) for heights in HEIGHTS])] \
        if options.partition else KINDS
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda case: fit(options, *case), cases_of(sets, kinds))
        rows = [row for rows in found for row in rows]
    if not rows:
        sys.exit(f"fits: {options.tables}: no set can be fitted; see above")
    names = list(dict.fromkeys(name for row in rows for name in row))
    tables.write(options.output, f"fits {tables.EARLY} {tables.LATE}", names, [{name: row.get(name, math.nan) for name in names} for row in rows])


FLOWS = ("phi0.45-s23", "phi0.30-s23")
FIRST = ["--end", 60]
BASES = ("first 60 s", "all times")  # choices with which the choices after them in the list are compared
# Choices: title, variant of the run, options of grseg-fit, table of contacts, table of kinetic sums (None: not affected).
CHOICES = [
    ("first 60 s", "", FIRST, "stress", "kinetic"),
    ("restitution 0.5 instead of 0.25", "e0.5", FIRST, "stress", "kinetic"),
    ("step 1.25e-4 s instead of 2.5e-4 s", "step0.000125", FIRST, "stress", "kinetic"),
    ("accuracy draft (step 4e-4 s)", "draft", FIRST, "stress", "kinetic"),
    ("accuracy reference (step 1e-4 s)", "reference", FIRST, "stress", "kinetic"),
    ("cell 140 d_S instead of 70", "cell140dS", FIRST, "stress", "kinetic"),
    ("all times", "", [], "stress", "kinetic"),
    ("contacts booked along the branch", "", [], "stress-branch", None),
    ("contacts booked at grains' centres", "", [], "stress-grain", None),
    ("coarse grained, Gaussian of 1 d_S", "", [], "stress-gauss", None),
    ("areas booked at grains' centres", "", [], "stress-centre", None),
    ("layers of 2 d_S", "", [], "stress-2dS", None),
    ("layers of 8 d_S", "", [], "stress-8dS", None),
    ("every second frame", "", [], "stress-stride2", None),
    ("every fifth frame", "", [], "stress-stride5", None),
    ("fluctuation about the layer's mean", "", [], None, "kinetic-layer"),
    ("... about the mean of layer and frame", "", [], None, "kinetic-instant"),
]
NAMES = ("B", "H", "K", "K_P")
NONE = (math.nan,) * 3


def fitted(options, runs, quantity, *words):
    """(B, low, high) for each rule; None if a table is missing, [] if grseg-fit fails."""
    if quantity is None or not runs or not all(run.has(quantity) for run in runs):
        return None
    rows = tables.fits_if_any(options, "choices", *(run.path(quantity) for run in runs), *WHERE, *words)
    return [tuple(row[f"B{end}"] for end in ("", "_windows_low", "_windows_high")) for row in rows]


def of_choice(options, runs, choice):
    """Row of a choice, with nan for quantities that the choice does not affect."""
    title, variant, times, contacts, motion = choice
    runs = [run for run in runs if run.variant == variant]
    size, half = fitted(options, runs, contacts, "--partition", "size,half", *times) or (NONE, NONE)
    kinetic = [(fitted(options, runs, motion, "--quantity", "kinetic", "--component", component, *times) or [NONE])[0]
               for component in ("yy", "pressure")]
    row = {"choice": title, "runs": len(runs)}
    for name, values in zip(NAMES, (size, half, *kinetic)):
        row.update({name + end: value for end, value in zip(ENDS, values)})
    return row


def choices(options):
    """Writes B and B_kappa for choices that the paper does not state, one row per choice.

    The flow is the first of FLOWS that has finished, with all seeds, between 4 and 56 d_S. Other simulations (its variants)
    are compared with the first 60 s of the flow. Other reductions of the same frames are compared with all times of the flow.
    less and K_less are the differences. Intervals are over windows only (docs/studies/uncertainty.md), because many
    comparisons use the same runs.
        B H       B by size and by half, yy
        K K_P     B_kappa of yy and of the pressure
    """
    runs = tables.runs_in(options.tables)
    flow = next((name for name in FLOWS if any(run.flow == name for run in runs)), "none")
    runs = [run for run in runs if run.flow == flow or run.flow.startswith(flow + "-")]
    rows = [{"flow": flow, **of_choice(options, runs, choice)} for choice in CHOICES]
    rows = [row for row in rows if not all(math.isnan(row[name]) for name in NAMES)]
    base = None
    for row in rows:
        base = row if row["choice"] in BASES else base
        other = base or row
        row["less"], row["K_less"] = row["B"] - other["B"], row["K"] - other["K"]
    names = [name + end for name in NAMES for end in ENDS]
    tables.write(options.output, "choices", ["flow", "choice", "runs", *names, "less", "K_less"], rows)


def mixtures(options):
    """Writes B of each mixture under every rule: B(p), B by rule, and p*.

    Each mixture is a flow at 23 degrees (or a flow of --flows), with layers from 4 to 56 d_S, all times and all seeds together:
        FILE/scan-FLOW.tsv    grseg-fit --scan: B over p with its band
        FILE/rules.tsv        a row per flow and rule: B by size, contact-point and half with 95 % intervals over runs, B of
                              neutral contacts with the same weights, p* with its interval, and the mean share of the rule
    """
    flows = tables.flows_in(options, lambda run: run.slope == 23 and not run.variant)
    os.makedirs(options.output, exist_ok=True)
    rows = []
    for flow, runs in flows.items():
        words = [*(run.path("stress") for run in runs), *WHERE]
        tables.shared.tool(options.bin, "grseg-fit", *words, "--scan", "0.4:0.9:0.0125", "--overwrite", "-o",
                           os.path.join(options.output, f"scan-{flow}.tsv"))
        for fit_ in tables.fits(options, *words, "--partition", "size,contact-point,half"):
            rows.append({"flow": flow, "phi": runs[0].phi, "runs": len(runs), **{name: fit_[name] for name in ("rule", "neutral", "share")},
                         **{f"{to}{end}": fit_[f"{name}{end}"] for to, name in (("B", "B"), ("p_star", "p_zero")) for end in ENDS}})
    tables.write(os.path.join(options.output, "rules.tsv"), "mixtures", list(rows[0]), rows)
