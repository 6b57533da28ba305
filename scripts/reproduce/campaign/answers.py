"""Tables of the documents on questions that the paper leaves open."""
import math
import os
import re

from measured import Value, plain
import tables
from tables import shared

NONE = "No run has finished yet."


def markdown(heads, rows):
    return shared.markdown(heads, rows) if rows else NONE


def interval(row, name, digits):
    return Value(row[name], row[name + "_low"], row[name + "_high"]).text(digits)


def about(row, name, digits):
    """Text of a value with its interval, whose half-width is in column NAME_reach."""
    value, reach = row[name], row[name + "_reach"]
    return Value(value, value - reach, value + reach).text(digits)


def of_flows(rows, pattern):
    return [row for row in rows if re.fullmatch(pattern, row["flow"])]


def strengths(rows, pattern):
    """Table of B, p* and B_kappa of flows, and of B minus B of the paper's choice over the same time."""
    return markdown(["flow", "B", "difference", "p*", "B_κ"], [[row["flow"], interval(row, "B", 3), about(row, "less_B", 3), interval(row, "p_star", 4),
                                                                 interval(row, "K", 3)] for row in of_flows(rows, pattern)])


def beds_of_densities(rows):
    """Table of B and p* by the ratio of the densities of large and small grains."""
    found = [(float(re.search("density([0-9.]+)", row["flow"])[1]), row) for row in of_flows(rows, r".*-density[0-9.]+-t60")]
    return markdown(["ρ_L/ρ_S", "B", "p*"], [[f"{ratio:g}", interval(row, "B", 3), interval(row, "p_star", 4)]
                                                           for ratio, row in sorted(found, key=lambda one: one[0])])


def fluctuations(rows, pattern):
    """Table of B_kappa for fluctuations about the profile and about the mean of layer and frame, with velocities after the step
    and in its middle."""
    names = ("K_sums", "K", "K_middle", "K_instant", "K_unbiased")
    heads = ["flow", "runs", "B", "B_κ by sums", "B_κ about the profile", "... middle of the step", "about layer and frame", "... unbiased"]
    return markdown(heads, [[row["flow"], f"{row['runs']:.0f}", interval(row, "B", 3)] + [interval(row, name, 3) for name in names]
                            for row in of_flows(rows, pattern)])


def with_and_without_a_row(row):
    """True if the base traps a row of large grains in some runs only; then an interval over runs has no meaning."""
    return row["trapped"] > 5 and row["trapped_reach"] > row["trapped"] / 2


def beds(rows, pattern):
    def number(row, text, name, digits):
        return f"{plain(row[name], digits)} ¹" if with_and_without_a_row(row) else text(row, name, digits)
    heads = ["flow", "runs", "B", "B, all heights", "y_L/H at the end", "large grains in the lowest layer"]
    return markdown(heads, [[row["flow"], f"{row['runs']:.0f}", interval(row, "B", 3), number(row, interval, "B_all", 3),
                             number(row, about, "yL_end", 3), number(row, about, "trapped", 1)]
                            for row in of_flows(rows, pattern)])


def accuracies(rows, pattern):
    if not of_flows(rows, pattern + "-t150"):
        return NONE
    heads = ["flow", "runs", "mean overlap/d_S", "B", "p*", "B_κ"]
    return markdown(heads, [[row["flow"], f"{row['runs']:.0f}", f"{row['overlap']:.1e}", interval(row, "B", 3), interval(row, "p_star", 4),
                             interval(row, "K", 3)] for row in of_flows(rows, pattern + "(-t150)?")])


def limits(rows):
    names = {"B": "B", "p_star": "p*", "K": "B_κ"}
    return markdown(["extrapolated", "power of the overlap", "limit of rigid discs", "χ²"],
                    [[names[row["of"]], f"{row['power']:g}", interval(row, "limit", 4), plain(row["chi2"], 1)] for row in rows])


def by_start(rows):
    """Table of B by time, with a column for each start."""
    starts = list(dict.fromkeys(row["of"].split()[0] for row in rows))
    times = list(dict.fromkeys(row["of"].split(" ", 1)[1] for row in rows))
    at = {tuple(row["of"].split(" ", 1)): row for row in rows}
    text = lambda row: Value(row["value"], row["low"], row["high"]).text(3) if row else ""
    return markdown(["time", *(f"{start}, B" for start in starts), "95 % over"],
                    [[time, *(text(at.get((start, time))) for start in starts),
                      ", ".join(dict.fromkeys(at[start, time]["over"] for start in starts if (start, time) in at))] for time in times])


def stages(rows):
    timed = [row for row in rows if row["what"] == "B"]
    fit = markdown(["model", "", "value", "95 % over"], [[row["of"], row["what"], Value(row["value"], row["low"], row["high"]).text(3), row["over"]]
                                                         for row in rows if row["what"] in ("j", "k")])
    return "\n\n".join(([by_start(timed)] if timed else []) + [fit]) if rows else NONE


