"""Random small scenes within the ranges of all keys (sim/scene/keys/keys.cpp), including the ends of the ranges.

Times, speeds and rates are drawn in units of d_S and gravity, so that most scenes flow.
"""
import dataclasses
import math
import random

# Time steps of --accuracy, in sqrt(d_S/g) (sim/scene/keys/keys.hpp).
STEPS = {"draft": 0.01771, "standard": 0.01107, "reference": 0.00443}
LONGEST_STEP = 0.05  # longest time step, in sqrt(d_S/g)
SHORTEST_STEP = {2: 1e-3, 3: 8e-3}  # shortest time step of discs, and of spheres, whose depositions take longer
MOST_SMALL = {2: 250, 3: 60}  # most small grains of discs, and of spheres, whose depositions take longer
STEPS_OF_A_GRAIN = {2: 6e4, 3: 1.5e4}  # steps that a scene of one grain would make in half a second
SOLID = {2: 0.81 * 4 / math.pi, 3: 0.61 * 6 / math.pi}  # number of grains of diameter 1 per unit of area or volume
# Widest size ratio for which small spheres do not fall through a boundary of large ones, for a spread of 0
# (sim/scene/base_row.cpp).
MOST_RATIO = 4.4


class Dice:
    """A stream of random numbers. It uses only random(), which is the same in all versions of Python."""

    def __init__(self, seed, number):
        self._next = random.Random(f"{seed}-{number}").random

    def chance(self, probability):
        return self._next() < probability

    def uniform(self, low, high):
        return low + (high - low) * self._next()

    def log(self, low, high):
        """A number whose logarithm is uniform."""
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def whole(self, low, high):
        return low + int(self._next() * (high - low + 1))

    def pick(self, *options):
        return options[int(self._next() * len(options))]

    def weighted(self, **weights):
        """A word, with a probability in proportion to its weight."""
        left = self._next() * sum(weights.values())
        for word, weight in weights.items():
            left -= weight
            if left < 0:
                return word
        return word

    def sign(self):
        return self.pick(-1, 1)


@dataclasses.dataclass
class Scene:
    """Keys of grseg-sim, and the way to run the scene:
    once      one run
    restart   one run, and again in two halves with a checkpoint between them; both must give the same bytes
    twin      one run, and again with other threads and instruction sets; all must give the same bytes
    changed   one run in two halves; the second half has the keys `changes`
    """
    keys: dict
    frames: int
    interval: float  # time between frames, s
    way: str
    changes: dict
    twin: list  # options of the other runs of `twin`


def number(value):
    """Text of a number with four digits, so that a person can read the command."""
    return f"{value:.4g}"


def multiple(interval, count):
    """Text of the duration of `count` frames, s."""
    return f"{interval * count:.15g}"


class Units:
    """Units for the other keys: length d_S (m), gravity (m/s^2), time (s), speed (m/s)."""

    def __init__(self, small, gravity):
        self.small, self.gravity = small, gravity
        self.time = math.sqrt(small / gravity)
        self.speed = math.sqrt(small * gravity)


def random_scene(seed, count, dimension=2):
    dice = Dice(seed, count)
    keys = {"geometry": dice.weighted(bed=44, drum=12, shear=14, column=18, hopper=12)}
    if dimension == 3:
        keys["dimension"] = "3"
    add_grains(dice, keys)
    depth, grains = add_shape(dice, keys)
    units = add_units(dice, keys, depth)
    add_law(dice, keys)
    add_drive(dice, keys, units, depth)
    step = add_solver(dice, keys, units)
    frames, apart = frames_of(dice, keys, grains)
    interval = float(multiple(step, apart))
    keys |= {"frame-interval": repr(interval), "duration": multiple(interval, frames), "seed": str(dice.whole(1, 10**6))}
    if dice.chance(0.04):
        keys["store"] = "float32"
    if dice.chance(0.04):
        keys["compression"] = str(dice.whole(1, 9))
    if dice.chance(0.02) and keys["geometry"] not in ("shear", "hopper"):
        keys["keep-deposition"] = None
    way = dice.weighted(once=50, restart=18, changed=22, twin=10)
    return Scene(keys, frames, interval, way, random_changes(dice, keys, units, depth),
                 [["--threads", dice.pick("2", "0")], ["--isa", dice.pick("scalar", "sse4", "avx2")]])


