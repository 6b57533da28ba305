"""What the figures of the document show, in the order of the paper."""

CAPTIONS = {
    "snapshots": "Figure 1. Φ_L = 0.30, 23°, at first and at last",
    "pressure-profile":
        "Figure 2a. The line with cosθ is that of the text, the other that of the "
        "caption",
    "stress-ratio":
        "Figure 2b. The lowest layer, with the row that the base traps, in another "
        "colour",
    "mixed-share": "Figure 2c, and contacts that are blind to size",
    "kinetic-profile":
        "Figure 3a, for both meanings of a velocity fluctuation; right, the kinetic "
        "stress in units of the contact stress",
    "kinetic-ratio": "Figure 3b",
    "kinetic-shear-rate": "Figure 4",
    "pressure-estimates": "Figure 5, with 1/(πd), and Π by ends and normal forces",
    "micro-over-time": "Figure 6, first seed, and what forces blind to size would be",
    "b-of-p":
        "B over the share of a mixed contact that goes to its large grain, with the "
        "rules of published codes",
    "b-of-flows": "B and −B_κ of each flow, early and late",
    "balance":
        "Which mechanism pushes the large grains of Φ_L = 0.30 which way "
        "([balance.md](balance.md))",
    "step": "Contacts per grain, mean force and their product over the time step",
}
