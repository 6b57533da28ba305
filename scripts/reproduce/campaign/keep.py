"""Makes and unpacks the archive data/reproduction/tables.tar.bz2: small copies of a campaign's tables."""
import io
import math
import os
import re
import shutil
import sys
import tarfile
import time

import tables
from tables import shared

KEYS = ("t0", "t1", "y0", "y1", "frames", "V")
# Length of the archived windows, s; whole multiples of the windows in the tables.
WINDOW = {"micro": 5, "balance": 7.5}
# Significant digits. Stresses of the paper's flows have fewer, because they scatter more from layer to layer.
DIGITS = 3
STRESS_DIGITS = {"stress": 2, "stress-random": 2, "kinetic": 2}
# Columns that are archived besides KEYS, as regular expressions.
STRESS = "(area|volume)_(.|v2)|(A_SS|A_LL|M|Msize|A_Sb|A_Lb)_(xx|yy|zz)"
COLUMNS = {
    "stress": STRESS + "|(Mcp|F_Sb|F_Lb)_yy", "stress-random": STRESS, "kinetic": "mass_.|grains_.|K_._(xx|yy|zz)",
    "micro": STRESS + "|grains_.|ends_.|(n|sum_f|sum_fn)_..|base_f.|yL|yS|height",
    "balance": "gravity_L_y|push|push_kinetic|drag", "segregation": "yL|height|shear_rate|strain",
}
# The figures of profiles and balance show one flow; the snapshots show its first seed.
DRAWN = "phi0.30-s23"
DRAWN_COLUMNS = {
    "kinetic": "|layer_bias_._(xx|yy)",
    "balance": "|(rate|gravity|contact|kinetic|interaction|base|residual)_._.|rho_L|phi_L|psik?_L|scatter|drift",
}
# Tables that grseg's programs read; a line "# not kept: ..." names the columns that are missing on purpose.
READ_AGAIN = ("stress", "stress-random", "micro")
OF_PLAIN = ("stress", "kinetic", "micro", "balance", "segregation")
OF_VARIANTS = ("micro", "segregation")  # choices.tsv includes the other results of variants
OF_CONTROL = ("stress-random",) + OF_VARIANTS
# Tables of the runs of `make questions`, if they exist. Their windows are longer, which does not change ratios of sums, and
# include the flux by layer.
OF_QUESTIONS = ("stress", "stress-random", "kinetic", "kinetic-instant", "kinetic-unbiased", "kinetic-middle", "kinetic-unbiased-middle",
                "micro", "segregation", "balance-rules")
COLUMNS["balance-rules"] = r"gravity_L_y|phi_L|B_kappa|push\S*|drag\S*|N_L_y|p_zero"
QUESTION_WINDOW = 5  # length of their windows, s
# Tables of a sweep of spheres (docs/studies/three-dimensions.md), which are reduced like those of `make questions`.
OF_SPHERES = ("stress", "stress-branch-1dS", "kinetic-2dS", "micro-2dS", "segregation")
COLUMNS["flux"] = COLUMNS["segregation"] + r"|(area|volume)_.|mass_.|phi_L|q_L|q_L_error|D|dphi_dy|dphi_dy_error|mvv_._yy|gain_._y"
# Columns whose mean is over the windows in which the layer has grains; in other columns a missing layer counts as 0.
OF_PRESENT = ("phi_L", "q_L", "q_L_error", "D", "dphi_dy", "dphi_dy_error", "shear_rate", "B_kappa", "p_zero")
WHOLE = ("segregation-summary", "record")


def numbers_of(path):
    """Header lines, column names with units, and rows of numbers."""
    head, names, rows = shared.lines_of(path)
    return head, names, [[float(cell) for cell in row] for row in rows]


def coarse(rows, window, at, errors=(), of_present=()):
    """Merges the rows of each longer window and layer into means weighted by frames. at(name) is the index of a column.
    `errors` are the columns of independent errors; `of_present` are the columns of OF_PRESENT."""
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
    """Text of snapshots.tsv with four digits for positions and three for radii."""
    head, names, rows = numbers_of(run.path("snapshots"))
    lines = [f"{t:g}\t{species:g}\t{x:.4g}\t{y:.4g}\t{r:.3g}" for t, species, x, y, r in rows]
    return "\n".join(head + ["\t".join(names)] + lines) + "\n"


def without_folders(text):
    """The table with file names without folders in its history."""
    return shared.changed(text, r"(?m)^(# history: .*)$", lambda line: re.sub(r"(?<=\s)/\S*/", "", line[0]))


def runs_of_sweep(folder):
    """The finished runs of a sweep (scripts/sweep) over phi-large and seed, with the names of the campaign: phi0.30-s26-seed1."""
    _, (_, _, *keys), rows = shared.lines_of(os.path.join(folder, "runs.tsv"))
    found = []
    for name, _, *values in rows:
        if os.path.exists(os.path.join(folder, name, "checksums")):
            of, (header, _) = dict(zip(keys, values)), tables.read(os.path.join(folder, name, "stress.tsv"))
            slope = math.degrees(math.atan2(float(header["gravity_x"]), -float(header["gravity_y"])))
            match = tables.NAME.match(f"phi{float(of['phi-large']):.2f}-s{slope:.4g}-seed{of['seed']}")
            run = tables.Run(folder, match[0], match)
            run.path = lambda table, of=name: os.path.join(folder, of, f"{table}.tsv")
            found.append(run)
    return found


def files_of(run, options):
    question = options.questions or options.spheres
    kept = OF_SPHERES if options.spheres else OF_QUESTIONS if question else {"": OF_PLAIN, tables.CONTROL: OF_CONTROL}.get(run.variant, OF_VARIANTS)
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
    """Writes the tables of a campaign into an archive that is small enough for the repository.

    The archive includes, for every finished run, the columns that figures and fits of the document need (COLUMNS). Numbers
    have two or three digits. Windows are merged (WINDOW) into means weighted by frames; a layer that is missing in a window
    counts as empty. The same tables give the same bytes. make -C scripts reproduction.md reads the archive.
    --questions: archives instead the runs of `make questions` and of the second program (LAMMPS), with all columns that
    questions, stages and mixtures read.
    --spheres: archives a sweep over phi-large and seed instead (docs/studies/three-dimensions.md).
    """
    part = options.archive + ".part"
    runs = runs_of_sweep(options.tables) if options.spheres else tables.runs_in(options.tables)
    with tarfile.open(part, "w:bz2") as archive:
        # Similar files are stored together, for compression.
        files = sorted((name, run.name, without_folders(text)) for run in runs
                       for name, text in files_of(run, options))
        for name, run, text in files:
            entry = tarfile.TarInfo(f"{run}/{name}")
            entry.size = len(text.encode())
            archive.addfile(entry, io.BytesIO(text.encode()))
    os.replace(part, options.archive)


def unpack(options):
    """Unpacks the tables of the archive in the folder KEPT into FOLDER, unless FOLDER is newer than the archive. The files have
    the present time, so that make sees that they have changed."""
    archive, mark = os.path.join(options.kept, "tables.tar.bz2"), os.path.join(options.folder, "unpacked")
    if not os.path.isfile(archive):
        sys.exit(f"unpack: {archive}: no such file; name the folder with tables.tar.bz2")
    if os.path.exists(mark) and os.path.getmtime(mark) > os.path.getmtime(archive):
        return
    if os.path.exists(options.folder):
        shutil.rmtree(options.folder)
    with tarfile.open(archive) as kept:
        for entry in kept.getmembers():
            entry.mtime = time.time()
        kept.extractall(options.folder)
    open(mark, "w").close()
