#!/usr/bin/python3
"""The page of grseg-explore in a browser: it opens from disk without a complaint, shows B as grseg-fit
prints it, plays, answers to slider, keys and clicks, and fits a phone.
Usage: explore_page_test.py BIN RUN.h5 [FOLDER-FOR-PICTURES]
Exit code 77 where there is no Chromium or no selenium to drive it: the test is skipped.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

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
PICTURES = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else None
FOLDER = tempfile.TemporaryDirectory()  # gone with the script
os.chdir(FOLDER.name)
DESK, PHONE = (1280, 900), (390, 844)
PROFILE = "profile"


def tool(name, *words):
    return subprocess.run([f"{BIN}/grseg-{name}", *words], check=True, capture_output=True, text=True).stdout


def close(a, b, what, tolerance=1e-9):
    assert abs(a - b) <= tolerance * max(1, abs(b)), f"{what}: {a} on the page, {b} by grseg-fit"


class Page:
    """A page in headless Chromium; leaving it asserts that the browser had nothing to complain about."""

    def __init__(self, path, size=DESK):
        options = webdriver.ChromeOptions()
        for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                     f"--user-data-dir={os.path.abspath(PROFILE)}"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = webdriver.chrome.service.Service(DRIVER)
        self.driver = webdriver.Chrome(service=service, options=options)
        self.resize(*size)
        self.driver.get("file://" + os.path.abspath(path))
        self.until("document.documentElement.dataset.ready")

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
        """Two frames of the browser: what has changed is drawn."""
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))")

    def text(self, name):
        return self.run("return document.getElementById(arguments[0]).textContent", name)

    def keys(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()
        self.settle()

    def shoot(self, name):
        if PICTURES:
            os.makedirs(PICTURES, exist_ok=True)
            self.driver.save_screenshot(f"{PICTURES}/{name}.png")


def fitted(*words):
    """What grseg-fit says of each rule: {rule: {estimator: [value, low, high]}}"""
    rows = json.loads(tool("fit", *words, "--json", "--quiet"))["rules"]
    return {row["rule"]: row for row in rows}


def check_b(page):
    """At ten shares and by three rules, and with its own Q."""
    rules = [f"uniform:{p}" for p in (0.05, 0.2, 0.35, 0.45, 0.5, 0.6, 0.648, 0.66667, 0.8, 1)]
    expected = fitted("sums.tsv", "--partition", ",".join(rules + ["size", "contact-point", "half"]))
    for Q in (0, 0.37, 1, 2, 3.3, 4):
        tool("stress", RUN, "--partition", f"power:{Q}", "--quiet", "-o", f"power{Q}.tsv")
        expected.update(fitted(f"power{Q}.tsv", "--partition", f"power:{Q}"))
    largest = 0
    for rule, row in expected.items():
        shown = page.run("return grseg.fit(0, arguments[0])", rule)
        for name in ("slope", "B_half", "B_mean", "slope_linear", "B_linear", "B_direct", "B_sums"):
            close(shown[name], row["estimators"][name]["value"], f"{name} by {rule}")
            largest = max(largest, abs(shown[name] - row["estimators"][name]["value"]))
        close(shown["share"], row["share"], f"share by {rule}")
        assert shown["points"] == row["points"], rule
    dropped = page.run("return grseg.fit(0, 'drop')")
    assert dropped["B_sums"] is None and dropped["B_half"] is None, "drop has no B"
    print(f"B of {len(expected)} rules: largest difference from grseg-fit {largest:.1e}")


def check_band(page):
    """The band and the intervals are those of grseg-fit."""
    lines = tool("fit", "sums.tsv", "--scan", "0:1:0.01", "--quiet").splitlines()
    rows = [line.split("\t") for line in lines if not line.startswith("#")]
    at = {name: k for k, name in enumerate(rows[0])}
    scan = page.run("return grseg.content.runs[0].fit.scan")
    for k, row in enumerate(rows[1:]):
        for name, place in (("B_sums", "B_sums"), ("B_half", "B")):
            low, high = ("low", "high") if place == "B" else (f"{place}_low", f"{place}_high")
            for side, column in enumerate((place, low, high)):
                assert scan[name][k][side] == float(row[at[column]]), (name, row[0])
    zero = [float(value) for line in lines for value in re.findall(r"^# p_zero_sums: (\S+)", line)][0]
    page.keys("0")
    close(page.run("return grseg.state.rule.value"), zero, "p*")
    assert page.text("b-value") in ("0.000", "−0.000"), page.text("b-value")
    page.keys("3")
    row = fitted("sums.tsv", "--partition", "half")["half"]["estimators"]["B_sums"]
    number = lambda value: f"{value:.3f}".replace("-", "−")
    assert page.text("b-value") == number(row["value"]), page.text("b-value")
    assert page.text("b-interval") == "[{}, {}]".format(*map(number, row["interval"])), page.text("b-interval")


def check_controls(page):
    driver = page.driver
    slider = driver.find_element(By.ID, "p")
    left, bar = slider.rect["x"], slider.rect["width"]
    # The thumb is 18 pixels wide, so that its middle goes from 9 pixels after the left end on.
    place = left + 9 + 0.8 * (bar - 18)
    page.run("document.getElementById('p').scrollIntoView({block: 'center'})")
    ActionChains(driver).move_to_element(slider).click_and_hold().move_by_offset(
        int(place - left - bar / 2), 0).release().perform()
    page.settle()
    rule = page.run("return grseg.state.rule")
    assert rule["kind"] == "uniform" and abs(rule["value"] - 0.8) < 0.01, rule
    close(float(page.text("b-value").replace("−", "-")), page.run("return grseg.fit(0, `uniform:${grseg.state.rule.value}`).B_sums"), "B under the slider", 6e-4)
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


def check_grain(page):
    """A click finds the grain that lies there, with the contacts that the file has of it."""
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
        row = int(i[mixed][0])
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
    kinetic = tool("kinetic", RUN, "--window", "20", "--quiet").splitlines()
    rows = [line.split("\t") for line in kinetic if not line.startswith("#")]
    shown = page.run("return grseg.content.runs[0].layers.tables.find((t) => t.name === 'kinetic')")
    at = rows[0].index("u[m/s]")
    for own, row in zip(shown["rows"], rows[1:]):
        close(own[shown["columns"].index("u[m/s]")], float(row[at]), "mean velocity of a layer")
    over = page.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    assert over <= 0, over
    page.shoot("report-1280")
    page.run("document.getElementById('tab-explore').click()")


def check_speed(page):
    """Milliseconds of a frame of the player, and from a move of the slider to all that it changes."""
    paint = page.run("return performance.getEntriesByType('paint').map((e) => [e.name, e.startTime])")
    frame = page.run("""
      const n = 40, {transport} = grseg.page; const from = performance.now();
      for (let k = 0; k < n; ++k) { transport.goTo(k % transport.times.length); grseg.flush(); }
      return (performance.now() - from) / n""")
    move = page.run("""
      const n = 40; const from = performance.now();
      for (let k = 0; k < n; ++k) { grseg.set({rule: {kind: "uniform", value: 0.4 + k / 100}}); grseg.flush(); }
      return (performance.now() - from) / n""")
    first = ", ".join(f"{name} {when:.0f} ms" for name, when in paint)
    print(f"{first}; a frame {frame:.1f} ms, a move of the slider {move:.1f} ms")
    assert frame < 200 and move < 200, "far too slow, even for a loaded machine"


def check_hostile():
    """What a file is called, and what it says, is text and nothing else."""
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
    """Of three species the pair that was chosen is that of grseg-fit; Q is then that of nominal radii."""
    tool("stress", RUN, "--classes", "3", "--quiet", "-o", "three.tsv")
    tool("explore", RUN, "--classes", "3", "--pair", "1,3", "--quiet", "-o", "three.html")
    expected = fitted("three.tsv", "--pair", "1,3", "--partition", "size,half,uniform:0.7")
    with Page("three.html") as page:
        for rule, row in expected.items():
            for name in ("B_sums", "B_half"):
                close(page.run("return grseg.fit(0, arguments[0])", rule)[name], row["estimators"][name]["value"], rule)
        assert "nominal" in page.text("q-note")
        assert "--pair" in page.text("command")


def check_several():
    """Two runs: side by side, each by itself, and together as grseg-fit has it."""
    scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../sim/scenes/chute.ini")
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
            for name in ("B_sums", "B_half"):
                close(page.run("return grseg.fit(2, arguments[0])", rule)[name], row["estimators"][name]["value"], rule)
        page.run("document.getElementById('tab-explore').click()")
        page.settle()
        assert page.run("return document.querySelectorAll('#players canvas').length") == 2
        page.keys("n", "n")
        assert page.run("return grseg.state.run") == 2
        assert "nominal" in page.text("q-note"), "tables have no sums by power:Q"
        page.shoot("explore-two")
    refused = subprocess.run([f"{BIN}/grseg-explore", "1.h5", "2.tsv", "-o", "no.html"], capture_output=True, text=True)
    assert refused.returncode == 3 and "2.tsv: is of the run with the digest xxh3" in refused.stderr, refused.stderr
    assert not os.path.exists("no.html")


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
        check_band(page)
        check_controls(page)
        check_grain(page)
        check_widths(page)
        check_report(page)
        check_speed(page)
    with Page("page.html", PHONE) as page:
        page.shoot("explore-390-first")
        page.run("document.getElementById('theme').click()")
        page.settle()
        assert page.run("return getComputedStyle(document.body).backgroundColor") == "rgb(20, 23, 26)"
    check_hostile()
    check_species()
    check_several()


main()
