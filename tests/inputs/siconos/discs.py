#!/usr/bin/python3
"""Discs of two sizes in Siconos: they fall onto five fixed discs and roll against a plate."""
import math
import random
from siconos.mechanics.collision.bullet import SiconosBulletOptions
from siconos.mechanics.collision.tools import Contactor
from siconos.io.mechanics_run import MechanicsHdf5Runner
import siconos.kernel as sk
import siconos.numerics as sn

G, SLOPE, STEP, STEPS = 9.81, math.radians(10), 2e-3, 80
random.seed(5)
with MechanicsHdf5Runner(mode='w', io_filename='discs.hdf5') as io:
    io._dimension = 2
    io._out.attrs['dimension'] = 2
    io.add_Newton_impact_friction_nsl('contact', mu=0.5, e=0.0)
    radii = {'small': 0.05, 'large': 0.1}
    for name, r in radii.items():
        io.add_primitive_shape(name, 'Disk', [r])
    io.add_primitive_shape('plate', 'Box2d', (2.0, 0.1))
    for k in range(5):
        io.add_object(f'base{k}', [Contactor('large')], translation=[0.2 * k, 0])
    io.add_object('stop', [Contactor('plate')], translation=[0.93, 0.4], orientation=[math.pi / 2])
    n = 0
    for row in range(3):
        for k in range(4):
            name = 'large' if (row + k) % 3 == 0 else 'small'
            r = radii[name]
            x = 0.13 + 0.21 * k + 0.01 * random.random()
            io.add_object(f'grain{n}', [Contactor(name)], velocity=[0.2, 0, 1.0],
                          translation=[x, 0.205 + 0.16 * row],
                          mass=math.pi * r * r, inertia=0.5 * math.pi * r**4)
            n += 1


def pull(body):
    m = body.scalarMass()
    body.setFExtPtr([m * G * math.sin(SLOPE), -m * G * math.cos(SLOPE), 0.0])


solver = sk.solver_options_create(sn.SICONOS_FRICTION_2D_NSGS)
solver.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 1000
solver.dparam[sn.SICONOS_DPARAM_TOL] = 1e-8
bullet = SiconosBulletOptions()
bullet.worldScale = 1.0
bullet.contactBreakingThreshold = 0.01
bullet.perturbationIterations = 0  # one point per pair
bullet.minimumPointsPerturbationThreshold = 0
with MechanicsHdf5Runner(mode='r+', io_filename='discs.hdf5') as io:
    io.run(t0=0, T=STEP * STEPS, h=STEP, theta=0.5, Newton_max_iter=1, set_external_forces=pull,
           solver_options=solver, output_frequency=1, bullet_options=bullet)