def dimension_of(keys):
    return int(keys.get("dimension", 2))


def length_of(keys, key):
    """Length of a key, in d_S."""
    return float(keys[key].removesuffix("dS"))


def add_grains(dice, keys):
    ratio = {"one": 1, "usual": dice.uniform(1, 4), "wide": dice.log(1, 10), "extreme": dice.log(10, 100)}
    keys["size-ratio"] = number(ratio[dice.weighted(one=15, usual=45, wide=38, extreme=2)])
    keys["spread"] = number(dice.pick(0, 0.08, 0.2, dice.uniform(0, 0.5), dice.uniform(0, 0.9)))
    if dice.chance(0.55):
        keys["density-ratio"] = number(dice.log(1e-3, 1e3))
    if dimension_of(keys) == 3 and keys["geometry"] in ("drum", "shear", "hopper"):
        most = MOST_RATIO * (1 - float(keys["spread"]) / 2)
        keys["size-ratio"] = number(min(float(keys["size-ratio"]), most))
    keys["initial"] = dice.pick("large-below", "mixed", "large-above")
    if dice.chance(0.1):
        keys["rotation"] = "off"


def add_shape(dice, keys):
    """Draws lengths and the share of large grains. Returns the depth of the bed in d_S and the number of grains."""
    ratio, dimension = float(keys["size-ratio"]), dimension_of(keys)
    wanted = dice.log(10, 200)
    shares = {"small": 0, "large": 1, "mixture": dice.uniform(0, 1)}
    share = shares[dice.weighted(small=12, large=8, mixture=80)]
    across = add_width(dice, keys, ratio) if dimension == 3 else 1
    # Number of grains in a volume (discs: area) of 1, over SOLID.
    per_volume = 1 - share + share / ratio**dimension
    shape = {"drum": drum_shape, "column": column_shape, "hopper": hopper_shape}.get(keys["geometry"], bed_shape)
    area, depth = shape(dice, keys, ratio, wanted / per_volume / SOLID[dimension] / across)
    count = area * across * SOLID[dimension]  # of small grains alone
    # A cell that is wide because large grains are wide would need too many small grains, so their share is reduced.
    share = max(share, 1 - MOST_SMALL[dimension] / count)
    if dice.chance(0.15) and share < 1:
        volume = ratio**dimension  # of a large grain
        large = max(1, round(share * count / volume))
        # Rounding down would leave room for thousands of small grains beside one large grain less.
        large += count - large * volume > 10 * MOST_SMALL[dimension]
        keys["large-grains"] = str(large)
    else:
        keys["phi-large"] = f"{share:.6g}"
    if keys["geometry"] != "drum" and keys.get("base") != "wall":
        keys["origin"] = dice.pick("top", "centre")
    return depth, count * (1 - share + share / ratio**dimension)


def add_width(dice, keys, ratio):
    """Draws the width of a cell of spheres, in d_S."""
    width = dice.log(4.01, 5) * ratio
    keys |= {"width": number(width) + "dS", "sides": dice.pick("periodic", "periodic", "walls")}
    return width


def random_length(dice, keys, ratio):
    """Draws the length of a cell, in d_S. Cells of spheres are short, because they are wide."""
    return dice.log(4.01, 6 if dimension_of(keys) == 3 else 12) * ratio


