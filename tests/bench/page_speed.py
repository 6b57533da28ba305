#!/usr/bin/python3
"""Measures the speed of a page of grseg-explore in Chromium, without a graphics card and without a screen.

    tests/bench/page_speed.py explore.html [--size 1280x900]

Prints a Markdown table: times from the start of loading to the first paint and to the complete page; frames per second
while the player draws every frame that the browser requests (60 per second); milliseconds from a move of the slider until
the page has drawn all changes, and until the browser shows them. Needs chromium-driver and python3-selenium.
"""
import argparse
import os
import statistics
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

READY = "return Boolean(document.documentElement.dataset.ready)"
PAINT = "return performance.getEntriesByType('paint')[0].startTime"
SHOW = "for (const name of ['showForces', 'showGrains']) grseg.set({[name]: arguments[0].includes(name)});"
PLAY = SHOW + """
  const done = arguments[1], {transport} = grseg.page;
  const draw = (k, start) => {
    if (k === 120) return done(k / (performance.now() - start) * 1000);
    transport.goTo(k % transport.times.length);
    grseg.flush();
    requestAnimationFrame(() => draw(k + 1, start));
  };
  requestAnimationFrame(() => requestAnimationFrame(() => draw(0, performance.now())));"""
MOVE = """
  const done = arguments[0], program = [], shown = [];
  const move = (k) => {
    if (k === 60) return done([program, shown]);
    const from = performance.now();
    grseg.set({rule: {kind: "uniform", value: 0.4 + k / 120}});
    grseg.flush();
    program.push(performance.now() - from);
    // The first call comes before the browser paints, the second one after it.
    requestAnimationFrame(() => requestAnimationFrame(() => {
      shown.push(performance.now() - from);
      move(k + 1);
    }));
  };
  requestAnimationFrame(() => move(0));"""


def open_page(path, size):
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=" + size.replace("x", ",")):
        options.add_argument(word)
    driver = webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))
    driver.set_script_timeout(120)
    start = time.time()
    driver.get("file://" + os.path.abspath(path))
    while not driver.execute_script(READY):
        time.sleep(0.01)
    return driver, time.time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page")
    parser.add_argument("--size", default="1280x900", help="of the window (1280x900)")
    options = parser.parse_args()
    driver, ready = open_page(options.page, options.size)
    rows = [("first paint", f"{driver.execute_script(PAINT) / 1000:.2f} s"), ("until all is drawn", f"{ready:.2f} s")]
    for what, names in (("grains and forces", "showForces showGrains"), ("grains", "showGrains"), ("forces", "showForces")):
        rows.append((f"frames a second in play, {what}", f"{driver.execute_async_script(PLAY, names):.0f}"))
    driver.execute_script(SHOW + "grseg.flush();", "showForces showGrains")
    for what, times in zip(("program", "shown"), driver.execute_async_script(MOVE)):
        rows.append((f"a move of the slider, {what}, median of {len(times)} (worst)", f"{statistics.median(times):.1f} ms ({max(times):.1f})"))
    driver.quit()
    print(f"| {os.path.basename(options.page)}, {options.size} | |\n|---|---|")
    for row in rows:
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
