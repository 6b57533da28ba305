#!/usr/bin/python3
"""Siconos: discs, or spheres, of two sizes fall onto a static ground that is a convex hull and come to rest there.

    ground.py 2 1     writes ground2d-1.hdf5: discs, every step
    ground.py 3 10    writes ground3d-10.hdf5: spheres, every tenth step
"""
import math
import sys
import random
from siconos.mechanics.collision.bullet import SiconosBulletOptions
from siconos.mechanics.collision.tools import Contactor
from siconos.io.mechanics_run import MechanicsHdf5Runner
import siconos.kernel as sk
import siconos.numerics as sn

D, EVERY = int(sys.argv[1]), int(sys.argv[2])
G, STEP, STEPS = 9.81, 2e-3, 300
random.seed(5)
name = f'ground{D}d-{EVERY}.hdf5'
with MechanicsHdf5Runner(mode='w', io_filename=name) as io:
    io._dimension = D
    io._out.attrs['dimension'] = D
    io.add_Newton_impact_friction_nsl('contact', mu=0.5, e=0.0)
    radii = {'small': 0.05, 'large': 0.1}
    for size, r in radii.items():
        io.add_primitive_shape(size, 'Disk' if D == 2 else 'Sphere', [r])
    if D == 2:
        ground = [(-1, -0.3), (1, -0.3), (1.2, 0), (-1.2, 0)]
    else:
        ground = [(x, y, z) for z in (-0.3, 0) for x in (-1, 1) for y in (-1, 1)]
    io.add_convex_shape('hull', ground)
    io.add_object('ground', [Contactor('hull')], translation=[0] * D)
    for k in range(8):
        size = 'large' if k % 3 == 0 else 'small'
        r = radii[size]
        m = math.pi * r * r if D == 2 else 4 / 3 * math.pi * r**3
        x = 0.3 * (k % 4) + 0.15 * (k // 4) - 0.6 + 0.02 * random.random()
        height = 0.11 + 0.25 * (k // 4)
        if D == 2:
            io.add_object(f'grain{k}', [Contactor(size)], velocity=[0.1, 0, 0], translation=[x, height],
                          mass=m, inertia=0.5 * m * r * r)
        else:
            io.add_object(f'grain{k}', [Contactor(size)], velocity=[0.1, 0.05, 0, 0, 0, 0],
                          translation=[x, 0.02 * random.random(), height], mass=m, inertia=[0.4 * m * r * r] * 3)


def pull(body):
    force = [0.0] * 3
    force[D - 1] = -body.scalarMass() * G
    body.setFExtPtr(force)


solver = sk.solver_options_create(sn.SICONOS_FRICTION_2D_NSGS if D == 2 else sn.SICONOS_FRICTION_3D_NSGS)
solver.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 10000
solver.dparam[sn.SICONOS_DPARAM_TOL] = 1e-8
bullet = SiconosBulletOptions()
bullet.worldScale = 1.0
bullet.contactBreakingThreshold = 0.01
bullet.perturbationIterations = 0  # one point per pair
bullet.minimumPointsPerturbationThreshold = 0
with MechanicsHdf5Runner(mode='r+', io_filename=name) as io:
    io.run(t0=0, T=STEP * STEPS, h=STEP, theta=0.5, Newton_max_iter=1, set_external_forces=pull,
           solver_options=solver, output_frequency=EVERY, bullet_options=bullet)