def bed_shape(dice, keys, ratio, area):
    length = random_length(dice, keys, ratio)
    depth = min(max(area / length, 2 * ratio, 3), 40 * ratio)
    keys |= {"length": number(length) + "dS", "depth": number(depth) + "dS"}
    if keys["geometry"] == "bed":
        keys["lateral"] = dice.pick("periodic", "periodic", "walls")
        add_base(dice, keys, ratio, length)
    return length * depth, depth


def add_base(dice, keys, ratio, length):
    """Draws base grains of any size, height and spacing that leave no hole for a grain. Bases of spheres have one shape."""
    kind = dice.weighted(touching=45, wall=15, shaped=40)
    if kind == "wall" or falls_through(keys, ratio):
        keys["base"] = "wall"
    if kind != "shaped" or dimension_of(keys) == 3:
        return
    diameter = min(dice.log(0.3, 2) * dice.pick(1, ratio), 0.19 * length)
    smallest = 1 - float(keys["spread"]) / 2
    spread, height, apart = (dice.pick(0, dice.uniform(0, most)) for most in (0.4, 0.5 * smallest, 0.3))
    widest = diameter * (1 - spread / 2) + 0.85 * smallest - height
    spacing = min(dice.uniform(0.5, 1) * widest / (1 + apart), 0.2 * length)
    keys |= {"base-diameter": number(diameter) + "dS", "base-diameter-spread": number(spread),
             "base-height-spread": number(height) + "dS", "base-spacing": number(spacing) + "dS",
             "base-spacing-spread": number(apart)}


def falls_through(keys, ratio):
    """True if the smallest spheres fall through a base of large spheres."""
    return dimension_of(keys) == 3 and ratio > MOST_RATIO * (1 - float(keys["spread"]) / 2)


def drum_shape(dice, keys, ratio, area):
    fill = dice.uniform(0.1, 0.5 if dimension_of(keys) == 2 else 0.3)  # so that spheres fit in before they fall
    diameter = min(max(math.sqrt(area / fill / (math.pi / 4)), 4 * ratio), 12 * ratio)
    keys |= {"lateral": "walls", "fill": number(fill), "drum-diameter": number(diameter * 1.001) + "dS"}
    return fill * math.pi / 4 * diameter**2, fill * diameter


def column_shape(dice, keys, ratio, area):
    width = dice.log(1.2, 6) * ratio
    depth = min(max(area / width, 2 * ratio, 3), 30 * ratio)
    length = max(width * dice.uniform(1.1, 5), 4.01 * ratio)
    keys |= {"lateral": "walls", "column-width": number(width) + "dS", "depth": number(depth) + "dS",
             "length": number(length) + "dS"}
    if dice.chance(0.3) or falls_through(keys, ratio):
        keys["base"] = "wall"
    return width * depth, depth


def hopper_shape(dice, keys, ratio, area):
    area, depth = bed_shape(dice, keys, ratio, area)
    outlet = max(1, dice.uniform(0.1, 0.8) * area / depth)
    if dimension_of(keys) == 3:
        keys["outlet-shape"] = dice.pick("slot", "round")
    if keys.get("outlet-shape") == "round":
        outlet = min(outlet, 0.8 * length_of(keys, "width"))
    keys |= {"lateral": "walls", "outlet": number(outlet) + "dS"}
    return area, depth


def usual_density(keys):
    """The default of grseg-sim."""
    return 2500 if dimension_of(keys) == 3 else 1


def add_units(dice, keys, depth):
    """Draws d_S, density and gravity: usually as in a laboratory, otherwise of any order of magnitude."""
    any_size = dice.chance(0.2)
    small = dice.log(1e-7, 1e4) if any_size else 0.005
    density = dice.log(1e-6, 1e6) if any_size else usual_density(keys)
    gravity = dice.log(1e-6, 1e6) if any_size else 9.8
    if keys["geometry"] == "shear":
        pressure = float(number(gravity * density * small * depth * dice.log(0.01, 100)))
        keys["plate-pressure"] = number(pressure)
        gravity = pressure / (density * small * depth)  # the default of grseg-sim
    if any_size:
        keys |= {"small-diameter": number(small) + "m", "density": number(density)}
        small, density = float(number(small)), float(number(density))
        if keys["geometry"] != "shear":
            keys["gravity"] = number(gravity)
    return Units(small, gravity)


