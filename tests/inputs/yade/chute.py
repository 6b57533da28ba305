"""A chute of spheres of two sizes in YADE, periodic down the slope and across, on a base of fixed spheres.

    PYTHONPATH=../../../scripts/archives yade -x -n -j1 chute.py

Writes chute-grains.csv.gz and chute-contacts.csv.gz, and chute-stress.csv: YADE's own stress, utils.getStress().
Units d_S = g = rho = 1; z is normal to the base.
"""
import math
import random

from yade import pack, utils
from yade_export import Exporter

LENGTH, WIDTH, HEIGHT, SLOPE, EVERY, FRAMES = 8.0, 6.0, 40.0, math.radians(25), 2000, 6
random.seed(1)
O.periodic = True
O.cell.setBox(LENGTH, WIDTH, HEIGHT)
O.materials.append(ViscElMat(kn=2e4, ks=4e4 / 7, cn=40, cs=0, frictionAngle=math.atan(0.5), density=1.0))
for k in range(12):
    centre = (1 + 2 * (k // 3), 1 + 2 * (k % 3), 3 - random.uniform(0, 0.5))
    O.bodies.append(sphere(centre, 1.0, fixed=True))
cloud = pack.SpherePack()
for radius, number in ((1.0, 25), (0.5, 150)):
    cloud.makeCloud((0, 0, 5.1), (LENGTH, WIDTH, 20.1), rMean=radius, num=number, periodic=True, seed=1)
for centre, radius in cloud:
    O.bodies.append(sphere(centre, radius))


def measure():
    s = utils.getStress(LENGTH * WIDTH * HEIGHT)
    stress.write(" ".join(repr(float(v)) for v in [O.time] + [s[p, q] for p in range(3) for q in range(3)]) + "\n")


newton = NewtonIntegrator(damping=0, gravity=(math.sin(SLOPE), 0, -math.cos(SLOPE)))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                    [Law2_ScGeom_ViscElPhys_Basic()]),
    newton,
]
O.dt = 1e-3
O.run(20000, True)
Exporter("chute-grains.csv.gz", "chute-contacts.csv.gz").install(EVERY)
stress = open("chute-stress.csv", "w")
O.engines = O.engines[:-1] + [PyRunner(command="measure()", iterPeriod=EVERY)] + O.engines[-1:]
O.run(EVERY * FRAMES, True)
stress.close()
