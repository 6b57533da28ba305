"""Captions of the document's figures, in the order of the paper."""

CAPTIONS = {
    "snapshots": "Figure 1. Φ_L = 0.30, 23°, at the start and at the end",
    "pressure-profile":
        "Figure 2a. The line with cosθ is the one in the text, the other the one in the caption",
    "stress-ratio": "Figure 2b: the layers and windows of the fit, from 4 to 56 d_S, and its line",
    "mixed-share": "Figure 2c, with the curve of contacts that ignore grain size",
    "kinetic-profile":
        "Figure 3a, for both definitions of a velocity fluctuation; right: kinetic stress over contact stress",
    "kinetic-ratio": "Figure 3b, likewise; beside them the lowest layer, with the row that the base traps",
    "kinetic-shear-rate": "Figure 4, with the paper's line",
    "pressure-estimates": "Figure 5 with 1/(πd), and Π from contact ends and normal forces",
    "micro-over-time": "Figure 6, first seed, with the forces expected if they ignored grain size",
    "b-of-p": "B over the share of a mixed contact that goes to its large grain, with the rules of published codes",
    "b-of-flows": "B and −B_κ of each flow, early and late",
    "balance":
        "Which mechanism pushes the large grains of Φ_L = 0.30 in which direction ([balance.md](balance.md))",
    "combinations": "Of the combinations with a choice the part that meets each number of the paper",
    "step": "Contacts per grain, mean force, and their product over the time step",
}
