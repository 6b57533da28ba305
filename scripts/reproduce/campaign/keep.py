"""Tables of a campaign as they are kept beside the code."""
import io
import math
import os
import re
import shutil
import sys
import tarfile

import tables
from tables import shared

KEYS = ("t0", "t1", "y0", "y1", "frames", "V")
# Length of the kept windows, s: whole multiples of those in the tables.
WINDOW = {"micro": 5, "balance": 7.5}
# Significant digits; of the paper's flows fewer for stresses, which scatter more from layer to layer.
DIGITS = 3
STRESS_DIGITS = {"stress": 2, "stress-random": 2, "kinetic": 2}
# The columns that are kept beside KEYS, as regular expressions.
STRESS = "area_.|(A_SS|A_LL|M|Msize|A_Sb|A_Lb)_(xx|yy)"
COLUMNS = {
    "stress": STRESS + "|(Mcp|F_Sb|F_Lb)_yy", "stress-random": STRESS, "kinetic": "mass_.|grains_.|K_._(xx|yy)",
    "micro": STRESS + "|grains_.|ends_.|(n|sum_f|sum_fn)_..|base_f.|yL|yS|height",
    "balance": "gravity_L_y|push|push_kinetic|drag", "segregation": "yL|height|shear_rate|strain",
}
# The figures of profiles and balance show one flow, the snapshots its first seed.
DRAWN = "phi0.30-s23"
DRAWN_COLUMNS = {
    "kinetic": "|layer_bias_._(xx|yy)",
    "balance": "|(rate|gravity|contact|kinetic|interaction|base|residual)_._.|rho_L|phi_L|psik?_L|scatter|drift",
}
# grseg's programs read these, and must know which columns are missing on purpose.
READ_AGAIN = ("stress", "stress-random", "micro")
OF_PLAIN = ("stress", "kinetic", "micro", "balance", "segregation")
OF_VARIANTS = ("micro", "segregation")  # their other results are in the choices
OF_CONTROL = ("stress-random",) + OF_VARIANTS
# Tables of the questions' runs, where they exist; in longer windows, which do not change ratios of sums, and with the flux of layers.
OF_QUESTIONS = ("stress", "stress-random", "kinetic", "kinetic-instant", "kinetic-unbiased", "kinetic-middle", "kinetic-unbiased-middle",
                "micro", "segregation", "balance-rules")
COLUMNS["balance-rules"] = r"gravity_L_y|phi_L|B_kappa|push\S*|drag\S*|N_L_y|p_zero"
QUESTION_WINDOW = 5  # s
COLUMNS["flux"] = COLUMNS["segregation"] + r"|area_.|mass_.|phi_L|q_L|q_L_error|D|dphi_dy|dphi_dy_error|mvv_._yy|gain_._y"
# Means over the windows in which the layer holds grains; of all others a layer that is missing counts as empty.
OF_PRESENT = ("phi_L", "q_L", "q_L_error", "D", "dphi_dy", "dphi_dy_error", "shear_rate", "B_kappa", "p_zero")
WHOLE = ("segregation-summary", "record")


def numbers_of(path):
    """Lines before the rows, column names with units, rows of numbers."""
    head, names, rows = shared.lines_of(path)
    return head, names, [[float(cell) for cell in row] for row in rows]


def coarse(rows, window, at, errors=(), of_present=()):
    """Merges the rows of each coarse window and layer; `at` gives the index of a column, `errors` are columns of
    independent errors, `of_present` of means over the windows that have the layer."""
    t0, t1, y0, frames = (at(name) for name in ("t0", "t1", "y0", "frames"))
    groups, total, first, end = {}, {}, {}, {}
    begin = min(row[t0] for row in rows)
    for row in rows:
        k = int(((row[t0] + row[t1]) / 2 - begin) / window)
        y = None if math.isnan(row[y0]) else row[y0]
        groups.setdefault((k, y), []).append(row)
        total.setdefault(k, {})[row[t0]] = row[frames]
        first[k], end[k] = min(first.get(k, row[t0]), row[t0]), max(end.get(k, row[t1]), row[t1])
    means = []
    for (k, _), group in sorted(groups.items(), key=lambda item: (item[0][0], item[0][1] is None,
                                                                  item[0][1] or 0)):
        n, present = sum(total[k].values()), sum(each[frames] for each in group)
        over = [present if c in of_present else n for c in range(len(group[0]))]
        row = [sum(each[frames] * each[c] for each in group) / of for c, of in enumerate(over)]
        for c in errors:
            row[c] = math.sqrt(sum((each[frames] * each[c]) ** 2 for each in group)) / over[c]
        for c in (y0, at("y1"), at("V")):
            row[c] = group[0][c]
        row[t0], row[t1] = first[k], end[k]
        row[frames] = n
        means.append(row)
    return means


