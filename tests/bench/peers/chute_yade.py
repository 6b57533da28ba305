# Soft discs on the chute, YADE (yade -x -n -j1 chute_yade.py); units d_S = g = rho = 1. Run by
# compare-peers, which sets in the environment
#   STATE KN EN DT VERLET GRAVITY WARM STEPS EVERY FRAMES
# Linear springs with history, mu = 0.5; contact time and restitution of each pair of types are chosen so
# that kn = KN, kt = 2/7 kn at their nominal masses. EN is the restitution of a spring and dashpot that
# may pull; YADE's may not, so that the actual one, 0.25, is larger. After WARM steps, STEPS steps are
# timed; then contacts are written FRAMES times, every EVERY steps.
import math
import os
import time

setting = {name: float(os.environ[name])
           for name in "KN EN DT VERLET GRAVITY WARM STEPS EVERY FRAMES".split()}
e, slope = setting["EN"], math.radians(23)
with open(os.environ["STATE"]) as text:
    length = float(text.readline().split()[0])
    grains = [list(map(float, line.split())) for line in text]
top = max(grain[4] for grain in grains)

BASE, LARGE, SMALL = 1, 2, 3
material = {kind: O.materials.append(ViscElMat(frictionAngle=math.atan(0.5), density=1.0))
            for kind in (BASE, LARGE, SMALL)}
mass = {BASE: math.inf, LARGE: math.pi, SMALL: math.pi / 4}


def effective_mass(a, b):
    return 1 / (1 / mass[a] + 1 / mass[b] or 1)  # two boundary grains never collide: any value


def match(value):
    """Values for every pair of types."""
    return MatchMaker(matches=[(material[a], material[b], value(a, b)) for a in mass for b in mass])


def contact_time(a, b):
    return math.sqrt(effective_mass(a, b) * (math.pi**2 + math.log(e)**2) / setting["KN"])


O.periodic = True
O.cell.setBox(length, top + 80, 10)
for fixed, kind, r, x, y, u, v, spin in grains:
    i = O.bodies.append(sphere((x, y + 8, 5), r, fixed=bool(fixed),
                               material=O.materials[material[int(kind)]]))
    state = O.bodies[i].state
    state.mass = 1e9 if fixed else math.pi * r * r  # the contact law uses the reduced mass
    state.inertia = (state.mass * r * r / 2,) * 3
    state.blockedDOFs = "xyzXYZ" if fixed else "zXY"
    if not fixed:
        state.vel, state.angVel = (u, v, 0), (0, 0, spin)

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=setting["VERLET"]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys(tc=match(contact_time), en=match(lambda a, b: e),
                                            et=match(lambda a, b: e))],
        [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0, gravity=(setting["GRAVITY"] * math.sin(slope),
                                         -setting["GRAVITY"] * math.cos(slope), 0)),
]
O.dt = setting["DT"]

O.run(int(setting["WARM"]), True)
begin = time.perf_counter()
O.run(int(setting["STEPS"]), True)
print("TIMED", time.perf_counter() - begin, "s")

with open("contacts.dump", "w") as contacts:
    for _ in range(int(setting["FRAMES"])):
        O.run(int(setting["EVERY"]), True)
        contacts.write("ITEM: ENTRIES id1 id2 overlap\n")
        for i in O.interactions:
            if i.isReal and i.geom.penetrationDepth > 0:
                contacts.write(f"{i.id1 + 1} {i.id2 + 1} {i.geom.penetrationDepth!r}\n")
with open("end.dump", "w") as end:
    end.write("ITEM: ATOMS id vx vy omegaz\n")
    for b in O.bodies:
        end.write(f"{b.id + 1} {b.state.vel[0]!r} {b.state.vel[1]!r} {b.state.angVel[2]!r}\n")
