"""Random scenes of discs and spheres within the ranges of all keys, and invariants of any scene: `scripts/hard-cases --random`.

scenes.py       makes a random scene, the same for every version of Python: its keys, and the way to run it
trajectory.py   reads a run as arrays
exact.py        invariants that are true to round-off for any step, tolerance and number of sweeps, in both dimensions
physical.py     invariants that a solver which stops early may violate, if the run warns
trial.py        runs a scene and checks the invariants
"""
