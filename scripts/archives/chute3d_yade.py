"""The bidisperse chute of chute3d.lammps in YADE, short: filled, developed and written as plain tables.

    yade -x -n -j1 chute3d_yade.py

Units d_S = g = rho = 1; x is down-slope, y up, z across. Writes grains.csv and contacts.csv for
grseg-import --format csv, and stress.csv with YADE's own stress of each grain, bodyStressTensors(), in the
same order of grains: Pa, divided by the grain's volume, tension positive. YADE's cell is periodic along all
axes; it is so high that nothing meets across y, and the tables say that x and z alone are periodic.
Set in the environment: SEED (1), DEVELOP steps before the first output (60000), EVERY (2000), FRAMES (5).
"""
import math
import os
import random

setting = {"SEED": 1, "DEVELOP": 60000, "EVERY": 2000, "FRAMES": 5}
setting.update((name, int(os.environ[name])) for name in setting if name in os.environ)
ALONG, ACROSS, GRAINS, LARGE, SLOPE = 6, 5, 2100, 0.45, math.radians(26)
KN, STEP, FLOOR = 1e4, 8.8e-4, 3.0
SIZE = {1: 2.0, 2: 1.0, 3: 2.0}  # of base, small and large grains
length, width, height = 2.0 * ALONG, 2.0 * ACROSS, 100.0

O.periodic = True
O.cell.setBox(length, height, width)
# Springs and dashpots of two materials are in series: twice the value of a contact. No tangential dashpot.
damping = 2 * math.log(4) / math.hypot(math.pi, math.log(4)) * math.sqrt(KN * math.pi / 12)
O.materials.append(ViscElMat(kn=2 * KN, ks=2 * KN * 2 / 7, cn=2 * damping, cs=0,
                             frictionAngle=math.atan(0.5), density=1.0))
kind = []
draw = random.Random(setting["SEED"])
for k in range(ALONG * ACROSS):
    centre = (2 * (k // ACROSS), FLOOR - draw.uniform(0, 0.5), 2 * (k % ACROSS))
    O.bodies.append(sphere(centre, SIZE[1] / 2, fixed=True))
    kind.append(1)
of_large = round(GRAINS * LARGE / 8 / (LARGE / 8 + 1 - LARGE))
cloud = pack.SpherePack()
for species, number in ((3, of_large), (2, GRAINS - of_large)):
    placed = len(cloud)
    cloud.makeCloud((0, FLOOR + 2.1, 0), (length, FLOOR + 62.1, width), rMean=SIZE[species] / 2,
                    num=number, periodic=True, seed=setting["SEED"])
    if len(cloud) != placed + number:
        raise SystemExit("chute3d_yade.py: no room for the grains")
    kind += [species] * number
for centre, radius in cloud:
    O.bodies.append(sphere(centre, radius))


def write():
    bodies, stresses = list(O.bodies), bodyStressTensors()
    for b in bodies:
        s = b.state
        force = O.forces.f(b.id) + s.mass * newton.gravity
        row = [O.time, b.id, kind[b.id], *s.pos, b.shape.radius, s.mass, *s.vel, *s.angVel, *force,
               int(not b.dynamic)]
        grains.write(" ".join(map(repr, row)) + "\n")
        of_body = [stresses[b.id][p, q] for p in range(3) for q in range(3)]
        stress.write(" ".join(map(repr, [O.time, b.id, *of_body])) + "\n")
    for c in O.interactions:
        if c.isReal:
            force = -(c.phys.normalForce + c.phys.shearForce)
            contacts.write(" ".join(map(repr, [O.time, c.id1, c.id2, *force, c.geom.penetrationDepth])) + "\n")
    for table in (grains, contacts, stress):
        table.flush()


newton = NewtonIntegrator(damping=0, gravity=(math.sin(SLOPE), -math.cos(SLOPE), 0))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                    [Law2_ScGeom_ViscElPhys_Basic()]),
    newton,
]
O.dt = STEP
O.run(setting["DEVELOP"], True)

grains, contacts, stress = (open(name + ".csv", "w") for name in ("grains", "contacts", "stress"))
grains.write(f"# periodic: x 0 {length!r}\n# periodic: z 0 {width!r}\n")
grains.write("time id type x y z radius mass vx vy vz wx wy wz fx fy fz fixed\n")
contacts.write("time i j fx fy fz overlap\n")
stress.write("time id xx xy xz yx yy yz zx zy zz\n")
# before the grains move away from where their contacts were found
O.engines = O.engines[:-1] + [PyRunner(command="write()", iterPeriod=setting["EVERY"])] + O.engines[-1:]
O.run(setting["EVERY"] * setting["FRAMES"], True)
mobile = [b.state.vel[0] for b in O.bodies if b.dynamic]
print("mean velocity", sum(mobile) / len(mobile))
