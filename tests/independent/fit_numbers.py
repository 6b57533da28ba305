"""Numbers of grseg-fit, without their intervals, from rows of grseg-stress or grseg-kinetic, by their definitions
(docs/equations.md, Estimators). One run; the equations stand at each function.
"""
import math

import numpy as np


class Points:
    """Points of a pair of species: layers and windows that pass the filters. `rows`: rows by window; `names`: the
    species' names in columns; `diameters`: of all species, m; `how`: the options of grseg-fit."""

    def __init__(self, rows, columns, diameters, pair, how):
        self.rows, self.columns, self.pair, self.how = rows, columns, pair, how
        self.dimension, self.sizes = len(columns.axes), [diameters[s] for s in pair]
        self.radial, self.small_diameter = how["radial"], how["small_diameter"]
        inside = [row for window in rows for row in window if self.in_times(row)]
        filled = [self.solid(row) for row in inside if self.solid(row) > 0]
        self.median = float(np.median(filled)) if filled else 0.0
        self.low, self.high = self.heights(inside)
        self.used = [(w, n) for w, window in enumerate(rows) for n, row in enumerate(window) if self.is_used(row)]

    def in_times(self, row):
        slack = 1e-9 * (1 + abs(row["t0"]) + abs(row["t1"]))
        return row["t0"] >= self.how["begin"] - slack and row["t1"] <= self.how["end"] + slack

    def content(self, row, s):
        """Area or volume of a species; masses if a kinetic table has neither."""
        name = self.columns.names[s]
        return row.get(f"{self.columns.content}_{name}", row.get(f"mass_{name}"))

    def solid(self, row):
        return sum(self.content(row, s) for s in range(len(self.columns.names))) / row["V"]

    def phi(self, row):
        small, large = (self.content(row, s) for s in self.pair)
        return large / (small + large)

    def heights(self, rows):
        """Lowest and highest edge of the layers to use."""
        if self.how["heights"] is not None:
            return self.how["heights"]
        margin, means = 4 * self.small_diameter, {}
        for row in rows:
            mean = means.setdefault(row["y0"], [0.0, 0.0, row["y1"]])
            mean[0] += row["frames"]
            mean[1] += row["frames"] * self.solid(row)
        layers = [(y0, y1, solid / frames) for y0, (frames, solid, y1) in sorted(means.items())]
        first = min((y0 for y0, _, solid in layers if solid >= self.median / 2), default=math.inf)
        if not self.radial:
            return first + margin, first + sum(s / self.median * (y1 - y0) for y0, y1, s in layers) - margin
        full = [k for k, (_, _, solid) in enumerate(layers) if solid > 0]
        if not full:
            return math.inf, -math.inf
        y0, y1, solid = layers[full[-1]]
        part = min(1.0, solid / layers[full[-1] - 1][2]) if full[-1] > 0 and layers[full[-1] - 1][2] > 0 else 1.0
        return (first + margin if first > 0 else 0.0), y0 + part * (y1 - y0) - margin

    def is_used(self, row):
        small, large = (self.content(row, s) for s in self.pair)
        slack = 1e-9 * (row["y1"] - row["y0"])
        return (self.in_times(row) and small > 0 and large > 0 and row["y0"] >= self.low - slack
                and row["y1"] <= self.high + slack and self.how["ratio"][0] <= small / large <= self.how["ratio"][1]
                and self.solid(row) >= self.how["min_solid"] * self.median)

    def component(self, row, key):
        tensor = self.columns.tensor(row, key if isinstance(key, str) else self.columns.sum(key)) if key else 0
        return tensor[1, 1] if self.how["component"] == "yy" else np.trace(tensor) / self.dimension

    def stresses(self, row, rule):
        """Stress times V of the smaller and the larger species and of all, and the sum of their terms' magnitudes."""
        count = len(self.columns.names)
        if self.how["kinetic"]:
            own = [self.component(row, f"K_{name}") for name in self.columns.names]
            return self.sums(own, 0.0, own)
        word, _, number = rule.partition(":")
        at_centres, terms = self.how["grain"], []

        def of(key, factor=1.0):
            terms.append(factor * self.component(row, key))
            return terms[-1]

        p = {"half": 0.5, "uniform": float(number or 0)}.get(word)
        inside = "H" if at_centres and p is not None else "A"
        own, dropped = [of((inside, s)) for s in range(count)], 0.0
        for b in range(count):
            for a in range(b):
                if p is not None and at_centres:
                    own[a] += of(("MS", a, b), 1 - p)
                    own[b] += of(("ML", a, b), p)
                    continue
                whole = of(("M", a, b))
                if word == "drop":
                    dropped += whole
                    continue
                larger = p * whole if p is not None else of(
                    ({"size": "Msize", "contact-point": "Mcp", "power": "Mpower"}[word], a, b))
                own[a] += whole - larger
                own[b] += larger
        key, factor = {"contact-point": ("A_b", 1.0), "half": ("F_b", 0.5), "none": ("F_b", 0.0)}[self.how["base"]]
        own = [one + of((key, s), factor) for s, one in enumerate(own)]
        return self.sums(own, dropped, terms)

    def sums(self, own, dropped, terms):
        small, large = (own[s] for s in self.pair)
        return small, large, small + large + (dropped if len(own) == 2 else 0), sum(map(abs, terms))

    def within(self, w, n, rule):
        """phi_L' sigma' m/sigma: differences between the layers above and below; m = h^2/12, about an axis
        h^2/12 - h^2/(144 N^2) with N the number of thicknesses from the axis to the middle of the annulus."""
        window, N = self.rows[w], n + 0.5
        ends = [k for k in (n - 1, n + 1) if 0 <= k < len(window) and sum(
            self.content(window[k], s) for s in self.pair) > 0
            and self.solid(window[k]) >= self.how["min_solid"] * self.median]
        stress = [self.stresses(window[k], rule)[2] / window[k]["V"] for k in (n, *ends)]
        if not ends or not stress[0] > 0:
            return 0.0
        low, high = min(n, *ends), max(n, *ends)
        at = {k: k + (1 / (12 * (k + 0.5)) if self.radial else 0) for k in (low, high)}
        of = dict(zip((n, *ends), stress))
        spread = 1 / 12 - (1 / (144 * N * N) if self.radial else 0)
        return (spread * (self.phi(window[high]) - self.phi(window[low])) * (of[high] - of[low])
                / (at[high] - at[low])**2 / stress[0])

    def arrays(self, rule, removed):
        """By point: phi_L, frames, weight, stresses, psi_L - phi_L without the part within the layer, and the
        magnitude of its terms."""
        points = []
        for w, n in self.used:
            row = self.rows[w][n]
            small, large, total, terms = self.stresses(row, rule)
            phi, within = self.phi(row), self.within(w, n, rule) if removed else 0.0
            rarer = min(self.content(row, s) / d**self.dimension for s, d in zip(self.pair, self.sizes))
            with np.errstate(divide="ignore", invalid="ignore"):
                psi = np.float64(large) / total
                size = np.float64(terms) / abs(total) * (1 + abs(psi) + abs(within)) + phi
            points.append((phi, row["frames"], row["frames"] * rarer, small, large, total, psi - within - phi, size))
        return np.array(points).T

    def b(self, rule, removed=None):
        """B = sum f (psi_L - phi_L)/sum f phi_L phi_S over points under pressure, and the magnitude of its terms."""
        phi, frames, _, _, _, total, excess, size = self.arrays(rule, self.how["removed"] if removed is None else removed)
        there = total > 0
        product = (frames * phi * (1 - phi))[there].sum()
        if not product > 0:
            return math.nan, 1.0
        return (frames * excess)[there].sum() / product, (frames * size)[there].sum() / product

    def paper(self, rule):
        """s = exp(mean of ln(y/x)), B of it at both ends, and the weighted line through the logarithms."""
        phi, _, weight, small, large, *_ = self.arrays(rule, False)
        there = (small > 0) & (large > 0)
        if not there.any():
            return dict.fromkeys(("paper_s", "paper_B", "paper_k", "paper_a"), (math.nan, 1.0))
        w, x = weight[there] / weight[there].sum(), np.log((1 - phi) / phi)[there]
        y = np.log(small[there] / large[there])
        s = math.exp(w @ (y - x))
        variance = w @ (x - w @ x)**2
        a = w @ ((x - w @ x) * (y - w @ y)) / variance if there.sum() > 1 else math.nan
        k = math.exp(w @ y - a * (w @ x)) if there.sum() > 1 else math.nan
        # Condition of the logarithms: the terms of a partial stress may cancel.
        terms = max(self.stresses(self.rows[u][n], rule)[3] / min(lo, hi)
                    for (u, n), lo, hi in zip(self.used, small, large) if lo > 0 and hi > 0)
        size = terms + abs(x).max() + abs(y).max()
        of_line = size * (1 + abs(x).max())**2 / variance * (1 + abs(y).max()) if variance > 0 else 1.0
        return {"paper_s": (s, s * size), "paper_B": ((1 - s + (1 - s) / s) / 2, size * (s + 1 / s)),
                "paper_a": (a, of_line), "paper_k": (k, k * of_line * (1 + abs(x).max()))}

    def numbers(self, rule):
        """{quantity: (value, magnitude of its terms)} under one rule."""
        found = self.paper(rule)
        if rule == "drop" and not self.how["kinetic"]:
            del found["paper_B"]
            return found
        found["B"] = self.b(rule)
        (kept, size), (removed, more) = self.b(rule, False), self.b(rule, True)
        found["B_of_thickness"] = kept - removed, size + more
        if self.how["kinetic"]:
            return found
        by_size = self.b("size")
        found["B_minus_size"] = found["B"][0] - by_size[0], found["B"][1] + by_size[1]
        if len(self.columns.names) == 2:
            r = self.sizes[1] / self.sizes[0]
            word, _, number = rule.partition(":")
            power = {"power": float(number or 0)}.get(word, 1.0)
            p = {"half": 0.5, "uniform": float(number or 0)}.get(word, r**power / (1 + r**power))
            phi, frames, *_, total, _, _ = self.arrays(rule, False)
            f = (frames * phi * (1 - phi))[total > 0]
            phi = phi[total > 0]
            b = (p - r / (1 + r)) * (1 + r) / (phi + r * (1 - phi))
            found["neutral"] = (f @ b / f.sum() if f.sum() > 0 else math.nan), 1 + r
        if len(self.columns.names) == 2 and not self.how["grain"]:
            (none, size), (every, more) = self.b("uniform:0"), self.b("uniform:1")
            line, size = every - none, size + more + found["B"][1]
            found["share"] = (found["B"][0] - none) / line, size / abs(line) * (1 + abs(found["B"][0] - none) / abs(line))
            found["p_zero"] = -none / line, size / abs(line) * (1 + abs(none / line))
            found["dB_dp"] = line, size
        return found