def add_law(dice, keys):
    keys["friction"] = number(random_friction(dice))
    keys["restitution"] = number(random_restitution(dice))
    if dice.chance(0.6):
        keys["contact-law"] = dice.pick("speculative", "touch", "centred", "predictive")
    # The law by default is centred above a restitution of 0.9.
    law = "centred" if float(keys["restitution"]) > 0.9 else "speculative"
    if dice.chance(0.1) and keys.get("contact-law", law) == "speculative":
        keys["horizon"] = number(dice.log(1e-3, 1))


def random_friction(dice):
    kinds = {"none": 0, "usual": dice.uniform(0, 1), "any": dice.log(1e-3, 2), "large": dice.log(1, 10),
             "extreme": dice.log(10, 1e3)}
    return kinds[dice.weighted(none=12, usual=35, any=15, large=30, extreme=8)]


def random_restitution(dice):
    kinds = {"none": 0, "usual": 0.25, "any": dice.uniform(0, 1), "large": dice.uniform(0.75, 1), "elastic": 1}
    return kinds[dice.weighted(none=15, usual=15, any=30, large=30, elastic=10)]


def random_slope(dice):
    kinds = {"flat": 0, "usual": dice.uniform(0, 35), "any": dice.uniform(-90, 90), "end": 90 * dice.sign()}
    return kinds[dice.weighted(flat=30, usual=45, any=20, end=5)]


def add_drive(dice, keys, units, depth):
    if keys["geometry"] != "shear":
        keys["slope"] = number(random_slope(dice))
        if dice.chance(0.12):
            keys["slope-rate"] = number(dice.sign() * dice.log(0.01, 10) / units.time)
    if keys["geometry"] == "drum":
        diameter = length_of(keys, "drum-diameter")
        froude = dice.log(1e-4, 10)
        rate = math.sqrt(2 * froude / diameter) / units.time
        keys["drum-rate"] = number(dice.pick(-1, 1, 1, 0) * rate)
    if keys["geometry"] == "shear":
        add_plate(dice, keys, units, depth)
    # Only a base of grains can be shaken.
    if keys["geometry"] == "bed" and "base" not in keys and dice.chance(0.2):
        keys |= random_shaking(dice, units)


def add_plate(dice, keys, units, depth):
    keys["plate-speed"] = number(dice.pick(-1, 1, 1, 0) * dice.log(0.01, 30) * units.speed)
    if dice.chance(0.5):
        volume = length_of(keys, "length") * depth * (length_of(keys, "width") if dimension_of(keys) == 3 else 1)
        density = float(keys.get("density", usual_density(keys))) * units.small ** dimension_of(keys)
        keys["plate-mass"] = number(dice.log(0.03, 30) * density * volume)


def random_shaking(dice, units):
    """Draws an amplitude of up to 3 d_S and an acceleration of 0.1 to 30 g."""
    amplitude = dice.log(1e-3, 3)
    frequency = math.sqrt(dice.log(0.1, 30) / amplitude) / (2 * math.pi) / units.time
    return {"shake-amplitude": number(amplitude) + "dS", "shake-frequency": number(frequency)}


