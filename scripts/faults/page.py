"""Faults in the page of grseg-explore: in its data, in its computations, and in its display."""
import os
import re

from copy_of_sources import run_quietly

PAGE = "analysis/explore/page/"
FAULTS = [
    # The algebra of the page.
    ("shares: of uniform:p what is left goes to the large grain", PAGE + "partition.js",
     "(1 - p) * none[k] + p * all[k]", "p * none[k] + (1 - p) * all[k]"),
    ("shares: power of the inverse ratio", PAGE + "partition.js", "1 / (1 + ratio ** -Q)", "1 / (1 + ratio ** Q)"),
    ("shares: power:Q without the halves at the ends of the nodes", PAGE + "partition.js",
     "k === nodes.length - 1 ? 0.5 : 1", "k === nodes.length - 1 ? 1 : 1"),
    ("B: windows without their frames", PAGE + "partition.js", "excess += frames[k] * (", "excess += ("),
    ("neutral contacts: the small grain's share", PAGE + "partition.js", "(p - r / (1 + r)) * (1 + r)",
     "(p - 1 / (1 + r)) * (1 + r)"),
    ("share of a rule: over B at p = 1 alone", PAGE + "partition.js", "/ (at - before);", "/ at;"),
    ("band: the other end of the step", PAGE + "partition.js", "(t * (c - a)) / 2", "(t * (a - c)) / 2"),
    # Frames and contacts.
    ("contacts: numbers of grains are not added up", PAGE + "frames.js", "grain += i[from + k];", "grain = i[from + k];"),
    ("contacts: without the nearest image", PAGE + "frames.js",
     "      if (periodic) xj += length * Math.round((x - xj) / length);\n", ""),
    ("contacts: forces from another frame", PAGE + "frames.js",
     "bounds.along.from + along[from + k] * bounds.along.step", "bounds.along.from + along[k] * bounds.along.step"),
    ("positions: heights by the bounds of x", PAGE + "frames.js", 'this.#decoded("y", this.arrays.y', 'this.#decoded("x", this.arrays.y'),
    ("walls: the foot on the other side", PAGE + "frames.js", "[x - away * nx, y - away * ny]", "[x + away * nx, y + away * ny]"),
    ("mixed contacts: the small grain gets the large one's stretch", PAGE + "player.js",
     "at: iLarger ? share : 1 - share", "at: iLarger ? 1 - share : share"),
    ("mixed contacts: by size, the small grain's radius", PAGE + "player.js", "return large / (large + small);",
     "return small / (large + small);"),
    ("base: contacts with it count whole", PAGE + "player.js", "return j < 0 ? 1 : radius[i] / (radius[i] + radius[j]);", "return 1;"),
    ("clicks: the grain at the mirrored height", PAGE + "player.js", "this.height - (y - this.frames.low[1]) * this.scale",
     "(y - this.frames.low[1]) * this.scale"),
    ("a grain: stress of its contacts without what acts across", PAGE + "grain.js",
     "contacts.along[k] * ey + contacts.across[k] * ex", "contacts.along[k] * ey"),
    ("a grain: what acts across it, the other way round", PAGE + "grain.js",
     "contacts.along[k] * ey + contacts.across[k] * ex", "contacts.along[k] * ey - contacts.across[k] * ex"),
    ("a grain: it gets the other one's part", PAGE + "grain.js", "part += contact.stress * (contact.larger ? p : 1 - p);",
     "part += contact.stress * (contact.larger ? 1 - p : p);"),
    ("a grain: branches of contacts in which it is second point the wrong way", PAGE + "grain.js",
     "const side = first ? 1 : -1;", "const side = 1;"),
    ("scatter: the shares upside down", PAGE + "scatter.js", "this.ratio = phi_large.map((phi) => (1 - phi) / phi);",
     "this.ratio = phi_large.map((phi) => phi / (1 - phi));"),
    ("scatter: the curve of equal B without its denominator", PAGE + "scatter.js", "(r * (1 - B * phi)) / (1 + B * (1 - phi))",
     "r * (1 - B * phi)"),
    ("scatter: the window before the one that plays", PAGE + "scatter.js", "state.time >= begin && state.time < end",
     "state.time > begin && state.time <= end"),
    ("profiles: small and large exchanged", PAGE + "profiles.js", ".x((k) => x(means[name][k]))",
     '.x((k) => x(means[{small: "large", large: "small"}[name] ?? name][k]))'),
    ("profiles: B of a layer from the points of all", PAGE + "profiles.js", "sumsOf(fit, stress, layer.own)", "sumsOf(fit, stress)"),
    ("marks: codes at the share p of their rule, with B of the rule that is chosen", PAGE + "share.js",
     "B: fitOf(fit, own).B}", "B: fitOf(fit, state.rule).B}"),
    ("command: the rule that it names is not the one shown", PAGE + "share.js",
     "--partition ${ruleName(rule)}${pair}", "--partition size${pair}"),
    # Texts, colours and address of the page.
    ("colours: canvases keep theirs when the system turns dark", PAGE + "main.js",
     'addEventListener("change", recolour)', 'addEventListener("change", forgetColours)'),
    ("colours: of a tab that is not shown they stay", PAGE + "main.js",
     "const recolour = () => {", 'const recolour = () => {\n    if (byId("explore").hidden) return;'),
    ("address: of a link to several runs the first is shown", PAGE + "address.js", "if (page.fits[run])", "if (false)"),
    ("captions: a line without its piece", PAGE + "report.js",
     '["z_S", "small", "small grains"], ["z_L", "large", "large grains"]', '["z_S", "small", "small grains"], ["z_L", "large"]'),
    ("captions: a look that nothing is drawn in", PAGE + "scatter.js", '["neutral", "equal shares"]', '["zero", "equal shares"]'),
    ("numbers: two that differ read alike", PAGE + "format.js", "?? written[0]", "&& written[0]"),
    ("address: the time is not in it", PAGE + "address.js", "if (Number.isFinite(time)) page.transport", "if (!time) page.transport"),
    ("address: each choice is a step to go back by", PAGE + "address.js", "window.history.replaceState", "window.history.pushState"),
    # Data of the page.
    ("codes: rounded down", "analysis/explore/player_data.hpp", "std::round((value - from()) / step())",
     "std::floor((value - from()) / step())"),
    ("codes: a step too few", "analysis/explore/player_data.hpp", "return (to() - from()) / last;", "return (to() - from()) / none;"),
    ("pairs: the first grain of a frame counted from the last of the one before", "analysis/explore/player_data.cpp",
     "    std::int32_t before = 0;\n", "    static std::int32_t before = 0;\n"),
    ("forces: 0 need not lie between the bounds", "analysis/explore/player_data.cpp", "const Quantisation zero(0, 0);",
     "const Quantisation zero;"),
    ("tables by layer: windows without their frames", "analysis/explore/layer_tables.cpp",
     "means[k].sum += weight * values[k];", "means[k].sum += values[k];"),
    ("tables by layer: mixed contacts by the components across", "analysis/explore/layer_tables.cpp",
     "sums.of(PairSum::whole, pair)(1, 1)", "sums.of(PairSum::whole, pair)(0, 0)"),
]
ARGUED = set()
LIBRARY = "grseg_explore"
FOLDER = "analysis/explore"  # folder of the library
TOOLS = ["explore", "report", "stress", "kinetic", "micro", "balance", "segregation", "fit", "check", "sim", "import"]
TARGETS = [f"grseg-{tool}" for tool in TOOLS] + ["analysis_explore_test"]
OPTIONS = ["-DCMAKE_CXX_FLAGS_RELEASE=-O1"]


def in_the_browser(copy):
    """Name of the failing check of the page's test, or its last line of output; [] if the test passes."""
    copy.must_build(TARGETS)
    done = run_quietly(["/usr/bin/python3", "-B", f"{copy.tree}/tests/tools/explore_page_test.py", copy.bin,
                        f"{copy.tree}/data/sample/chute.h5", "all"])
    if done.returncode == 77:
        raise SystemExit(done.stdout)
    checks = re.findall(r"in (check_\w+)", done.stdout)
    return [] if done.returncode == 0 else [checks[0] if checks else done.stdout.strip().splitlines()[-1][:80]]


def noticed(copy, _):
    return {"near": copy.failures("analysis_explore_test", 60), "far": in_the_browser(copy)}


def sound(copy):
    return copy.failures("analysis_explore_test", 60) + in_the_browser(copy)


def table(results):
    yield "| what is broken | file | in tests/analysis | in the browser |"
    yield "|---|---|---|---|"
    for r in results:
        near = ", ".join(f"`{name}`" for name in r["near"][:2]) or "none"
        far = ", ".join(f"`{name}`" for name in r["far"]) or "none"
        yield f"| {r['what']} | {os.path.basename(r['file'])} | {near} | {far} |"
