"""Questions that the paper leaves open: results flow by flow, and in the limit of rigid discs."""
import math
import re
import sys

import tables

NAN = math.nan
FLOW_BEFORE = 10  # time at which LAMMPS continues from a state of the paper's flow, s (docs/studies/open-questions.md)


NO_FIT = (NAN,) * 5


def fitted(options, runs, quantity, column, *words, table=None):
    """Value, low, high, standard error and degrees of freedom of a number of grseg-fit for all these runs; nan if unknown.
    For several mixtures the population is --over flows: each flow with its weight."""
    table = table or {"contact": "stress", "kinetic": "kinetic"}[quantity]
    if not runs or not all(run.has(table) for run in runs):
        return NO_FIT
    words = [*words, *tables.sizes_of(runs), *(["--over", "flows"] if len(tables.by_flow(runs)) > 1 else [])]
    rows = tables.fits_if_any(options, f"questions: {runs[0].flow}", *(run.path(table) for run in runs), "--quantity", quantity, "--quiet",
                              *words)
    if not rows:
        return NO_FIT
    if len(rows) != 1:
        sys.exit(f"questions: {runs[0].flow}: grseg-fit printed {len(rows)} rules, but one was expected")
    value, low, high = (rows[0][column + end] for end in tables.ENDS)
    freedom = rows[0]["degrees_of_freedom"]
    freedom = 1e9 if math.isnan(freedom) else freedom
    return value, low, high, (high - low) / 2 / tables.student(freedom), freedom


def inside(run):
    """The option --heights: 4 to 56 d_S for a bed of 60 d_S, and the same distances from base and surface for another."""
    depth = re.search(r"depth(\d+)dS", run.flow)
    return ["--heights", f"4dS:{int(depth[1]) - 4 if depth else 56}dS"]


def strengths(options, runs, begin, end):
    """All numbers of grseg-fit for these runs between two times, by name."""
    where = [*inside(runs[0]), "--begin", begin, "--end", end]
    table = "stress-random" if re.search("-ratio1(-|$)", runs[0].flow) else None
    of = lambda column, *words, quantity="contact", only=None: fitted(options, runs, quantity, column, *words, table=only or table)
    kinetic = lambda table: of("paper_B", *where, quantity="kinetic", only=table)
    return {"B": of("B", *where), "B_fit": of("paper_B", *where), "B_half_rule": of("B", "--partition", "half", *where),
            "B_pressure": of("B", "--component", "pressure", *where), "p_star": of("p_zero", *where),
            "B_all": of("B", "--heights", "all", "--begin", begin, "--end", end), "K": kinetic("kinetic"),
            "K_sums": of("B", *where, quantity="kinetic", only="kinetic"),
            **{f"K_{name}": kinetic(f"kinetic-{name}") for name in ("instant", "unbiased", "middle", "unbiased-middle")}}


def of_bed(run):
    """Numbers of the run's bed: y_L/H and number of large grains in the lowest layer, both in the last window; mean shear
    rate; mean overlap; f_ratio."""
    found = {"yL_end": NAN, "trapped": NAN, "rate": NAN, "overlap": NAN, "f_ratio": NAN}
    sums = tables.table(run.path("stress"))
    last = sums["area_L"][(sums["t0"] == sums["t0"][-1]) & (sums["y0"] == 0)]
    if len(last) and "large_diameter" in sums.header:
        found["trapped"] = last[0] / (math.pi / 4 * sums.number("large_diameter") ** 2)
    if run.has("segregation"):
        _, bed, found["rate"] = tables.of_bed(run)
        found["yL_end"] = bed[-1]["yL"] / bed[-1]["height"]
    if run.has("record"):
        named = run.record()
        if "summary_mean_overlap" in named:
            found["overlap"] = named["summary_mean_overlap"] / named["small_diameter"]
    if run.has("micro"):
        found["f_ratio"] = force_ratio(run)
    return found


def force_ratio(run):
    """Mean |f| of the contacts of large grains over that of small grains, in the whole bed, last 15 s. A mixed contact counts for both."""
    sums = tables.table(run.path("micro"))
    late = sums["t1"] > sums["t1"][-1] - 15
    of = lambda name, s: sum(sums[f"{name}_{pair}"][late].sum() for pair in (s + s, "LS", s + "b"))
    return of("sum_f", "L") / of("n", "L") / (of("sum_f", "S") / of("n", "S"))