def closures(rows):
    scaled = lambda row, name, factor, digits: Value(*(factor * row[name + end] for end in ("", "_low", "_high"))).text(digits)
    return markdown(["Φ_L", "B/c, 10⁻⁴ s", "d/c, 10⁻⁴ m²/s", "c by size, 1/s", "c by half, 1/s"],
                    [[f"{row['phi']:.2f}", scaled(row, "B_over_c", 1e4, 2), scaled(row, "d_over_c", 1e4, 2),
                      scaled(row, "c_size", 1, 0), scaled(row, "c_half", 1, 0)] for row in rows])


def denser(rows):
    names = {"slope": ("slope, 10⁻⁴ s", 1e4, 2), "at_zero": ("level B/c, 10⁻⁴ s", 1e4, 2), "c": ("c, 1/s", 1, 0), "B": ("B", 1, 2),
             "stops": ("ρ_L/ρ_S that stops segregation", 1, 2), "share": ("share p with this c", 1, 2)}
    text = lambda row, factor, digits: Value(*(factor * row["value" + end] for end in ("", "_low", "_high"))).text(digits)
    ratios = {f"{1 + float(row['of'][4:]):g}": text(row, 1e4, 2) for row in rows if row["of"].startswith("D =")}
    found = {names[row["of"]][0]: text(row, *names[row["of"]][1:]) for row in rows if row["of"] in names}
    return markdown(["ρ_L/ρ_S", *ratios], [["factor of the driving, 10⁻⁴ s", *ratios.values()]]) + "\n\n" + \
        markdown(list(found), [list(found.values())]) if ratios else NONE


def spheres(rows):
    """Table of B of chutes of spheres by mixture."""
    columns = {"**B by size**, 10 to 20 s": ("B 10-20", 3), "20 to 30 s": ("B 20-30", 3), "60 to 100 s": ("B 60-100", 3),
               "4 d_S, 60 to 100 s": ("B kept 4dS 60-100", 3), "20 to 30 s: p*": ("p_star", 3), "B by half": ("B half", 3), "B_κ": ("B_kappa", 2)}
    at = {(row["of"], row["name"]): row for row in rows if row["of"] != "phi_L"}
    cell = lambda row, digits: "" if math.isnan(row["value"]) else Value(row["value"], row["low"], row["high"]).text(digits)
    return markdown(["Φ_L", *columns], [[f"{of:.2f}", *(cell(at[of, name], digits) for name, digits in columns.values())]
                                        for of in dict.fromkeys(of for of, _ in at)])


def spheres_by_composition(rows):
    """Table of B of layers of spheres by their composition."""
    at = {row["name"]: row for row in rows if row["of"] == "phi_L"}
    text = lambda name, *ends: "" if math.isnan(at[name]["value"]) else Value(*(at[name][of] for of in ("value", *ends))).text(3)
    return markdown(["φ_L of the layer", "B", "10 to 30 s", "60 to 100 s"],
                    [[f"{k / 10:g} to {(k + 1) / 10:g}", text(f"all {k}", "low", "high"), text(f"early {k}"), text(f"late {k}")]
                     for k in range(10)]) if at else NONE


def read(folder, name):
    path = os.path.join(folder, name + ".tsv")
    return tables.read(path)[1] if os.path.exists(path) else []


def parts_of(folder):
    rows = read(folder, "questions")
    return {
        "control": strengths(rows, r".*-ratio1-t60"),
        "restitution": fluctuations(rows, r"mixtures-e0\.(25|5)"),
        "beds": beds(rows, r"phi0\.30-s23(-irregular|-spaced)?|phi0.45-s\d+-t60"),
        "densities": beds_of_densities(rows),
        "grains": strengths(rows, r"phi0.45-s23-(ratio(?!1-)[1-9.]+|mu[0-9.]+|e[0-9.]+(-step[0-9.]+)?|cell.*)-t60"),
        "accuracy": accuracies(rows, r"phi0.45-s23(-draft|-reference|-finer)?"),
        "second-program": strengths(rows, r"phi0.45-s23-lammps.*"),
        "starts": strengths(rows, r"phi0.45-s23-(mixed-|above-)?t600"),
        "limit": limits(read(folder, "rigid-limit")),
        "stages": stages(read(folder, "stages")),
        "closures": closures(read(folder, "closures")),
        "denser": denser(read(folder, "denser")),
        "spheres": spheres(read(folder, "spheres")),
        "spheres-composition": spheres_by_composition(read(folder, "spheres")),
    }


def answers(options):
    """Rewrites tables of documents from the results of the commands questions, stages, rigid-limit, closures, denser and spheres.

    FOLDER contains the results that exist: questions.tsv, stages.tsv, rigid-limit.tsv, closures.tsv, denser.tsv, spheres.tsv. Each
    table is in one of the documents, between <!-- NAME --> and <!-- /NAME -->; a table without finished runs may be missing.
    """
    parts = parts_of(options.folder)
    shared.rewrite("answers", options.documents, parts, optional=[name for name, part in parts.items() if part == NONE])
