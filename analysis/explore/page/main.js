// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the data of the page, builds its elements, and updates them when the reader chooses something.

import {boxes, keepAddress, restore} from "./address.js";
import {Compare} from "./compare.js";
import {readArrays, readContent} from "./data.js";
import {byId, element, forgetColours, keys} from "./format.js";
import {Frames} from "./frames.js";
import {GrainPanel} from "./grain.js";
import {listenToKeys} from "./keyboard.js";
import {fitOf, intervalOf, neutralSums, parseRule, shareOf, stressOf, zeroOf} from "./partition.js";
import {Player} from "./player.js";
import {Profiles} from "./profiles.js";
import {layoutReport, listenToPrinting, writeReport} from "./report.js";
import {Scatter} from "./scatter.js";
import {Share} from "./share.js";
import {flush, listen, set, state} from "./state.js";
import {Transport} from "./transport.js";

const content = readContent();
const {runs} = content;
const all = [...runs, ...(content.together ? [content.together] : [])];

/** Reads the arrays of each run and, if there are several runs, of all together; each fit gets the same arrays. */
async function readAll() {
  const arrays = await Promise.all(all.map((one, k) => readArrays(k, one.arrays)));
  all.forEach((one, k) => {
    one.arrays = arrays[k];
    if (one.fit) one.fit.arrays = arrays[k];
  });
}

function showTab(name) {
  for (const tab of ["explore", "report"]) {
    byId(tab).hidden = tab !== name;
    byId(`tab-${tab}`).setAttribute("aria-selected", String(tab === name));
    byId(`tab-${tab}`).tabIndex = tab === name ? 0 : -1;
  }
  byId("to-report").hidden = name === "report";
  set({tab: name});
  window.scrollTo(0, 0);
  window.dispatchEvent(new Event("resize")); // draws the tab, which may have changed while hidden
}

function listenToTabs() {
  for (const tab of ["explore", "report"]) {
    const button = byId(`tab-${tab}`);
    button.addEventListener("click", () => showTab(tab));
    button.addEventListener("keydown", (event) => {
      if (!["ArrowLeft", "ArrowRight"].includes(event.key)) return;
      const other = byId(`tab-${tab === "explore" ? "report" : "explore"}`);
      other.click();
      other.focus();
    });
  }
  byId("to-report").addEventListener("click", (event) => {
    event.preventDefault();
    showTab("report");
  });
}

function isDark() {
  const {theme} = document.documentElement.dataset;
  return theme ? theme === "dark" : window.matchMedia("(prefers-color-scheme: dark)").matches;
}

function describeColours() {
  const looks = runs.flatMap((run) => {
    const pair = run.fit?.numbers_of_pair ?? [0, 1];
    const present = new Set(run.arrays.species);
    return run.species
      .map(({name}, k) => [name, ["small", "large"][pair.indexOf(k)] ?? "other", k])
      .concat([["base", "base", 255]])
      .filter(([, , k]) => present.has(k));
  });
  // Runs may name their species differently; each name appears once, the base last.
  const names = new Map(looks.map(([name, look]) => [`${look} ${name}`, [name, look]]));
  const inOrder = [...names.values()].sort(([, a], [, b]) => (a === "base") - (b === "base"));
  byId("legend").replaceChildren(
    ...keys(inOrder.map(([name, look]) => [look, name]), "key"),
    "– each line is a contact; its width shows the normal force, its colour the species to whose stress it counts.",
    runs.some((run) => run.dimension === 3) ? " Of spheres there is the slice in the middle of the cell that is as thick as a large one, its far grains pale; forces are components in the plane of the page." : "",
  );
}

/** Unit (m) and label of heights in plots: d_S, or metres if the runs differ in d_S; r instead of y if bins are annuli. */
function heightOf(some) {
  const sizes = some.map((run) => run.small_diameter);
  const same = Math.max(...sizes) < 1.001 * Math.min(...sizes);
  const letter = some.every((run) => run.bins === "radius") ? "r" : "y";
  return same ? {unit: sizes[0], name: `${letter}/d_S`} : {unit: 1, name: `${letter} (m)`};
}

/** Content of the tab "explore": players of all runs, plots and controls. */
class Page {
  constructor() {
    this.fits = all.map((one) => one.fit ?? null);
    this.showTab = showTab;
    this.ruleWords = content.rules.filter((rule) => rule.stock).map((rule) => rule.word);
    const rule = parseRule(content.start);
    const first = this.fits.findIndex(Boolean);
    Object.assign(state, {rule, run: Math.max(0, first), player: Math.max(0, first)});
    this.players = runs.map(
      (run, k) => new Player(run, new Frames(run), (grain) => set({grain: grain === state.grain && k === state.player ? -1 : grain, player: k, ...this.chosen(k)})),
    );
    this.#placePlayers();
    this.transport = new Transport(this.players.map((player) => player.frames));
    this.grain = new GrainPanel(content);
    this.compare = new Compare(all.map(({name = "all together", fit, why_no_fit: why}) => ({name, fit, why})));
    if (first >= 0) this.#makePlots();
    this.#hideWhatIsMissing();
    for (const [, id, name] of boxes)
      byId(id).addEventListener("change", (event) => set({[name]: event.target.checked}));
    listen((names) => this.#follow(names));
  }

  get fit() {
    return this.fits[state.run];
  }
  get run() {
    return runs[state.run] ?? null;
  }
  /** Change of the state after a click on run k. The plots do not switch to run k if it has no fit and another run has one. */
  chosen(k) {
    return this.fits[k] || !this.fits.some(Boolean) ? {run: k} : {};
  }

  #placePlayers() {
    this.players.forEach((player, k) => {
      player.canvas.setAttribute("aria-label", `The flow of ${runs[k].name}`);
      const caption = runs.length > 1 ? element("figcaption", {}, runs[k].name) : null;
      byId("players").append(element("figure", {}, player.canvas, caption));
    });
    byId("players").classList.toggle("several", runs.length > 1);
  }