def line(options, flow, runs, paper):
    end = min(tables.table(run.path("stress"))["t1"][-1] for run in runs)
    row = {"flow": flow, "phi": runs[0].phi, "slope": runs[0].slope, "runs": len(runs), "end": end}
    own = strengths(options, runs, 0, end)
    before = FLOW_BEFORE if "-lammps" in flow else 0
    theirs = strengths(options, paper, before, before + end) if paper else {}
    for name, estimate in own.items():
        row.update({name + at: value for at, value in zip(("", "_low", "_high", "_error", "_freedom"), estimate)})
    for name in ("B", "K", "p_star"):
        other = theirs.get(name, NO_FIT)
        row.update({f"{name}_paper{at}": value for at, value in zip(tables.ENDS, other)})
        error, freedom = tables.welch(own[name][3:], other[3:])
        row[f"less_{name}"] = own[name][0] - other[0]
        row[f"less_{name}_reach"] = NAN if math.isnan(error) else tables.student(freedom) * error
    beds = [of_bed(run) for run in runs]
    for name in beds[0]:
        row[name], row[name + "_reach"] = tables.mean_and_half_width([bed[name] for bed in beds])
    return row


def questions(options):
    """Writes results on questions that the paper leaves open: each flow with another choice, and the paper's over the same time.

    TABLES are folders of finished runs (make reproduce, make questions). There is one row per flow that has a B, and one row of
    all mixtures for each restitution. Layers are from 4 to 56 d_S (or the same distances from base and surface in a bed of
    another depth), windows are those of the tables. Intervals are 95 %, over runs if there are several, otherwise over windows.
    A comparison is over the time of the flow's own runs.
        B B_half_rule B_pressure   B by size, by half, and by size from the pressure
        B_fit                      B by size from the paper's logarithmic fit: half the sum of the end values
        p_star                     share at which B = 0, from ratios of sums
        K                          B_kappa, yy, half the sum of the end values, for fluctuations about the profile; K_instant and
                                   K_unbiased about the mean of layer and frame, K_middle with the velocity in the middle of the
                                   step; K_sums from ratios of sums
        B_all                      B by size over all heights
        B_paper K_paper            B and K of the flow with the paper's choice, over the same time; less_B less_K: differences
                                   with the interval of two independent sets of runs (Welch); B_error B_freedom: standard error
                                   and degrees of freedom of B, likewise for the other numbers
        yL_end trapped f_ratio     y_L/H, and number of large grains in the lowest layer, in the last window; f_L/f_S in the last
                                   15 s
        overlap rate               mean overlap over d_S; mean shear rate from 10 s on, units of sqrt(g/d_S)
    """
    runs = {}
    for folder in options.tables:
        for run in tables.runs_in(folder):
            if run.has("stress"):
                runs.setdefault(run.name, run)
    flows = tables.by_flow(runs.values())
    rows = []
    for flow, of_flow in flows.items():
        plain = "-".join(flow.split("-")[:2])
        rows.append(line(options, flow, of_flow, flows.get(plain, []) if of_flow[0].variant else []))
    for variant in ("e0.25", "e0.5"):
        long = f"{variant}-t150"  # longer runs, which replace shorter runs of the same mixture
        every = [run for flow, of_flow in flows.items() for run in of_flow
                 if run.variant == long or (run.variant == variant and f"{flow}-t150" not in flows)]
        if len(tables.by_flow(every)) > 1:
            rows.append({**line(options, f"mixtures-{variant}", every, []), "phi": NAN})
    tables.write(options.output, "questions", list(rows[0]), rows)


ACCURACIES = ("", "-draft-t150", "-reference-t150", "-finer-t150")


def rigid_limit(options):
    """Writes B, p* and B_kappa in the limit of rigid discs, extrapolated to zero overlap.

    Fits value = limit + k overlap^q to the rows FLOW (standard), FLOW-draft-t150, -reference-t150 and -finer-t150 of the table
    `questions`, by least squares weighted with the rows' errors. q is 1 (for an error in proportion to the overlap) and 1/2; a
    logarithm would have no limit. Intervals are 95 %, by Student's t with the smallest degrees of freedom of a row. chi2 is that
    of the fit, which has two degrees of freedom less than rows.
    """
    _, rows = tables.read(options.questions)
    chosen = [row for row in rows if row["flow"] in [options.flow + end for end in ACCURACIES] and not math.isnan(row["overlap"])]
    if len(chosen) < 3:
        sys.exit(f"rigid-limit: {options.questions}: {options.flow} was run with {len(chosen)} accuracies; three are needed")
    found = []
    for name in ("B", "p_star", "K"):
        weights = [1 / row[name + "_error"] ** 2 for row in chosen]
        t = tables.student(min(row[name + "_freedom"] for row in chosen))
        for power in (1, 0.5):
            level, slope, (of_level, _, of_slope), chi2 = tables.line(
                [row["overlap"] ** power for row in chosen], [row[name] for row in chosen], weights)
            de, ds = t * math.sqrt(of_level), t * math.sqrt(of_slope)
            found.append({"of": name, "power": power, "limit": level, "limit_low": level - de, "limit_high": level + de,
                          "k": slope, "k_low": slope - ds, "k_high": slope + ds, "chi2": chi2, "rows": len(chosen)})
    tables.write(options.output, "rigid-limit", list(found[0]), found)
