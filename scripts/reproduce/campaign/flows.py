"""Properties of each flow."""
import math

import tables

MEASURED = ("small", "large", "H0", "yL0", "yL1", "rate", "strain", "t50", "tau", "z_S", "z_L", "f_S",
            "f_L", "zf_S", "zf_L", "duration")


def of_segregation(run):
    header, bed, rate = tables.of_bed(run)
    value = {row["quantity"].split("[")[0]: row["value"] for row in tables.read(run.path("segregation-summary"))[1]}
    return {"H0": bed[0]["height"] / float(header["small_diameter"]), "yL0": bed[0]["yL"] / bed[0]["height"],
            "yL1": bed[-1]["yL"] / bed[-1]["height"], "rate": rate,
            "strain": bed[-1]["strain"], "t50": value["t50"], "tau": value["tau"],
            "step": float(header["step"]), "window": float(header["window"]),
            "frames": bed[-1]["frames"], "duration": bed[-1]["t1"]}


def of_contacts(options, run, duration):
    """Contacts per grain and forces in the whole bed, from 10 to 60 s, or from the second half of a run of less than 20 s."""
    _, rows = tables.program(options, "grseg-derive", run.path("micro"), "--pool",
                             "windows", "--begin", min(10, duration / 2), "--end", 60, "--quiet")
    bed = rows[-1]
    found = {"z_S": bed["z_S"], "z_L": bed["z_L"], "f_S": bed["f_weight_S"], "f_L": bed["f_weight_L"]}
    return {**found, **{f"zf_{s}": found[f"z_{s}"] * found[f"f_{s}"] for s in "SL"}}


def weight(runs):
    """Weight of these runs in B of several flows, as in grseg-fit: frames times phi_L phi_S, summed over the layers inside."""
    total = 0
    for run in runs:
        sums = tables.table(run.path("stress"))
        d, small, large = sums.number("small_diameter"), sums["area_S"], sums["area_L"]
        use = (4 * d < sums["y0"] + d / 2) & (sums["y1"] - d / 2 < 56 * d) & (0.01 * large <= small) & (small <= 100 * large) & (large > 0)
        total += (sums["frames"] * small * large)[use] @ (1 / (small + large)[use] ** 2)
    return total


def of_run(options, run):
    named, moving = run.record(), of_segregation(run)
    return {"program": named["program"], "small": named["grains_small"], "large": named["grains_large"], **moving,
            **of_contacts(options, run, moving["duration"])}


def fitted(fits, flow, quantity, stage, label):
    """B of one fit of the flow, with its interval, as {label, label_low, label_high}."""
    name = "paper_B" if quantity == "kinetic" else "B"
    row = next((row for row in fits if (row["set"], row["quantity"], row["stage"]) == (flow, quantity, stage) and row["component"] == "yy"
                and row["heights"] == "inside" and row["rule"] in ("size", "kinetic")), {})
    return {label + end: row.get(name + end, math.nan) for end in tables.ENDS}


def line(options, flow, runs, fits):
    values = [of_run(options, run) for run in runs]
    programs = sorted({value["program"] for value in values})
    row = {"flow": flow, "program": " and ".join(programs), "phi": runs[0].phi, "slope": runs[0].slope,
           "variant": runs[0].variant or "none", "seeds": len(runs), "step": values[0]["step"],
           "window": values[0]["window"], "frames": values[0]["frames"]}
    for name in MEASURED:
        row[name], row["hw_" + name] = tables.mean_and_half_width([each[name] for each in values])
    row["weight"] = weight(runs) if not runs[0].variant else math.nan
    for label, quantity, stage in (("B", "contact", "all"), ("B60", "contact", "early"),
                                   ("K", "kinetic", "all"), ("K60", "kinetic", "early")):
        row.update(fitted(fits, flow, quantity, stage, label))
    return row


def flows(options):
    """One row per flow: properties of its runs as means over seeds, and B.

    FITS is the table of `fits`. Columns are means over seeds, with half-widths of 95 % intervals
    (hw_..., Student's t over seeds; nan for one seed):
        small large   numbers of mobile grains
        H0            height of the bed in the first window, d_S
        yL0 yL1       y_L/H in the first and in the last window
        rate          mean shear rate from 10 s on, units of sqrt(g/d_S): slope of u(y) from 10 to 90 % of
                      the depth (grseg-segregation)
        strain        shear strain of the whole run; t50 and tau: times of y_L(t), s
        z_S z_L f_S f_L zf_S zf_L
                      in the whole bed from 10 to 60 s: contacts per grain, mean |f| over contacts in units of
                      m_S g (grseg-micro), and their product
        step window duration
                      time step, length of a window and of the run, s; frames: number of frames in a window; program:
                      simulator with its version
        weight        weight in a fit of several flows: frames times phi_L phi_S, over all layers inside
    B_... and K_... are B by size and B_kappa by the paper's fit (yy, inside), for all times; B60 and K60 for the first 60 s.
    """
    _, fits = tables.read(options.fits)
    rows = [line(options, flow, runs, fits) for flow, runs in tables.by_flow(tables.runs_in(options.tables)).items()]
    tables.write(options.output, "flows", list(rows[0]), rows)
