"""Questions that the paper leaves open, flow by flow, and in the limit of rigid discs."""
import math
import re
import sys

import tables
import grseg

NAN = math.nan
FLOW_BEFORE = 10  # s of the paper's flow before the state from which another program continues (open-questions.md)


NO_FIT = (NAN,) * 5


def fitted(options, runs, quantity, column, *words, table=None):
    """Value, interval, standard error and degrees of freedom of a number of grseg-fit of all these runs; nan where it
    cannot be told. Of several mixtures it is B of these flows, weighted as they are."""
    table = table or {"contact": "stress", "kinetic": "kinetic"}[quantity]
    if not runs or not all(run.has(table) for run in runs):
        return NO_FIT
    words = [*words, *tables.sizes_of(runs), *(["--over", "flows"] if len(tables.by_flow(runs)) > 1 else [])]
    rows = tables.fits_if_any(options, f"questions: {runs[0].flow}", *(run.path(table) for run in runs), "--quantity", quantity, "--quiet",
                              "--bootstrap", options.bootstrap, *words)
    if not rows:
        return NO_FIT
    if len(rows) != 1:
        sys.exit(f"questions: {runs[0].flow}: grseg-fit printed {len(rows)} rules where one was asked for")
    value, low, high = (rows[0][column + end] for end in tables.ENDS)
    freedom = rows[0]["degrees_of_freedom"]
    freedom = 1e9 if math.isnan(freedom) else freedom
    return value, low, high, (high - low) / 2 / tables.student(freedom), freedom


def inside(run):
    """4 to 56 d_S of a bed of 60 d_S; of another the same distances from base and surface."""
    depth = re.search(r"depth(\d+)dS", run.flow)
    return ["--heights", f"4dS:{int(depth[1]) - 4 if depth else 56}dS"]


def strengths(options, runs, begin, end):
    """Everything that grseg-fit tells of these runs between two times."""
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
    """y_L/H and the large grains of the lowest layer in the last window, the mean shear rate."""
    found = {"yL_end": NAN, "trapped": NAN, "rate": NAN, "overlap": NAN, "f_ratio": NAN}
    sums = grseg.read_table(run.path("stress"))
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
    """Mean |f| of the contacts of large grains over the mean of small ones, whole bed, last 15 s; a mixed contact counts for both."""
    sums = grseg.read_table(run.path("micro"))
    late = sums["t1"] > sums["t1"][-1] - 15
    of = lambda name, s: sum(sums[f"{name}_{pair}"][late].sum() for pair in (s + s, "LS", s + "b"))
    return of("sum_f", "L") / of("n", "L") / (of("sum_f", "S") / of("n", "S"))


def line(options, flow, runs, paper):
    end = min(grseg.read_table(run.path("stress"))["t1"][-1] for run in runs)
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
    """Questions that the paper leaves open: each flow with another choice beside the paper's, over the same time.

    TABLES are folders of finished runs (make reproduce, make questions). One row per flow that has
    a B, and one of all mixtures for each restitution; layers from 4 to 56 d_S (the same part of a bed of another depth), windows from the tables. Intervals are 95 %, over runs if there are several,
    else over windows. A comparison covers the time of the flow's own runs.
        B B_half_rule B_pressure   by size, by half, by size from the pressure
        B_fit                      by size from the paper's logarithmic fit, at phi = 1/2
        p_star                     the share at which B = 0, by sums
        K                          B_kappa, yy, half the sum of the end values, fluctuations about the profile; K_instant, K_unbiased about the
                                   mean of layer and frame, K_middle with the velocity of the middle of the step; K_sums by sums
        B_all                      B by size over all heights
        B_paper K_paper            the same of the flow with the paper's choice, over the same time; less_B less_K: differences
                                   with the interval of two independent sets of runs (Welch); B_error B_freedom: standard error and
                                   degrees of freedom of B, likewise of the others
        yL_end trapped f_ratio     y_L/H in the last window; large grains in the lowest layer then; f_L/f_S of the last 15 s
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
        long = f"{variant}-t150"  # counts instead of a shorter run of the same mixture
        every = [run for flow, of_flow in flows.items() for run in of_flow
                 if run.variant == long or (run.variant == variant and f"{flow}-t150" not in flows)]
        if len(tables.by_flow(every)) > 1:
            rows.append({**line(options, f"mixtures-{variant}", every, []), "phi": NAN})
    tables.write(options.output, "questions", list(rows[0]), rows)


ACCURACIES = ("", "-draft-t150", "-reference-t150", "-finer-t150")


def rigid_limit(options):
    """B, p* and B_kappa in the limit of rigid discs: extrapolated to no overlap.

    The rows of `questions` FLOW (standard), FLOW-draft-t150, -reference-t150 and -finer-t150 are
    fitted by value = limit + k overlap^q, by least squares weighted with the rows' errors, for q = 1 (the error of a contact
    law that is soft by its overlap) and q = 1/2; a logarithm would not have a limit. Intervals are 95 %, by Student's t with the fewest
    degrees of freedom that a row has. chi2 is of the fit, with the number of rows less two degrees of freedom.
    """
    _, rows = tables.read(options.questions)
    chosen = [row for row in rows if row["flow"] in [options.flow + end for end in ACCURACIES] and not math.isnan(row["overlap"])]
    if len(chosen) < 3:
        sys.exit(f"rigid-limit: {options.questions}: {len(chosen)} of the accuracies of {options.flow} were run; three are needed")
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
