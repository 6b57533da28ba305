"""Random scenes within the ranges of all keys, and what must hold in any of them: `scripts/hard-cases --random`.

scenes.py       a random scene, the same for every version of Python: its keys, and how it is run
trajectory.py   a run as arrays
exact.py        invariants that hold to round-off for any step, tolerance and number of sweeps
physical.py     invariants that a solver which stops early may break, if it says so
trial.py        runs a scene, and judges it
"""