  #makePlots() {
    const fit = () => this.fit;
    const own = () => (this.run ? [this.run] : runs);
    this.share = new Share(content, fit, own);
    this.scatter = new Scatter(fit, () => this.run?.window_times ?? []);
    const names = () => fit().numbers_of_pair.map((k) => own()[0].species[k].name);
    this.profiles = new Profiles(fit, () => heightOf(own()), () => (own()[0].dimension === 3 ? "Pa" : "N/m"), names);
  }

  #hideWhatIsMissing() {
    if (this.share) return;
    for (const card of document.querySelectorAll("#explore .card:not(.flow):not(.heart)")) card.hidden = true;
    byId("explore").classList.add("flow-only");
    byId("heart").replaceChildren(element("h2", {}, "No B for this run"), element("p", {}, `Because: ${runs[0].why_no_fit}.`));
  }

  layout() {
    if (byId("explore").hidden) return;
    const tallest = Math.max(260, Math.min(0.66 * window.innerHeight, 620)) / (runs.length > 2 ? 1.6 : 1);
    if (!(byId("players").clientWidth > 0)) return; // as while a browser takes a picture of the whole page
    this.players.forEach((player) => player.resize(Math.floor(player.canvas.parentElement.clientWidth), tallest));
    if (this.share) {
      this.share.layout(this.fits.filter((fit, k) => fit && k !== state.run));
      this.scatter.layout();
      this.profiles.layout();
    }
    this.update();
  }

  drawPlayers() {
    this.players.forEach((player, k) => {
      player.active = k === state.player;
      player.canvas.parentElement.classList.toggle("chosen", runs.length > 1 && k === state.run);
      player.draw();
    });
    this.grain.update(this.players[state.player]);
  }

  update() {
    this.transport.show();
    this.drawPlayers();
    if (!this.share) return;
    const stress = stressOf(this.fit, state.rule);
    const found = fitOf(this.fit, state.rule);
    this.share.update(stress, found);
    this.scatter.update(stress, found);
    this.profiles.update(stress, found);
    this.compare.update();
  }

  #follow(names) {
    if (byId("explore").hidden) return;
    if (names.has("run")) return this.layout();
    if (names.has("rule")) return this.update();
    if (names.has("time")) this.transport.show();
    this.drawPlayers();
    if (this.share && (names.has("layer") || names.has("time"))) {
      const stress = stressOf(this.fit, state.rule);
      this.scatter.update(stress, fitOf(this.fit, state.rule));
    }
  }
}

function listenToAll(page) {
  window.addEventListener("resize", () => (byId("explore").hidden ? layoutReport() : page.layout()));
  const recolour = () => {
    forgetColours();
    page.layout();
  };
  const theme = () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    recolour();
  };
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  byId("theme").addEventListener("click", theme);
  byId("help-open").addEventListener("click", () => byId("help").showModal());
  listenToPrinting();
  listenToKeys({
    fit: () => page.fit,
    zero: () => zeroOf(page.fit)[0],
    step: (by) => page.transport.step(by),
    play: () => page.transport.toggle(),
    nextGrain: (by) => {
      const n = page.players[state.player].frames.grains;
      if (n) set({grain: (Math.max(state.grain, by > 0 ? -1 : 0) + by + n) % n});
    },
    nextRun: () => {
      const n = page.fits.length;
      let k = state.run;
      do k = (k + 1) % n;
      while (!page.fits[k] && k !== state.run);
      set({run: k, ...(k < runs.length ? {player: k, grain: -1} : {})});
    },
    tab: showTab,
    theme,
    rules: page.ruleWords,
  });
}

async function start() {
  listenToTabs();
  await readAll();
  describeColours();
  const page = new Page();
  listenToAll(page);
  writeReport(content, content.together);
  page.transport.goTo(Math.floor(page.transport.times.length / 2));
  showTab(content.tab ?? "explore");
  restore(page);
  flush();
  keepAddress(page);
  // For the console and for tests: fit(0, "uniform:0.65") gives the numbers shown for the first run.
  window.grseg = {
    content,
    state,
    set,
    flush,
    page,
    interval: (k, text) => intervalOf(page.fits[k], parseRule(text)),
    neutral: (k, p) => neutralSums(page.fits[k], p),
    fit: (k, text) => ({...fitOf(page.fits[k], parseRule(text)), share: shareOf(page.fits[k], parseRule(text))}),
  };
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
  byId("trouble").hidden = false;
  byId("trouble").textContent = error.message;
  throw error;
});
