"""Spheres of two sizes are poured into a box in YADE: a Wall is the floor, facets are two of its sides, boxes the other two.

    PYTHONPATH=../../../scripts/archives yade -x -n -j1 box.py

Writes box-grains.csv.gz and box-contacts.csv.gz, and box-walls.csv: the total force on each wall as YADE itself computes it.
"""
import random

from yade import pack
from yade_export import Exporter

GRAVITY, SIDE, EVERY, FRAMES = 9.81, 0.06, 5000, 20
random.seed(3)
O.materials.append(FrictMat(young=2e6, poisson=0.3, frictionAngle=0.5, density=2500))
low, high = (0, 0, 0), (SIDE, SIDE, 0.5)
floor = O.bodies.append(wall(0.0, axis=2, sense=1))
sides = [O.bodies.append(box((x, SIDE / 2, 0.1), (0.005, SIDE, 0.2), fixed=True)) for x in (-0.005, SIDE + 0.005)]
for y in (0.0, SIDE):
    for corners in (((0, y, 0), (SIDE, y, 0), (SIDE, y, 0.3)), ((0, y, 0), (SIDE, y, 0.3), (0, y, 0.3))):
        sides.append(O.bodies.append(facet(corners, fixed=True)))
placed = 0


def pour():
    """Adds four grains, as long as there are fewer than 80."""
    global placed
    for k in range(4 if placed < 80 else 0):
        radius = 0.008 if placed % 4 == 0 else 0.004 * random.uniform(0.95, 1.05)
        centre = (0.015 + 0.03 * (k % 2) + 0.002 * random.random(), 0.015 + 0.03 * (k // 2) + 0.002 * random.random(), 0.12)
        grain = sphere(centre, radius)
        grain.state.vel = (0, 0, -1.5)
        O.bodies.append(grain)
        placed += 1


def weigh():
    walls.write(f"{float(O.time)!r} " + " ".join(repr(float(f)) for b in [floor] + sides for f in O.forces.f(b, True)) + "\n")


pour()
newton = NewtonIntegrator(damping=0, gravity=(0, 0, -GRAVITY))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb(), Bo1_Facet_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(betan=0.5, betas=0.5)], [Law2_ScGeom_MindlinPhys_Mindlin()]),
    newton,
    PyRunner(command="pour()", iterPeriod=1500),
]
O.dt = 1e-5
Exporter("box-grains.csv.gz", "box-contacts.csv.gz", kind=lambda body: 2 if body.shape.radius > 0.006 else 1).install(EVERY)
walls = open("box-walls.csv", "w")
O.engines = O.engines[:-2] + [PyRunner(command="weigh()", iterPeriod=EVERY)] + O.engines[-2:]
O.run(EVERY * FRAMES, True)
walls.close()
print("grains", placed)