def small_table(run, table, question=False):
    head, names, rows = numbers_of(run.path(table))
    plain = [name.split("[")[0] for name in names]
    quantity = table if table in COLUMNS else table.split("-")[0]
    wanted = COLUMNS["flux" if question and quantity == "segregation" else quantity]
    wanted += DRAWN_COLUMNS.get(quantity, "") if run.flow == DRAWN else ""
    kept = [name in KEYS or bool(re.fullmatch(wanted, name)) for name in plain]
    if quantity == "segregation" and not question:
        rows = [row for row in rows if math.isnan(row[plain.index("y0")])]
    window = QUESTION_WINDOW if question else WINDOW.get(quantity)
    if window:
        errors = [c for c, name in enumerate(plain) if name.endswith("_error")]
        of_present = [c for c, name in enumerate(plain) if name in OF_PRESENT]
        rows = coarse(rows, window, plain.index, errors, of_present)
        head = [f"# window: {window:g}" if line.startswith("# window:") else line for line in head]
    digits = [9 if name in KEYS else STRESS_DIGITS.get(quantity, DIGITS) if ("_yy" in name or "_xx" in name) and not question
              else DIGITS for name in plain]
    head.append(f"# kept: {min(digits)} digits")
    chosen = [k for k in range(len(names)) if kept[k]]
    if quantity in READ_AGAIN:
        head.append("# not kept: " + " ".join(name for k, name in enumerate(plain) if not kept[k]))
    lines = [[names[k] for k in chosen]] + [[f"{row[k]:.{digits[k]}g}" for k in chosen] for row in rows]
    return shared.sealed("\n".join(head + ["\t".join(line) for line in lines]) + "\n")


def snapshots(run):
    """Positions with four digits, radii with three."""
    head, names, rows = numbers_of(run.path("snapshots"))
    lines = [f"{t:g}\t{species:g}\t{x:.4g}\t{y:.4g}\t{r:.3g}" for t, species, x, y, r in rows]
    return "\n".join(head + ["\t".join(names)] + lines) + "\n"


def without_folders(text):
    """Removes folders from the file names in the history."""
    return shared.changed(text, r"(?m)^(# history: .*)$", lambda line: re.sub(r"(?<=\s)/\S*/", "", line[0]))


def files_of(run, question):
    kept = OF_QUESTIONS if question else {"": OF_PLAIN, tables.CONTROL: OF_CONTROL}.get(run.variant, OF_VARIANTS)
    for table in (*kept, *WHOLE):
        if question and not run.has(table):
            continue
        if table in WHOLE:
            with open(run.path(table)) as whole:
                yield table + ".tsv", whole.read()
        else:
            yield table + ".tsv", small_table(run, table, question)
    if run.flow == DRAWN and run.seed == 1 and not question:
        yield "snapshots.tsv", snapshots(run)
    yield "checksums", "kept\n"


def keep(options):
    """Tables of a campaign made small enough to be kept beside the code: fewer digits, columns and windows.

    --questions: the runs of `make questions` and of the second program instead of the paper's, and all that
    questions, stages and mixtures read of them.
    Of every finished run the archive holds what the figures and fits of the document need (COLUMNS): numbers with
    two or three digits, windows merged (WINDOW) as means weighted by frames, where a layer that is missing in a window
    counts as empty. The same tables give the same bytes. make -C scripts reproduction.md reads them.
    """
    part = options.archive + ".part"
    with tarfile.open(part, "w:bz2") as archive:
        # Similar files are stored together, for compression.
        files = sorted((name, run.name, without_folders(text)) for run in tables.runs_in(options.tables)
                       for name, text in files_of(run, options.questions))
        for name, run, text in files:
            entry = tarfile.TarInfo(f"{run}/{name}")
            entry.size = len(text.encode())
            archive.addfile(entry, io.BytesIO(text.encode()))
    os.replace(part, options.archive)


def unpack(options):
    """Unpacks the tables of the archive in KEPT into FOLDER, unless that is up to date."""
    archive, mark = os.path.join(options.kept, "tables.tar.bz2"), os.path.join(options.folder, "unpacked")
    if not os.path.isfile(archive):
        sys.exit(f"unpack: {archive}: no such file")
    if os.path.exists(mark) and os.path.getmtime(mark) > os.path.getmtime(archive):
        return
    shutil.rmtree(options.folder, ignore_errors=True)
    with tarfile.open(archive) as kept:
        kept.extractall(options.folder)
    open(mark, "w").close()
