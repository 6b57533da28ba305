#!/usr/bin/python3
"""The page of grseg-explore in a browser: it opens from disk without an error message, shows B as
grseg-fit prints it, plays, reacts to slider, keys and clicks, and fits the screen of a phone.
Usage: explore_page_test.py BIN RUN.h5 short|all [FOLDER-FOR-PICTURES]
Exit code 77, test skipped, if Chromium or selenium is missing.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zlib

import h5py
import numpy as np

DRIVER = shutil.which("chromedriver")
try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = None
if webdriver is None or DRIVER is None or not (shutil.which("chromium") or shutil.which("google-chrome")):
    print("skipped: needs the Debian packages chromium-driver and python3-selenium")
    sys.exit(77)

BIN, RUN = map(os.path.abspath, sys.argv[1:3])
ALL = sys.argv[3] == "all"
PICTURES = os.path.abspath(sys.argv[4]) if len(sys.argv) > 4 else None
FOLDER = tempfile.TemporaryDirectory()  # removed at the end of the script
os.chdir(FOLDER.name)
DESK, PHONE = (1280, 900), (390, 844)
PROFILE = "profile"


ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")


def tool(name, *words):
    return subprocess.run([f"{BIN}/grseg-{name}", *words], check=True, capture_output=True, text=True).stdout


def close(a, b, what, tolerance=1e-9):
    assert abs(a - b) <= tolerance * max(1, abs(b)), f"{what}: {a} on the page, {b} by grseg-fit"


class Page:
    """A page in headless Chromium; at its end, asserts that the browser has logged no error."""

    def __init__(self, path, size=DESK, link=""):
        options = webdriver.ChromeOptions()
        for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                     f"--user-data-dir={os.path.abspath(PROFILE)}"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = webdriver.chrome.service.Service(DRIVER)
        self.driver = webdriver.Chrome(service=service, options=options)
        self.resize(*size)
        self.driver.get("file://" + os.path.abspath(path) + link)
        self.until("document.documentElement.dataset.ready || document.getElementById('trouble').textContent")
        assert self.text("trouble") == "", self.text("trouble")

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        said = self.driver.get_log("browser")
        self.driver.quit()
        if kind is None:
            assert said == [], said

    def run(self, script, *values):
        return self.driver.execute_script(script, *values)

    def until(self, condition, seconds=30):
        end = time.time() + seconds
        while not self.run(f"return Boolean({condition})"):
            assert time.time() < end, f"never came true: {condition}; {self.driver.get_log('browser')}"
            time.sleep(0.02)

    def resize(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})

    def settle(self):
        """Waits for two repaints of the browser, so that changes are drawn."""
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))")

    def text(self, name):
        return self.run("return document.getElementById(arguments[0]).textContent", name)

    def keys(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()
        self.settle()

    def dark(self, is_dark):
        """Sets the colour scheme of the system."""
        mode = "dark" if is_dark else "light"
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": mode}]})
        self.settle()

    def shoot(self, name):
        if PICTURES:
            os.makedirs(PICTURES, exist_ok=True)
            self.driver.save_screenshot(f"{PICTURES}/{name}.png")


def numbers_in(text):
    """Results of grseg-fit --json for each rule, over all flows together: {rule: {quantity: row}}"""
    found, flow = {}, {}
    for row in json.loads(text)["numbers"]:
        if flow.get(row["rule"]) != row["flow"]:  # the rows of all flows are last
            found[row["rule"]], flow[row["rule"]] = {}, row["flow"]
        found[row["rule"]].setdefault(row["quantity"], row)  # the first row has the interval that was asked for
    return found


def fitted(*words):
    return numbers_in(tool("fit", *words, "--json", "--quiet"))


def check_b(page):
    """B at ten shares, under three rules, and under power:Q at six Q."""
    rules = [f"uniform:{p}" for p in (0.05, 0.2, 0.35, 0.45, 0.5, 0.6, 0.648, 0.66667, 0.8, 1)]
    expected = fitted("sums.tsv", "--partition", ",".join(rules + ["size", "contact-point", "half"]))
    for Q in (0, 0.37, 1, 2, 3.3, 4):
        tool("stress", RUN, "--partition", f"power:{Q}", "--quiet", "-o", f"power{Q}.tsv")
        expected.update(fitted(f"power{Q}.tsv", "--partition", f"power:{Q}"))
    largest = 0
    common = expected.pop("-")
    for rule, numbers in expected.items():
        shown = page.run("return grseg.fit(0, arguments[0])", rule)
        for name in ("B", "share"):
            close(shown[name], numbers[name]["value"], f"{name} by {rule}")
        largest = max(largest, abs(shown["B"] - numbers["B"]["value"]))
        assert shown["points"] == common["points"]["value"], rule
    assert page.run("return grseg.fit(0, 'drop')")["B"] is None, "drop has no B"
    print(f"B of {len(expected)} rules: largest difference from grseg-fit {largest:.1e}")


def check_band(page):
    """The band and the intervals equal those of grseg-fit."""
    lines = tool("fit", "sums.tsv", "--scan", "0:1:0.01", "--quiet").splitlines()
    rows = [line.split("\t") for line in lines if not line.startswith("#")]
    at = {name: k for k, name in enumerate(rows[0])}
    scan = page.run("return grseg.content.runs[0].fit.scan")
    for k, row in enumerate(rows[1:]):
        for side, column in enumerate(("B", "low", "high")):
            assert scan["B"][k][side] == float(row[at[column]]), row[0]
    header = dict(re.findall(r"^# (\S+): (\S+)$", "\n".join(lines), re.MULTILINE))
    zero = float(header["p_zero"])
    for side, name in enumerate(("p_zero", "p_zero_low", "p_zero_high")):
        assert scan["p_zero"][side] == float(header[name]), name
    page.keys("0")
    close(page.run("return grseg.state.rule.value"), zero, "p*")
    assert page.text("b-value") in ("0.000", "−0.000"), page.text("b-value")
    page.keys("3")
    row = fitted("sums.tsv", "--partition", "half")["half"]["B"]
    number = lambda value: f"{value:.3f}".replace("-", "−")
    assert page.text("b-value") == number(row["value"]), page.text("b-value")
    assert page.text("b-interval") == "[{}, {}] (95 %)".format(*(number(row[end]) for end in ("low", "high"))), page.text("b-interval")


def check_interval_between(page):
    """At any share, also between those of the band, the page shows the interval that grseg-fit prints; a rule that grseg-fit was not asked for has the interval at its share."""
    shares = (0.003, 0.31, 0.6075, 0.641234, 0.666667, 0.9, 0.9999)
    expected = fitted("sums.tsv", "--partition", ",".join(f"uniform:{p}" for p in shares))
    for p in shares:
        row = expected[f"uniform:{p}"]["B"]
        low, high = page.run("return grseg.interval(0, arguments[0]).interval", f"uniform:{p}")
        for own, end in ((low, "low"), (high, "high")):
            assert abs(own - row[end]) < 2e-3 * (row["high"] - row["low"]), (p, own, row)
    def shown(rule):
        page.run("const [kind, value] = arguments[0].split(':'); grseg.set({rule: {kind, value: Number(value)}}); grseg.flush()", rule)
        text = re.match(r"\[(\S+), (\S+)\]", page.text("b-interval").replace("−", "-"))
        return [float(text[1]), float(text[2])]
    close(shown("uniform:0.9")[0], expected["uniform:0.9"]["B"]["low"], "the interval as text", 6e-4)
    power = page.run("return grseg.fit(0, 'power:3.3')")
    assert abs(power["share"] - 2**3.3 / (1 + 2**3.3)) > 1e-4, "the sample has grains of one size each; take another run"
    for a, b in zip(shown("power:3.3"), page.run("return grseg.interval(0, `uniform:${arguments[0]}`).interval", power["share"])):
        close(a, b, "the interval of a rule that was not asked for", 6e-4)


def check_readout(page):
    """Beside B stand what its interval is over, its windows and times, and the doubts of grseg-fit, those of its rule alone."""
    page.keys("3")
    told = tool("fit", "sums.tsv", "--partition", "size,half", "--quiet")
    words = re.search(r"^# estimand: windows: (.*)$", told, re.MULTILINE)[1]
    windows = re.search(r"^# windows: (.*)$", told, re.MULTILINE)[1]
    assert words in page.text("b-over") and f"From {windows} windows of 1.25 s, t = 0 to " in page.text("b-over"), page.text("b-over")
    doubts = re.findall(r"^# doubt: (?!size: )(?:(?:size, )?half: )?(.*)$", told, re.MULTILINE)
    shown = page.run("return Array.from(document.querySelectorAll('#b-doubts li'), (e) => e.textContent)")
    assert [text[:20] for text in shown] == [text[:20] for text in doubts], (shown, doubts)
    for texts in ([], ["flowing", "steady since t = 10 s", "B changes by -0.009 +- 0.1, or --begin 4"]):
        page.run("grseg.page.fit.verdict = arguments[0]; grseg.set({rule: {kind: 'size', value: NaN}}); grseg.flush()", texts)
        assert page.run("return Array.from(document.querySelectorAll('#b-verdict li'), (e) => e.textContent)") == [f"{text}.".replace("by -", "by −").replace("+-", "±") for text in texts]
    whole = page.run("return Array.from(document.querySelectorAll('#b-verdict .whole'), (e) => e.textContent)")
    assert whole == ["t = 10 s", "−0.009 ± 0.1", "--begin 4"], whole


def check_contrast(page):
    """Text has a contrast of 4.5 or more to its background (WCAG 2.1, 1.4.3), in both tabs, light and dark."""
    for is_dark in (False, True):
        page.dark(is_dark)
        for tab in ("explore", "report"):
            page.run(f"document.getElementById('tab-{tab}').click()")
            page.settle()
            low = page.run("""
              const channels = (text) => text.match(/[\\d.]+/g).map(Number);
              const linear = (c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
              const luminance = (text) => channels(text).slice(0, 3).reduce((sum, c, k) => sum + linear(c) * [0.2126, 0.7152, 0.0722][k], 0);
              const behind = (e) => {
                const own = getComputedStyle(e).backgroundColor;
                return (channels(own)[3] ?? 1) > 0 ? own : behind(e.parentElement);
              };
              const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
              const low = [];
              let n = 0;
              while (texts.nextNode()) {
                const e = texts.currentNode.parentElement;
                if (!texts.currentNode.data.trim() || !e.getClientRects().length) continue;
                const style = getComputedStyle(e);
                const [a, b] = [luminance(e instanceof SVGElement ? style.fill : style.color), luminance(behind(e))];
                const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
                ++n;
                if (contrast < 4.5) low.push([texts.currentNode.data, contrast]);
              }
              return n > 50 ? low : [["texts", n]]""")
            assert low == [], (is_dark, tab, low)
    page.dark(False)
    page.run("document.getElementById('tab-explore').click()")


def check_names(page):
    """Names above the plot of B over p overlap neither each other nor the lines of other names."""
    for size in (DESK, PHONE):
        page.resize(*size)
        page.settle()
        boxes, lines = page.run("""const of = (what) => Array.from(document.querySelectorAll(`#share-plot .codes ${what}, #share-plot .p-zero ${what}`),
              (e) => { const {left, right, top, bottom} = e.getBoundingClientRect(); return [left, right, top, bottom]; });
            return [of("text"), of("line")]""")
        assert len(boxes) == 4, boxes
        for k, (left, right, top, bottom) in enumerate(boxes):
            assert right <= size[0]
            for other in boxes[:k]:
                assert right <= other[0] or left >= other[1] or bottom - 4 <= other[2] or top + 4 >= other[3], (size, boxes)
            for x, _, y0, y1 in lines:
                assert not (left < x < right and y0 < bottom - 4 and y1 > top + 4), (size, boxes[k], (x, y0, y1))
    page.resize(*DESK)
    page.settle()


def check_neutral(page):
    """Contacts that ignore size: ends are drawn in proportion to phi/d, forces are equal, branches are as long as the pair."""
    arrays = page.run("const {phi_large, frames} = grseg.page.fits[0].arrays; return [Array.from(phi_large), Array.from(frames)]")
    phi, frames = map(np.array, arrays)
    r = page.run("return grseg.page.fits[0].size_ratio")
    large = phi / r / (phi / r + 1 - phi)
    for p in (0, 0.5, r / (1 + r), 1):
        whole = large**2 * r + 2 * large * (1 - large) * (1 + r) / 2 + (1 - large)**2
        of_large = (large**2 * r + p * 2 * large * (1 - large) * (1 + r) / 2) / whole
        expected = (frames * (of_large - phi)).sum() / (frames * phi * (1 - phi)).sum()
        close(page.run("return grseg.neutral(0, arguments[0])", p), expected, f"neutral contacts at p = {p}")


def check_contacts(page, run, numbers):
    """Contacts of a frame equal those of the file: the branch from the nearest image, or from the contact point of a wall, and the components of the force on grain i along and across it."""
    for number in numbers:
        page.run("grseg.page.transport.goTo(arguments[0])", number)
        page.settle()
        own = page.run("""const {players: [player]} = grseg.page, c = player.contacts(), {row} = player.frames.arrays;
          const of = (values) => Array.from(values);
          return [of(c.i).map((g) => row[g]), of(c.j).map((g) => g < 0 ? g : row[g]), of(c.xi).map((x, k) => x - c.xj[k]), of(c.yi).map((y, k) => y - c.yj[k]),
                  of(c.along), of(c.across), player.frames.rounding * player.frames.meanForce, grseg.state.time]""")
        first, second, bx, by, along, across = map(np.array, own[:6])
        with h5py.File(run) as file:
            frame = int(np.argmin(abs(file["particles/grains/position/time"][:] - own[7])))
            begin, end = file["grseg/contacts/offset"][frame:frame + 2].astype(int)
            i, j, force, branch = (file[f"grseg/contacts/{name}"][begin:end] for name in ("i", "j", "force", "branch"))
            diameter = 2 * file["particles/grains/radius"][:].min()
        bears = (force != 0).any(axis=1)
        known = {pair: k for k, pair in enumerate(zip(i, j)) if bears[k]}
        assert len(first) == bears.sum() == len(known)
        at = np.array([known[pair] for pair in zip(first, second)])
        assert abs(np.stack([bx, by], 1) - branch[at]).max() < 0.01 * diameter, "branches"
        unit = branch[at] / np.linalg.norm(branch[at], axis=1)[:, None]
        normal = (force[at] * unit).sum(1)
        shear = force[at, 1] * unit[:, 0] - force[at, 0] * unit[:, 1]
        for name, shown, told in (("along", along, normal), ("across", across, shear)):
            assert abs(shown - told).max() < 1.01 * own[6] + 1e-6 * abs(told).max(), (name, abs(shown - told).max(), own[6])


def check_cuts(page):
    """Point at which the line of a mixed contact changes colour: the large grain's share of the branch, in either order of the grains."""
    radius, small, rules = page.run("""
      const {players: [player]} = grseg.page, c = player.contacts(), {species, radius} = player.frames.arrays;
      const cuts = {}, mixed = [];
      for (let k = 0; k < c.i.length; ++k) if (c.j[k] >= 0 && species[c.i[k]] + species[c.j[k]] === 1) mixed.push(k);
      for (const [kind, value] of [["size", NaN], ["half", NaN], ["uniform", 0.7], ["power", 2]]) {
        grseg.set({rule: {kind, value}});
        cuts[kind] = mixed.map((k) => player.cut(c, k).at);
      }
      return [mixed.map((k) => [radius[c.i[k]], radius[c.j[k]]]), mixed.map((k) => species[c.i[k]] === 0), cuts]""")
    radius = np.array(radius)
    larger, smaller = radius.max(1), radius.min(1)
    for kind, share in (("size", larger / (larger + smaller)), ("half", 0.5), ("uniform", 0.7), ("power", larger**2 / (larger**2 + smaller**2))):
        of_first = np.where(small, 1 - share, share)
        assert abs(np.array(rules[kind]) - of_first).max() < 1e-6, kind


def check_base_cuts(page):
    """The line of a contact with the base has the grain's colour up to the contact point."""
    radii, at = page.run("""
      const {players: [player]} = grseg.page, c = player.contacts(), {species, radius} = player.frames.arrays;
      const own = Array.from(c.i.keys()).filter((k) => c.j[k] >= 0 && species[c.j[k]] === 255);
      return [own.map((k) => [radius[c.i[k]], radius[c.j[k]]]), own.map((k) => player.cut(c, k).at)]""")
    grain, bead = np.array(radii).T
    assert abs(np.array(at) - grain / (grain + bead)).max() < 1e-6


def drawn(page, plot, what, scales="chart.scales"):
    """Corners of a path, or centres of circles, in the units of the plot's axes."""
    return np.array(page.run("""
      const {x, y} = eval(`grseg.page.${arguments[0]}.${arguments[2]}`);
      const marks = Array.from(document.querySelectorAll(arguments[1]));
      const pixels = marks[0].tagName === "path" ? marks[0].getAttribute("d").slice(1).split("L").map((pair) => pair.split(",").map(Number))
                                                 : marks.map((mark) => ["cx", "cy"].map((name) => Number(mark.getAttribute(name))));
      return pixels.map(([px, py]) => [x.invert(px), y.invert(py)])""", plot, what, scales))


def check_plots(page):
    """Shapes read from the axes: curve of equal B, marks of programs, profiles, and B of the layers."""
    page.run("grseg.set({rule: {kind: 'size', value: NaN}, time: 5}); grseg.flush()")
    rules = fitted("sums.tsv", "--partition", "size,half")
    B = {rule: rules[rule]["B"]["value"] for rule in ("size", "half")}
    ratio, value = drawn(page, "scatter", "#scatter-plot .curve").T
    phi, psi = 1 / (1 + ratio), 1 / (1 + value)
    assert abs((psi - phi) / (phi * (1 - phi)) - B["size"]).max() < 2e-3, "B is the same along the curve"
    with open("sums.tsv") as file:
        lines = [line.split("\t") for line in file if not line.startswith("#")]
    sums = {name: np.array([float(line[k]) for line in lines[1:]]) for k, name in enumerate(lines[0][:-1])}
    area = {name: next(values for column, values in sums.items() if column.startswith(f"area_{name}")) for name in "SL"}
    of_files = area["S"] / np.where(area["L"] > 0, area["L"], np.nan)
    for shown in page.run("return Array.from(grseg.page.scatter.ratio)"):
        assert abs(of_files - shown)[of_files > 0].min() < 1e-9 * shown, "phi_S/phi_L of a layer and window"
    assert page.run("return grseg.page.scatter.windowNow()") == 5, "a window holds its beginning"
    marks = drawn(page, "share", "#share-plot .codes circle")
    nearest = marks[abs(marks[:, 0] - 0.5).argmin()]
    assert abs(nearest[0] - 0.5) < 1e-3 and abs(nearest[1] - B["half"]) < 0.01, ("the mark of half", nearest, B["half"])
    table = page.run("return grseg.content.runs[0].layers.tables.find((t) => t.name === 'stress')")
    d = page.run("return grseg.content.runs[0].small_diameter")
    rows = np.array(table["rows"], dtype=float)
    column = lambda name: rows[:, next(k for k, own in enumerate(table["columns"]) if own.startswith(name))]
    height = (column("y0") + column("y1")) / 2 / d
    for species, name in (("small", "sigma_S_yy"), ("large", "sigma_L_yy")):
        profile = drawn(page, "profiles", f"#profile-plot .profile.{species}", "pressure.scales")
        expected = np.interp(profile[:, 1], height, column(name))
        assert abs(profile[:, 0] - expected).max() < 0.02 * column(name).max(), species
    of = lambda name: next(values for own, values in sums.items() if own.startswith(name))
    with np.errstate(invalid="ignore"):
        mixed = of("M_yy") / sum(of(f"{name}_yy") for name in ("A_SS", "A_LL", "M", "A_Sb", "A_Lb"))
    for bottom, shown in zip(column("y0"), column("mixed_share_yy")):
        own = (of("y0") == bottom) & np.isfinite(mixed)
        if own.any():
            close(shown, (of("frames") * mixed)[own].sum() / of("frames")[own].sum(), f"mixed contacts' part of the stress at {bottom}")
    arrays = {name: np.array(values) for name, values in page.run("""const {phi_large, frames, bottom, size_small, size_large, size_within} = grseg.page.fits[0].arrays;
      return Object.fromEntries(Object.entries({phi_large, frames, bottom, size_small, size_large, size_within}).map(([name, values]) => [name, Array.from(values)]))""").items()}
    dots = drawn(page, "profiles", "#layers-plot circle", "strength.scales")
    for bottom in set(arrays["bottom"]):
        own = {name: values[arrays["bottom"] == bottom] for name, values in arrays.items()}
        phi, frames = own["phi_large"], own["frames"]
        excess = (own["size_large"] - own["size_within"]) / (own["size_small"] + own["size_large"]) - phi
        of_layer = (frames * excess).sum() / (frames * phi * (1 - phi)).sum()
        ends = page.run("return grseg.page.profiles.strength.scales.x.domain()")
        near = dots[abs(dots[:, 1] - bottom / d - 2) < 0.1, 0]
        assert len(near) == (ends[0] <= of_layer <= ends[1]), "a layer beyond the axis has no point"
        assert (abs(near - of_layer) < 0.01).all(), ("B of the layer at", bottom / d, near, of_layer)
    bars = page.run("""const {x, y} = grseg.page.profiles.strength.scales;
      return Array.from(document.querySelectorAll("#layers-plot .bar-of-error"), (e) => ["x1", "x2", "y1"].map((name) => Number(e.getAttribute(name))))
        .map(([a, b, c]) => [x.invert(a), x.invert(b), y.invert(c)])""")
    assert len(bars) == len(dots)
    low, high, at = bars[len(bars) // 2]
    tool("stress", RUN, "--quiet", "-o", "of-layer.tsv", "--overwrite")
    row = fitted("of-layer.tsv", "--heights", f"{at - 2:.0f}dS:{at + 2:.0f}dS", "--partition", "size")["size"]["B"]
    assert abs(low - row["low"]) < 0.01 and abs(high - row["high"]) < 0.01, ("interval of the layer", low, high, row)
    player = page.run("const [player] = grseg.page.players; return [player.py(0), player.py(0.1)]")
    assert player[1] < player[0], "up is up"


def check_controls(page):
    driver = page.driver
    slider = driver.find_element(By.ID, "p")
    left, bar = slider.rect["x"], slider.rect["width"]
    # The thumb is 18 pixels wide, so its middle begins 9 pixels right of the left end.
    place = left + 9 + 0.8 * (bar - 18)
    page.run("document.getElementById('p').scrollIntoView({block: 'center'})")
    ActionChains(driver).move_to_element(slider).click_and_hold().move_by_offset(
        int(place - left - bar / 2), 0).release().perform()
    page.settle()
    rule = page.run("return grseg.state.rule")
    assert rule["kind"] == "uniform" and abs(rule["value"] - 0.8) < 0.01, rule
    close(float(page.text("b-value").replace("−", "-")), page.run("return grseg.fit(0, `uniform:${grseg.state.rule.value}`).B"), "B under the slider", 6e-4)
    point = page.run("const at = (e) => e.getBoundingClientRect(); const p = at(document.querySelector('#share-plot .point')); return p.left + p.width / 2")
    assert abs(point - place) < 6, "the thumb stands under the point of the plot"
    page.run("document.activeElement.blur()")

    for key, word in zip("1234", ("size", "contact-point", "half", "drop")):
        page.keys(key)
        assert page.run("return grseg.state.rule.kind") == word
        pressed = page.run("return document.querySelector('#rules [aria-pressed=true] b').textContent")
        assert pressed == word
    page.keys("3")
    page.keys(Keys.ARROW_UP)
    close(page.run("return grseg.state.rule.value"), 0.505, "half and a step")

    before = page.run("return grseg.page.transport.number")
    page.keys(Keys.ARROW_RIGHT)
    assert page.run("return grseg.page.transport.number") == before + 1
    page.keys(" ")
    page.until(f"grseg.page.transport.number > {before + 3}")
    page.keys(" ")
    stopped = page.run("return grseg.page.transport.number")
    time.sleep(0.3)
    assert page.run("return grseg.page.transport.number") == stopped, "paused"
    page.keys("g", "m")
    assert page.run("return [grseg.state.showGrains, grseg.state.onlyMixed]") == [False, True]
    page.keys("g", "m")
    page.keys("?")
    assert page.run("return document.getElementById('help').open")
    page.keys(Keys.ESCAPE)


def painted(page, canvas, name):
    """Number of pixels of a canvas that have exactly this colour of the style sheet."""
    return page.run("""
      const probe = document.createElement("i");
      probe.style.color = `var(--${arguments[1]})`;
      document.body.append(probe);
      const [r, g, b] = getComputedStyle(probe).color.match(/\\d+/g).map(Number);
      probe.remove();
      const {width, height} = document.querySelector(arguments[0]);
      const copy = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
      copy.drawImage(document.querySelector(arguments[0]), 0, 0);
      const {data} = copy.getImageData(0, 0, width, height);
      let n = 0;
      for (let k = 0; k < data.length; k += 4) n += data[k] === r && data[k + 1] === g && data[k + 2] === b && data[k + 3] === 255;
      return n""", canvas, name)


def check_theme(page):
    """If the system turns dark while the page is open, canvases do, too, also those of a hidden tab."""
    def check(mode):
        for canvas, names in (("#players canvas", ("small", "large", "ink")), ("#scatter-plot canvas", ("ink",))):
            for name in names:
                assert painted(page, canvas, name) > 20, (mode, canvas, name)
    check("light")
    page.dark(True)
    check("dark")
    page.run("document.getElementById('tab-report').click()")
    page.dark(False)
    page.run("document.getElementById('tab-explore').click()")
    page.settle()
    check("light, turned while the report was shown")
    page.run("document.getElementById('theme').click()")
    page.settle()
    check("dark by the button")
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert page.run("return getComputedStyle(document.body).color") == "rgb(26, 30, 35)", "paper is light"
    page.run("delete document.documentElement.dataset.theme")
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    page.dark(True)
    page.dark(False)


def check_captions(page):
    """The sample of a line in a caption looks like the line drawn, every line of a figure has its sample, and no caption names a colour."""
    page.run("grseg.set({rule: {kind: 'size', value: NaN}}); grseg.flush()")
    looks = """
      const of = (scope, chosen, property) => Array.from(scope.querySelectorAll(chosen), (e) => getComputedStyle(e)[property]).sort();
      const once = (all) => all.filter((one, k) => all.indexOf(one) === k);"""
    for is_dark in (False, True):
        page.dark(is_dark)
        for tab in ("explore", "report"):
            page.run(f"document.getElementById('tab-{tab}').click()")
            page.settle()
            words = page.run(f"return Array.from(document.querySelectorAll('#{tab} .note, #{tab} .legend, #{tab} figcaption, #{tab} .words, #help p'), (e) => e.textContent)")
            named = [text for text in words if re.search(r"\b(blue|orange|red|green|brown|gr[ea]y|black|white|dark|light)\b", text, re.I)]
            assert not named, named
        for drawn, told in page.run(looks + """return Array.from(document.querySelectorAll("#report figure"), (f) =>
              [of(f, "path.profile, path.neutral", "stroke"), of(f, ".stroke", "borderTopColor")])"""):
            assert drawn == told or (len(drawn) <= 1 and not told), (is_dark, drawn, told)
        page.run("document.getElementById('tab-explore').click()")
        page.settle()
        for plot, drawn, note, told in (("#profile-plot", ".profile", "#profile-note", "stroke"), ("#layers-plot", "circle", "#layers-plot + .note", "key"),
                                        ("#scatter-plot", ".curve, .neutral", "#scatter-note", "stroke")):
            lines, pieces = page.run(looks + """const [plot, drawn, note, told] = arguments;
              return [once(of(document.querySelector(plot), drawn, "stroke")),
                      once(of(document.querySelector(note), `.${told}`, told === "key" ? "backgroundColor" : "borderTopColor"))]""", plot, drawn, note, told)
            assert lines == pieces, (is_dark, plot, lines, pieces)
        legend = page.run("return Array.from(document.querySelectorAll('#legend .key'), (e) => e.className.slice(4))")
        for look in legend:
            assert painted(page, "#players canvas", look) > 20 or look == "base", (is_dark, look)  # the base is drawn in a pale colour
    page.dark(False)


def check_numbers(page):
    """Different numbers are written differently, and numbers on the page have a unit or a name."""
    zero = page.run("return grseg.content.runs[0].fit.scan.p_zero[0]")
    for value in (zero + 0.003, zero - 0.003, 0.5003):
        page.run("grseg.set({rule: {kind: 'uniform', value: arguments[0]}}); grseg.flush()", value)
        carried, present = re.findall(r"[\d.]+\s%", page.text("parts"))
        assert carried != present, page.text("parts")
        large, small = re.findall(r"[\d.]+", page.text("proportion"))
        assert large != small, page.text("proportion")
    options = page.run("return Array.from(document.getElementById('speed').options, (o) => o.textContent)")
    assert options[1] == "12 frames/s", options
    assert re.fullmatch(r"t = [\d.]+ s", page.text("time")), page.text("time")


def check_address():
    """The address describes the view and restores it; its changes add nothing to the browser's history."""
    with Page("page.html") as page:
        assert page.run("return window.location.hash") == "", "nothing has been chosen"
        page.run("grseg.set({rule: {kind: 'uniform', value: 0.62}, grain: 7})")
        page.keys("l", "m", Keys.ARROW_RIGHT)
        time, row = page.run("return [grseg.state.time, grseg.page.players[0].frames.arrays.row[7]]")
        page.until("window.location.hash")
        page.run("document.getElementById('tab-report').click()")
        page.until("window.location.hash.startsWith('#report')")
        told = page.run("return window.location.hash")
        assert told == f"#report&rule=uniform:0.62&time={time:.6g}&grain=1:{row}&draw=grains,forces,mixed,layers", told
        assert page.run("return window.history.length") == 2, "the empty page, and this one"
        page.run("window.location.hash = '#explore&rule=half&time=3.21&draw=forces'")
        page.until("grseg.state.rule.kind === 'half'")
        assert not page.run("return document.getElementById('explore').hidden")
    with Page("page.html", link=told) as page:
        shown = page.run("return [grseg.state.rule, grseg.state.time, grseg.state.grain, grseg.state.onlyMixed, document.getElementById('only-mixed').checked, document.getElementById('report').hidden]")
        assert shown == [{"kind": "uniform", "value": 0.62}, time, 7, True, True, False], shown
        page.run("document.getElementById('tab-explore').click()")
        page.settle()
        close(float(page.text("b-value").replace("−", "-")), page.run("return grseg.fit(0, 'uniform:0.62').B"), "B of the link", 6e-4)
    for odd in ("#report", "#rule=nonsense&time=x&run=9&grain=3:77777&draw=", "#&&=%E0%A4%A", "#rule=uniform:&run=-1"):
        with Page("page.html", link=odd) as page:
            assert page.run("return document.getElementById('report').hidden") == (odd != "#report")
            assert page.run("return Number.isFinite(grseg.state.time) && grseg.state.run === 0 && grseg.state.grain === -1"), odd
            page.run("document.getElementById('tab-explore').click()")


def check_grain(page):
    """A click selects the grain at this point, with the contacts that the file has for the grain."""
    page.run("grseg.page.transport.goTo(60); window.scrollTo(0, 0)")
    page.settle()
    with h5py.File(RUN) as file:
        times = file["particles/grains/position/time"][:]
        frame = int(np.argmin(abs(times - page.run("return grseg.state.time"))))
        species = file["particles/grains/species"][:]
        begin, end = file["grseg/contacts/offset"][frame:frame + 2].astype(int)
        i, j = (file[f"grseg/contacts/{name}"][begin:end] for name in "ij")
        force, branch = (file[f"grseg/contacts/{name}"][begin:end] for name in ("force", "branch"))
        bears = (force != 0).any(axis=1)
        mixed = bears & (j >= 0) & (species[i] + species[j] == 1)
        row = next(int(one) for one in i[mixed] if ((j == one) & bears).any())
        own = bears & ((i == row) | (j == row))
    place = page.run("""
      const {frames} = grseg.page.players[0], {canvas} = grseg.page.players[0];
      const grain = frames.arrays.row.indexOf(arguments[0]), frame = grseg.page.players[0].frame;
      return [grseg.page.players[0].px(frames.x(frame, grain)) - canvas.clientWidth / 2,
              grseg.page.players[0].py(frames.y(frame, grain)) - canvas.clientHeight / 2]""", row)
    canvas = page.driver.find_element(By.CSS_SELECTOR, "#players canvas")
    ActionChains(page.driver).move_to_element_with_offset(canvas, *map(round, place)).click().perform()
    page.settle()
    assert f"Grain {row}," in page.text("grain"), page.text("grain")
    lines = page.run("return document.querySelectorAll('#grain tbody')[0].rows.length")
    assert lines == own.sum(), (lines, own.sum())
    towards = page.run("return Array.from(document.querySelectorAll('#grain tbody')[0].rows, (row) => row.cells[1].textContent)")
    to_other = np.where(i[own] == row, -1, 1)[:, None] * branch[own]
    assert (j[own] == row).any(), "in one contact at least the grain comes second"
    for shown, angle in zip(towards, np.degrees(np.arctan2(to_other[:, 1], to_other[:, 0]))):
        assert abs((float(shown.rstrip("°").replace("−", "-")) - angle + 180) % 360 - 180) < 2, (shown, angle)
    rows = page.run("""return Array.from(document.querySelectorAll('#grain tbody')[1].rows,
                                         (row) => [row.cells[0].textContent, row.cells[1].textContent])""")
    shares = dict(rows)
    with h5py.File(RUN) as file:
        radius = file["particles/grains/radius"][:]
    gets = {"size": 0, "half": 0}
    for k in np.flatnonzero(own & mixed):
        other = j[k] if i[k] == row else i[k]
        stress = force[k, 1] * branch[k, 1]
        gets["size"] += stress * radius[row] / (radius[row] + radius[other])
        gets["half"] += stress / 2
    for rule, value in gets.items():
        shown = float(shares[rule].replace("−", "-"))
        assert abs(shown - value) < 0.02 * abs(value) + 1e-9, (rule, shown, value)
    assert shares["drop"] == "–"


def check_widths(page):
    for width, height in (DESK, (800, 900), PHONE):
        page.resize(width, height)
        page.settle()
        over = page.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
        assert over <= 0, f"{over} pixels too wide at {width}"
        drawn = page.run("return document.querySelector('#players canvas').clientWidth")
        assert 0.35 * width < drawn <= width, (width, drawn)
        page.shoot(f"explore-{width}")
    page.resize(*DESK)
    page.settle()


def check_report(page):
    page.run("document.getElementById('tab-report').click()")
    page.settle()
    text = page.text("report")
    with h5py.File(RUN) as file:
        digest = "xxh3 {:016x}".format(int(file["grseg/digest"][-1]))
        history = file["parameters/history"][()]
    history = history.decode() if isinstance(history, bytes) else str(history)
    assert digest in text and history.splitlines()[0] in text
    checks = [line.split("\t") for line in tool("check", RUN, "--physics", "--quiet").splitlines() if not line.startswith("#")][1:]
    for line in checks:
        assert line[0] in text
    assert f"All {len(checks)} lines" in text
    assert "a longer run decides" in text and "The sign of B is undecided under size, contact-point: the interval includes 0." in text
    rows = page.run("""return Array.from(document.querySelectorAll("#report td, #report dd, #report .doubt li"), (e) => [e.previousSibling?.textContent ?? "", e.textContent])""")
    exact = re.compile(r"Digest|Program|program")
    for name, own in rows:
        for number in re.findall(r"\d*\.\d+", own.replace("−", "-")):
            digits = number.replace(".", "").lstrip("0")
            assert exact.search(name) or len(digits) <= 4, (name, own)
    facts = dict(rows)
    assert re.fullmatch(r"[\d.]+ m", facts["deposited height"]) and facts["density"] == "1 kg/m²" and facts["gravity"] == "3.829 -9.021 m/s²", facts
    columns = {"kinetic": ["u[m/s]", "T_S_x[m^2/s^2]", "T_L_x[m^2/s^2]", "T_L_y[m^2/s^2]", "equipartition_y"],
               "balance": ["push_kinetic[N/m^2]", "drag[N/m^2]"]}
    for name, own in columns.items():
        check_means(page, name, own)
    over = page.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    assert over <= 0, over
    page.shoot("report-1280")
    page.run("document.getElementById('tab-explore').click()")


def check_means(page, name, columns):
    """The report's tables by layer are means of the tool's rows over all windows, weighted by frames. A force is 0 in windows without the layer."""
    lines = [line.split("\t") for line in tool(name, RUN, "--quiet").splitlines() if not line.startswith("#")]
    at = {column: k for k, column in enumerate(lines[0])}
    rows = np.array(lines[1:], dtype=float)
    all_frames = sum(dict(rows[:, [at["t0[s]"], at["frames"]]]).values())
    shown = page.run("return grseg.content.runs[0].layers.tables.find((t) => t.name === arguments[0])", name)
    for own in shown["rows"]:
        of_layer = rows[rows[:, at["y0[m]"]] == own[0]]
        for column in columns:
            values, frames = of_layer[:, at[column]], of_layer[:, at["frames"]]
            known = np.isfinite(values)
            if known.any():
                without = all_frames - frames.sum() if column.startswith("push") else 0
                mean = (values * frames)[known].sum() / (frames[known].sum() + without)
                close(own[shown["columns"].index(column)], mean, f"{column} of the layer at {own[0]}")


def check_speed(page):
    """Milliseconds for a frame of the player, and from a move of the slider until everything is drawn."""
    paint = page.run("return performance.getEntriesByType('paint').map((e) => [e.name, e.startTime])")
    best = lambda script: min(page.run(script) for _ in range(3))
    frame = best("""
      const n = 40, {transport} = grseg.page; const from = performance.now();
      for (let k = 0; k < n; ++k) { transport.goTo(k % transport.times.length); grseg.flush(); }
      return (performance.now() - from) / n""")
    move = best("""
      const n = 40; const from = performance.now();
      for (let k = 0; k < n; ++k) { grseg.set({rule: {kind: "uniform", value: 0.4 + k / 100}}); grseg.flush(); }
      return (performance.now() - from) / n""")
    first = ", ".join(f"{name} {when:.0f} ms" for name, when in paint)
    print(f"{first}; a frame {frame:.1f} ms, a move of the slider {move:.1f} ms")
    assert frame < 100 and move < 50, "more than a few frames of a screen, even on a loaded machine"


def check_hostile():
    """The name and the content of a file are shown as text only."""
    name = "<img src=x onerror=document.title=1>.h5"
    shutil.copy(RUN, name)
    evil = "</script><script>document.title='taken'</script><b id=evil>"
    with h5py.File(name, "r+") as file:
        del file["parameters/history"]
        file["parameters"].create_dataset("history", data=np.bytes_(evil))
    done = subprocess.run([f"{BIN}/grseg-explore", name, "--trust", "-o", "evil.html"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with Page("evil.html") as page:
        assert name in page.run("return document.title")
        assert page.run("return document.getElementById('evil') === null && !document.querySelector('img')")
        assert evil in page.text("report")
        assert page.run("return document.scripts.length") == 2, "content, and the program; arrays are gone"


def check_species():
    """With three species, the chosen pair has the B of grseg-fit, and items that need exactly two species are hidden."""
    tool("stress", RUN, "--classes", "3", "--quiet", "-o", "three.tsv")
    expected = fitted("three.tsv", "--pair", "1,2", "--partition", "size,half,uniform:0.7")
    tool("report", RUN, "--classes", "3", "--pair", "1,2", "--quiet", "-o", "three.html")
    with Page("three.html") as page:
        assert "p*" not in page.text("report")
        page.run("document.getElementById('tab-explore').click()")
        page.settle()
        for rule, row in expected.items():
            if rule != "-":
                close(page.run("return grseg.fit(0, arguments[0]).B", rule), row["B"]["value"], rule)
        for rule in ("size", "contact-point"):
            assert page.run("return grseg.fit(0, arguments[0]).share", rule) is None, "mixed contacts with the third"
        assert page.run("return grseg.fit(0, 'half').share") == 0.5
        assert "nominal" in page.text("q-note")
        assert page.run("return document.getElementById('parts').hidden"), "a bar of two species"
        assert not page.run("return document.querySelector('#share-plot .p-zero').hasChildNodes()")
        assert not page.run("return document.querySelector('#share-plot .neutral').getAttribute('d')")
        page.keys("3", "0")
        assert page.run("return grseg.state.rule.kind") == "half", "there is no p* to go to"
        check_captions(page)
        assert page.text("profile-note").startswith("both c1 grains c2 grains"), page.text("profile-note")
        ticks = page.run("return Array.from(document.querySelectorAll('#scatter-plot .tick text'), (e) => e.textContent)")
        assert max(map(len, ticks)) <= 5, ticks
        page.keys("4")
        assert "B the same everywhere" not in page.text("scatter-note"), "by drop there is no line"
        check_commands(page, ["size", "half", "power:2"])


def check_commands(page, rules):
    """The commands printed on the page run without errors, and print the B that the page shows."""
    for rule in rules:
        page.run("""const [kind, value] = arguments[0].split(":");
                    grseg.set({rule: {kind, value: value === undefined ? NaN : Number(value)}}); grseg.flush()""", rule)
        lines = page.run("return document.getElementById('command').textContent").splitlines()
        with tempfile.TemporaryDirectory(dir=".") as folder:
            for name in os.listdir("."):
                if name.endswith((".h5", ".tsv")):
                    os.symlink(os.path.abspath(name), os.path.join(folder, name))
            for made in ("sums.tsv", "sums-1.tsv", "sums-2.tsv"):
                if f"-o {made}" in "\n".join(lines) and os.path.lexists(os.path.join(folder, made)):
                    os.unlink(os.path.join(folder, made))
            done = ""
            for k, line in enumerate(lines):
                words = line + (" --json" if k == len(lines) - 1 else "") + " --quiet"
                made = subprocess.run(["sh", "-c", f'PATH="{BIN}:$PATH"; {words}'], cwd=folder, capture_output=True, text=True)
                assert made.returncode == 0, (words, made.stderr)
                done = made.stdout
        found = next(own for name, own in numbers_in(done).items() if name != "-")
        shown = page.run("return grseg.fit(grseg.state.run, arguments[0]).B", rule)
        close(shown, found["B"]["value"], f"B by {lines}")


def check_edges():
    """A rule beyond the range of the page is refused; if the interval of another rule is shown, the page says so."""
    for Q in ("8", "-2"):
        refused = subprocess.run([f"{BIN}/grseg-explore", RUN, "--partition", f"power:{Q}", "-o", "no.html"], capture_output=True, text=True)
        assert refused.returncode == 2 and "for Q from 0 to 4" in refused.stderr, refused.stderr
    tool("explore", RUN, "--rules", "size", "--partition", "power:2", "--begin", "2.5", "--end", "15", "--heights", "4dS:", "--quiet", "-o", "edges.html")
    with Page("edges.html") as page:
        check_commands(page, ["power:2", "contact-point", "uniform:0.7"])
        page.run("grseg.set({rule: {kind: 'power', value: 2}}); grseg.flush()")
        shown = page.text("b-interval").replace("−", "-")
        low, high = map(float, re.findall(r"-?[0-9.]+", shown)[:2])
        B = float(page.text("b-value").replace("−", "-"))
        assert low < B < high and "taken from uniform:" in shown, (shown, B)
        for beyond in (1.3, -0.2, None):
            page.run("grseg.content.runs[0].fit.scan.p_zero[0] = arguments[0]", beyond)
            page.keys("3", "0")
            assert page.run("return grseg.state.rule.kind") == "half", f"p* = {beyond} is not a share"
        page.run("""const {size_small, size_large} = grseg.content.runs[0].arrays;
                    size_small.fill(-1); size_large.fill(-1);
                    grseg.set({rule: {kind: "size", value: NaN}}); grseg.flush()""")
        assert page.text("b-words") == "No B: no layer has a positive pressure in any window.", page.text("b-words")
    # A table beside its run keeps its own windows; --begin and --end select from them.
    tool("stress", RUN, "--window", "2.5", "--quiet", "-o", "given.tsv")
    tool("explore", RUN, "given.tsv", "--begin", "5", "--end", "15", "--quiet", "-o", "given.html")
    with Page("given.html") as page:
        check_commands(page, ["size", "power:2"])
        times = page.run("return grseg.content.runs[0].window_times")
        assert times[0] == [0, 2.5] and len(times) == 8, times
        assert page.run("return grseg.content.runs[0].layers.tables.length") == 0 and "are left out: B is of the windows" in page.text("report")
        begins = page.run("return Array.from(grseg.content.runs[0].arrays.begin)")
        page.run("grseg.set({time: 6}); grseg.flush()")
        assert page.run("return grseg.page.scatter.windowNow()") == 5 and 5 in begins
    tool("stress", RUN, "--classes", "3", "--quiet", "-o", "classes.tsv")
    refused = subprocess.run([f"{BIN}/grseg-explore", RUN, "classes.tsv", "-o", "no.html"], capture_output=True, text=True)
    assert refused.returncode == 2 and "classes.tsv: has the species" in refused.stderr, refused.stderr
    assert not os.path.exists("no.html")


def check_spheres():
    """For spheres the page says that it shows only some of the contacts, and it shows no sums over contacts."""
    if not os.path.exists(f"{BIN}/grseg-import"):
        return
    sample = f"{ROOT}/data/sample/spheres"
    tool("import", "--format", "lammps", "--grains", f"{sample}/atoms.dump.gz", "--contacts", f"{sample}/contacts.dump.gz",
         "--units", "0.005:0.0225762:3.125e-4", "--step", "8.8e-4", "--gravity", "0.4383711467890774,0,-0.898794046299167",
         "--axes", "xz", "--boundary", "1", "--quiet", "-o", "spheres.h5")
    tool("explore", "spheres.h5", "--layer", "3dS", "--window", "0.4", "--heights", "all", "--quiet", "-o", "spheres.html")
    with Page("spheres.html") as page:
        check_commands(page, ["size", "power:3"])
        page.run("""const player = grseg.page.players[0], {i, j} = player.contacts();
                    grseg.set({player: 0, grain: i[j.findIndex((other, k) => other >= 0 && player.frames.arrays.species[i[k]] !== 255)]});
                    grseg.flush()""")
        text = page.text("grain")
        assert "of the slice" in text and "in the plane of the page" in text, text
        assert "Σ" not in text and "N m" not in text, "no sum of a part of the contacts"
        assert page.run("return document.querySelectorAll('#grain table').length") == 1
        page.shoot("explore-spheres")


def check_walls_and_one_species():
    """A column that falls between walls. With one species there is no B; walls are drawn where grains touch them."""
    tool("sim", f"{ROOT}/sim/scenes/column.ini", "--column-width", "8dS", "--depth", "10dS", "--length", "30dS",
         "--duration", "0.5", "--frame-interval", "0.05", "--accuracy", "draft", "--quiet", "-o", "column.h5")
    tool("explore", "column.h5", "--window", "0.25", "--quiet", "-o", "column.html")
    tool("explore", "column.h5", "--group", "all=1,2", "--window", "0.25", "--quiet", "-o", "one.html")
    with Page("one.html") as page:
        assert "there is one species of grains" in page.text("heart"), page.text("heart")
        assert page.text("legend").startswith("all "), page.text("legend")
        assert "Forces on large grains" not in page.text("report") and "of the large grains" not in page.text("report")
    with h5py.File("column.h5") as file:
        walls = len(set(file["grseg/contacts/j"][:][file["grseg/contacts/j"][:] < 0]))
        length = file["particles/grains/box/edges"][0] if "edges" in file["particles/grains/box"] else None
    with Page("column.html") as page:
        assert "No B for this run" in page.text("heart") and "without large grains" in page.text("heart")
        page.run("grseg.page.transport.goTo(grseg.page.transport.times.length - 1)")
        page.settle()
        known = page.run("const p = grseg.page.players[0]; return p.frames.walls(p.frame).map((wall) => Array.from(wall))")
        assert len(known) == walls > 0, (known, walls)
        check_contacts(page, "column.h5", [page.run("return grseg.page.transport.times.length - 1")])
        vertical = [wall for wall in known if abs(wall[0]) > 0.999]
        assert vertical and all(abs(wall[2]) < 1e-6 or length is None or abs(abs(wall[2]) - length) < 1e-6 for wall in vertical), known
        page.run("grseg.set({grain: 3}); grseg.flush()")
        assert "Grain 3," in page.text("grain")
        page.shoot("explore-column")
        page.run("document.getElementById('tab-report').click()")
        page.settle()
        assert "B is not shown" in page.text("report")
        assert "drum-" not in page.text("report") and "column-width" in page.text("report"), "keys of this geometry only"
        # Without large grains there are no forces on them, and no axes without a plot.
        assert "Forces on large grains" not in page.text("report")
        assert page.run("return Array.from(document.querySelectorAll('#report svg')).every((plot) => plot.querySelector('.tick') && plot.querySelector('path[d]:not([d=\"\"])'))")


def check_two_mixtures():
    """Runs of two mixtures and one run without B: p* of all runs equals that of grseg-fit --scan, and each row says what its interval is over."""
    scene = f"{ROOT}/sim/scenes/chute.ini"
    for phi in ("0.3", "0.7"):
        tool("sim", scene, "--length", "8dL", "--depth", "16dS", "--duration", "2", "--frame-interval", "0.1", "--phi-large", phi,
             "--accuracy", "draft", "--quiet", "-o", f"phi{phi}.h5")
        tool("stress", f"phi{phi}.h5", "--window", "0.5", "--quiet", "-o", f"phi{phi}.tsv")
    tool("explore", "phi0.3.h5", "column.h5", "phi0.7.h5", "--window", "0.25", "--quiet", "-o", "without.html")
    with Page("without.html") as page:
        player = page.run("""const player = grseg.page.players[1], {frames} = player;
          const grain = Array.from({length: frames.grains}, (_, g) => g).find((g) => frames.isShown(player.frame, g) && frames.arrays.species[g] === 0);
          const box = player.canvas.getBoundingClientRect();
          player.canvas.scrollIntoView({block: "center"});
          return [grain, frames.arrays.row[grain], player.px(frames.x(player.frame, grain)) - box.width / 2, player.py(frames.y(player.frame, grain)) - box.height / 2]""")
        canvas = page.driver.find_elements(By.CSS_SELECTOR, "#players canvas")[1]
        ActionChains(page.driver).move_to_element_with_offset(canvas, *map(round, player[2:])).click().perform()
        page.settle()
        assert page.run("return [grseg.state.player, grseg.state.run]") == [1, 0], "the plots stay with a run that has B"
        assert f"Grain {player[1]}," in page.text("grain"), (player, page.text("grain"))
        radius = page.run("const {arrays} = grseg.page.players[1].frames; return arrays.radius[arguments[0]]", player[0])
        d = page.run("return grseg.content.runs[1].small_diameter")
        assert f"radius {radius / d:.2f} dS" in page.text("grain"), "of the grain in that run, not of its number in the other"
    tool("report", "phi0.3.h5", "phi0.7.h5", "--window", "0.5", "--quiet", "-o", "mixtures.html")
    lines = tool("fit", "phi0.3.tsv", "phi0.7.tsv", "--scan", "0:1:0.01", "--quiet")
    header = dict(re.findall(r"^# (\S+): (\S+)$", lines, re.MULTILINE))
    with Page("mixtures.html") as page:
        text = page.text("report")
        heads = page.run("return Array.from(document.querySelector('#report table').querySelectorAll('th'), (head) => head.textContent)")
        assert heads[1:3] == ["flow", "95 % over"], heads
        zero = page.run("return grseg.content.together.fit.scan.p_zero")
        for side, name in enumerate(("p_zero", "p_zero_low", "p_zero_high")):
            own = float("nan") if zero[side] is None else zero[side]
            assert str(own) == str(float(header[name])), (name, own, header[name])
        assert f"p* = {float(header['p_zero']):.3f}" in text
        page.run("document.getElementById('tab-explore').click()")
        page.settle()
        page.run("grseg.set({run: 2}); grseg.flush()")
        check_commands(page, ["size", "power:2"])


def many_grains(name, grains, frames=None):
    """Writes the run with its mobile grains repeated up to `grains`, in its first `frames` frames; without `frames` in all frames, filled with zeros."""
    shutil.copy(RUN, name)
    with h5py.File(name, "r+") as file:
        own = file["particles/grains"]
        kinds = own["species"][:]
        rows = np.resize(np.flatnonzero(kinds < 2), grains)
        for key in list(own):
            item = own[key]["value"] if isinstance(own[key], h5py.Group) and "value" in own[key] else own[key]
            if not isinstance(item, h5py.Dataset) or len(kinds) not in item.shape[:2]:
                continue
            place, attributes = item.name, dict(item.attrs)
            by_grain = item.shape[0] == len(kinds)
            values = item[:][rows] if by_grain else item[:frames][:, rows] if frames else None
            shape = (len(rows),) if by_grain else (frames or item.shape[0], len(rows), *item.shape[2:])
            kind, chunks = item.dtype, None if by_grain else (1, *shape[1:])
            del file[place]
            packed = None if by_grain or frames else "gzip"
            made = file.create_dataset(place, shape, kind, data=values, chunks=chunks, compression=packed,
                                       maxshape=shape if by_grain else (None, *shape[1:]))
            zeros = zlib.compress(bytes(kind.itemsize * int(np.prod(shape[1:])))) if packed else b""
            for frame in range(shape[0] if packed else 0):
                made.id.write_direct_chunk((frame,) + (0,) * (len(shape) - 1), zeros)
            made.attrs.update(attributes)
        if not frames:
            return
        count = len(file["grseg/digest"])
        def shorten(_, item):
            if isinstance(item, h5py.Dataset) and item.shape and item.maxshape[0] is None and item.shape[0] in (count, count + 1):
                item.resize(frames + item.shape[0] - count, axis=0)
        file.visititems(shorten)


def check_sizes():
    """A page of 200,000 grains opens; a page that no browser could open is refused before any frame is read."""
    many_grains("many.h5", 200000, 3)
    tool("explore", "many.h5", "--trust", "--window", "0.3", "--quiet", "-o", "many.html")
    with Page("many.html") as page:
        assert page.run("return grseg.page.players[0].frames.grains") == 200000
    many_grains("too-many.h5", 1200000)
    refused = subprocess.run([f"{BIN}/grseg-explore", "too-many.h5", "--trust", "-o", "no.html"], capture_output=True, text=True)
    assert refused.returncode == 2, refused.stderr
    assert re.search(r"too-many.h5: about 100 frames \(--frames 100\) are 4\d\d MB .* use --frames \d\d, or a part of the run with --begin and --end", refused.stderr), refused.stderr
    assert not os.path.exists("no.html")


def check_several():
    """Two runs: side by side, each by itself, and together, with the results of grseg-fit."""
    scene = f"{ROOT}/sim/scenes/chute.ini"
    for seed in "12":
        tool("sim", scene, "--length", "8dL", "--depth", "16dS", "--duration", "2", "--frame-interval", "0.1",
             "--accuracy", "draft", "--seed", seed, "--quiet", "-o", f"{seed}.h5")
        tool("stress", f"{seed}.h5", "--window", "0.5", "--quiet", "-o", f"{seed}.tsv")
    tool("report", "1.h5", "2.h5", "2.tsv", "--window", "0.5", "--quiet", "-o", "two.html")
    expected = fitted("1.tsv", "2.tsv", "--partition", "size,half")
    with Page("two.html") as page:
        assert page.run("return document.getElementById('explore').hidden"), "grseg-report opens the report"
        assert "All runs together" in page.text("report")
        for rule, row in expected.items():
            if rule != "-":
                close(page.run("return grseg.fit(2, arguments[0]).B", rule), row["B"]["value"], rule)
        page.run("document.getElementById('tab-explore').click()")
        page.settle()
        assert page.run("return document.querySelectorAll('#players canvas').length") == 2
        page.keys("n", "n")
        assert page.run("return grseg.state.run") == 2
        assert "nominal" in page.text("q-note"), "tables have no sums by power:Q"
        page.shoot("explore-two")
    with Page("two.html", link="#explore&run=3&rule=half&grain=2:5") as page:
        assert page.run("return [grseg.state.run, grseg.state.player, document.getElementById('explore').hidden]") == [2, 1, False]
        close(float(page.text("b-value").replace("−", "-")), expected["half"]["B"]["value"], "B of all runs", 6e-4)
    refused = subprocess.run([f"{BIN}/grseg-explore", "1.h5", "2.tsv", "-o", "no.html"], capture_output=True, text=True)
    assert refused.returncode == 3 and "2.tsv: is of the run with the digest xxh3" in refused.stderr, refused.stderr
    assert not os.path.exists("no.html")


def timed(check, *words):
    begin = time.monotonic()
    check(*words)
    print(f"{time.monotonic() - begin:5.1f} s {check.__name__}")


def main():
    tool("stress", RUN, "--quiet", "-o", "sums.tsv")
    tool("explore", RUN, "--quiet", "-o", "page.html", "--overwrite")
    with open("page.html", "rb") as page:
        text = page.read()
    tool("explore", RUN, "--quiet", "-o", "page.html", "--overwrite", "--threads", "2")
    with open("page.html", "rb") as page:
        assert page.read() == text, "the same input gives the same bytes"
    assert not re.search(rb"""(src|href)=["']?https?:""", text), "nothing is loaded from anywhere"
    print(f"page of the sample: {len(text) / 1e6:.2f} MB")
    with Page("page.html") as page:
        check_b(page)
        page.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True})  # whole page: no error message
        timed(check_contacts, page, RUN, (0, 60))
        for check in (check_band, check_interval_between, check_readout, check_names, check_neutral, check_cuts, check_base_cuts,
                      check_plots, check_controls, check_numbers, check_theme, check_captions, check_contrast, check_grain,
                      check_widths, check_report, check_speed):
            timed(check, page)
    with Page("page.html", PHONE) as page:
        page.shoot("explore-390-first")
        page.run("window.scrollTo(0, document.body.scrollHeight)")
        page.until("!document.getElementById('dock').hidden")
        page.run("document.getElementById('tab-report').click()")
        assert page.run("return document.getElementById('dock').offsetParent === null && !document.getElementById('dock').getClientRects().length"), "the slider is of the other tab"
        page.run("document.getElementById('tab-explore').click()")
        page.run("document.getElementById('theme').click()")
        page.settle()
        assert page.run("return getComputedStyle(document.body).backgroundColor") == "rgb(20, 23, 26)"
    of_other_runs = (check_address, check_species, check_edges, check_spheres, check_walls_and_one_species,
                     check_two_mixtures, check_sizes)
    for check in (check_hostile, check_several, *(of_other_runs if ALL else ())):
        timed(check)


if __name__ == "__main__":
    main()
