#!/usr/bin/python3
"""Smallest and largest normal force of each contact in the heap of case H19, in weights of a disc.

The heap is a triangle of eight rows of equal discs, the lowest row fixed; friction 0.5. Forces are not unique:
all sets of forces that balance every disc and its torque, are repulsive, and obey Coulomb's law are admissible.
In two dimensions these conditions are linear, so the bounds of each force follow from a linear programme.
Prints tests/hard_cases/heap_forces.hpp, to be formatted by clang-format. Needs scipy, which no test needs.
"""
import math

import numpy as np
from scipy.optimize import linprog

ROWS, FRICTION = 8, 0.5

HEAD = """// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What statics and Coulomb's law leave open in the heap of case H19: the least and the largest normal
/// force of each contact, in weights of a disc. By linear programming, tests/independent/heap_forces.py.
namespace grseg::hard_cases {

struct ForceRange {
  int i, j;
  double least, largest;
};
inline constexpr ForceRange heap_forces[] = {"""


def main():
    place = [(k + 0.5 * row, math.sqrt(0.75) * row) for row in range(ROWS) for k in range(ROWS - row)]
    x = np.array(place)
    mobile = {g: k for k, g in enumerate(range(ROWS, len(x)))}
    contacts = [(i, j) for i in range(len(x)) for j in range(i + 1, len(x))
                if j in mobile and abs(np.linalg.norm(x[i] - x[j]) - 1) < 1e-9]

    # Unknowns: normal force and friction of each contact. Three conditions for each disc.
    balance, load = np.zeros((3 * len(mobile), 2 * len(contacts))), np.zeros(3 * len(mobile))
    load[1::3] = 1
    cone = np.zeros((2 * len(contacts), 2 * len(contacts)))
    for c, (i, j) in enumerate(contacts):
        n = x[i] - x[j]
        t = np.array([-n[1], n[0]])
        for g, sign in ((i, 1), (j, -1)):
            if g in mobile:
                row = 3 * mobile[g]
                balance[row:row + 2, 2 * c:2 * c + 2] = sign * np.column_stack((n, t))
                balance[row + 2, 2 * c + 1] = -0.5  # friction turns both discs in the same direction
        cone[2 * c:2 * c + 2, 2 * c:2 * c + 2] = [[-FRICTION, 1], [-FRICTION, -1]]

    print(HEAD)
    for c, (i, j) in enumerate(contacts):
        ends = []
        for sign in (1, -1):
            aim = np.zeros(2 * len(contacts))
            aim[2 * c] = sign
            found = linprog(aim, A_ub=cone, b_ub=np.zeros(len(cone)), A_eq=balance, b_eq=load,
                            bounds=[(0, None), (None, None)] * len(contacts), method="highs")
            assert found.status == 0, found.message
            ends.append(sign * found.fun + 0.0)
        print(f"    {{{i}, {j}, {ends[0]:.9f}, {ends[1]:.9f}}},")
    print("};\n\n}  // namespace grseg::hard_cases")


if __name__ == "__main__":
    main()