def add_solver(dice, keys, units):
    """Draws the solver's settings. Returns the time step, s."""
    # Spheres with large friction take minutes at `reference`.
    keys["accuracy"] = dice.weighted(standard=50, draft=35, reference=15 if dimension_of(keys) == 2 else 3)
    longest = STEPS[keys["accuracy"]] * units.time
    given = dice.chance(0.2)
    if given:
        longest = dice.log(SHORTEST_STEP[dimension_of(keys)], LONGEST_STEP) * units.time
    if "shake-frequency" in keys:
        longest = min(longest, 1 / (20 * float(keys["shake-frequency"])))
    step = float(f"{longest * 0.99999:.6g}")
    if given:
        keys["step"] = repr(step)
    if dice.chance(0.2) and keys["geometry"] != "shear":
        keys["precision"] = dice.pick("mixed", "double")
    if dice.chance(0.08):
        keys["acceleration"] = "off"
    if dice.chance(0.08):
        keys["tolerance"] = number(dice.log(1e-3, 2))
    if dice.chance(0.08):
        keys["min-sweeps"] = str(round(dice.log(1, 40)))
    # With large friction steps may not converge, above all between different masses, and a deposition takes minutes.
    costly = float(keys["friction"]) > 10
    if dimension_of(keys) == 3 or keys["accuracy"] == "reference":
        costly |= float(keys["friction"]) > 1 and more_sweeps(keys) > 1.5
    if costly or dice.chance(0.08):
        keys["max-sweeps"] = str(round(dice.log(40, 200 if costly else 3000)))
    return step


def frames_of(dice, keys, grains):
    """Number of frames, and number of steps from one frame to the next. Most scenes are short, with a frame for every
    step, so that each step can be checked. The others are ten times as long, so that slow errors show."""
    slow = keys["accuracy"] == "reference" or float(keys.get("tolerance", 1)) < 0.1
    # Number of steps that take half a second.
    work = STEPS_OF_A_GRAIN[dimension_of(keys)] / grains / more_sweeps(keys) / (4 if slow else 1)
    if dice.chance(0.65):
        return 2 * round(dice.log(100, max(min(1200, work), 110)) / 2), 1
    apart = min(100, max(4, round(10 * work / 200)))
    if dice.chance(0.5):
        keys["burst"] = "2"
    return 2 * round(dice.log(50, 150)), apart


def more_sweeps(keys):
    """Factor by which grseg-sim multiplies sweeps because masses of grains differ (sim/scene/keys/resolve.cpp)."""
    masses = float(keys.get("density-ratio", 1)) * float(keys["size-ratio"]) ** dimension_of(keys)
    return min(max(math.sqrt(masses / 16), math.sqrt(1 / masses), 1), 16)


def random_changes(dice, keys, units, depth):
    """Keys for the second half of a run: one to three draws from the keys that a restart may change."""
    shaken = keys["geometry"] == "bed" and "base" not in keys
    options = [
        lambda: {"friction": number(random_friction(dice))},
        lambda: {"restitution": number(random_restitution(dice))},
        lambda: {"contact-law": dice.pick("speculative", "touch", "centred", "predictive")},
        lambda: {"accuracy": dice.pick("draft", "standard", "reference")},
        lambda: {"acceleration": dice.pick("on", "off")},
        lambda: {"tolerance": number(dice.log(1e-2, 1))},
    ]
    if keys["geometry"] != "shear":
        options += [lambda: {"slope": number(random_slope(dice))}] * 2
        options += [lambda: {"slope-rate": number(dice.sign() * dice.log(0.01, 10) / units.time)},
                    lambda: {"gravity": number(units.gravity * dice.log(0.3, 1))},
                    lambda: {"precision": dice.pick("mixed", "double")}]
    if keys["geometry"] == "drum":
        options += [lambda: {"drum-rate": number(-2 * float(keys["drum-rate"]))}] * 4
    if keys["geometry"] == "shear":
        options += [lambda: {"plate-speed": number(dice.sign() * dice.log(0.01, 30) * units.speed)},
                    lambda: {"plate-pressure": number(float(keys["plate-pressure"]) * dice.log(0.3, 3))}] * 2
    if shaken:
        options += [lambda: random_shaking(dice, units)] * 2
    changes = {}
    for _ in range(dice.whole(1, 3)):
        changes |= dice.pick(*options)()
    return changes
