"""Random numbers of one scene."""
import math
import random


class Dice:
    """Draws from one stream. It uses random() alone, which no version of Python changes."""

    def __init__(self, seed, number):
        self._next = random.Random(f"{seed}-{number}").random

    def chance(self, probability):
        return self._next() < probability

    def uniform(self, low, high):
        return low + (high - low) * self._next()

    def log(self, low, high):
        """Uniform in its logarithm."""
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def whole(self, low, high):
        return low + int(self._next() * (high - low + 1))

    def pick(self, *options):
        return options[int(self._next() * len(options))]

    def weighted(self, **weights):
        """A word, as often as its weight says."""
        left = self._next() * sum(weights.values())
        for word, weight in weights.items():
            left -= weight
            if left < 0:
                return word
        return word

    def sign(self):
        return self.pick(-1, 1)
