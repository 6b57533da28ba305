#!/usr/bin/python3
"""Spheres of two sizes in Siconos: they fall obliquely onto fixed spheres and roll against a plate."""
import math
import random
from siconos.mechanics.collision.bullet import SiconosBulletOptions
from siconos.mechanics.collision.tools import Contactor
from siconos.io.mechanics_run import MechanicsHdf5Runner
import siconos.kernel as sk
import siconos.numerics as sn

G, SLOPE, STEP, STEPS = 9.81, math.radians(10), 2e-3, 50
random.seed(5)
with MechanicsHdf5Runner(mode='w', io_filename='spheres3d.hdf5') as io:
    io.add_Newton_impact_friction_nsl('contact', mu=0.5, e=0.0)
    radii = {'small': 0.05, 'large': 0.1}
    for name, r in radii.items():
        io.add_primitive_shape(name, 'Sphere', [r])
    io.add_primitive_shape('plate', 'Box', (0.1, 2.0, 2.0))
    for k in range(12):
        io.add_object(f'base{k}', [Contactor('large')],
                      translation=[0.2 * (k % 4), 0.2 * (k // 4), 0.02 * random.random()])
    io.add_object('stop', [Contactor('plate')], translation=[0.59, 0.2, 0.4])
    for k in range(12):
        name = 'large' if k % 3 == 0 else 'small'
        r = radii[name]
        io.add_object(f'grain{k}', [Contactor(name)], velocity=[0.9, 0.2, -1.0, 0, 0, 0],
                      translation=[0.03 + 0.21 * (k % 3) + 0.03 * random.random(),
                                   0.05 + 0.21 * (k // 3 % 2) + 0.03 * random.random(),
                                   0.19 + 0.2 * (k // 6)],
                      mass=4 / 3 * math.pi * r**3, inertia=[8 / 15 * math.pi * r**5] * 3)


def pull(body):
    m = body.scalarMass()
    body.setFExtPtr([m * G * math.sin(SLOPE), 0.0, -m * G * math.cos(SLOPE)])


solver = sk.solver_options_create(sn.SICONOS_FRICTION_3D_NSGS)
solver.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 10000
solver.dparam[sn.SICONOS_DPARAM_TOL] = 1e-8
bullet = SiconosBulletOptions()
bullet.worldScale = 1.0
bullet.contactBreakingThreshold = 0.01
bullet.perturbationIterations = 0  # one point per pair
bullet.minimumPointsPerturbationThreshold = 0
with MechanicsHdf5Runner(mode='r+', io_filename='spheres3d.hdf5') as io:
    io.run(t0=0, T=STEP * STEPS, h=STEP, theta=0.5, Newton_max_iter=1, set_external_forces=pull,
           solver_options=solver, output_frequency=1, bullet_options=bullet)
