"""Writes tables of a YADE run for grseg-import --format csv.

In the script of the run, after O.engines is set:

    import sys; sys.path.append('.../grseg/scripts/archives')
    from yade_export import Exporter
    Exporter('grains.csv', 'contacts.csv').install(every=1000)     # every 1000 steps; names may end in .gz

Spheres are grains. Bodies of other shapes that are at rest or move as prescribed (Wall, Box, Facet) are walls, numbered
in the order of their ids. The tables include positions, velocities, spins, masses, the material's id as type, which
grains are fixed, the total force on each grain, and for every contact the force on i from j and the branch. Lines above
the names of the columns state gravity, time step and the periods of the cell.

The tables are written just before NewtonIntegrator moves the grains from the positions at which their contacts were
found; velocities are those of half a step before. The run stops with an error if an import would be wrong: for clumps, a
sheared or growing cell, or forces that no contact explains. (check_forces=False accepts such forces and writes them as
part of the force on the grain.)
"""
import atexit
import gzip

from yade import NewtonIntegrator, O, PyRunner, Sphere

GRAIN_COLUMNS = "time id type x y z radius mass vx vy vz wx wy wz fx fy fz fixed"
CONTACT_COLUMNS = "time i j fx fy fz overlap bx by bz"
AXES = "xyz"

exporters = []  # all Exporters; PyRunner finds them here, whatever their names in the user's script are


class Exporter:
    """Writes the tables of grains and contacts.

    kind: function that returns the type of a body (default: the id of its material)
    periodic: axes along which the bed is periodic, such as 'xz'. YADE's cell is periodic along all three axes; the
              default leaves out the axis closest to gravity
    """

    def __init__(self, grains="grains.csv", contacts="contacts.csv", kind=None, periodic=None, check_forces=True):
        self.names = grains, contacts
        self.files = None
        self.kind = kind or (lambda body: body.material.id if body.material else 0)
        self.periodic = periodic
        self.check_forces = check_forces
        self.ids = {}  # (id, step of birth) of a body: id in the tables
        self.used = set()  # ids that the tables use
        self.walls = {}  # id of a body: number of the wall
        exporters.append(self)
        self.number = len(exporters) - 1

    def install(self, every):
        """Writes the tables from now on, every `every` steps."""
        engines = list(O.engines)
        before = [k for k, engine in enumerate(engines) if isinstance(engine, NewtonIntegrator)]
        if len(before) != 1:
            raise ValueError("yade_export: set O.engines, with its NewtonIntegrator, before install()")
        self.newton = engines[before[0]]
        command = f"import yade_export; yade_export.exporters[{self.number}].write()"
        engines.insert(before[0], PyRunner(command=command, iterPeriod=every))
        O.engines = engines

    def write(self):
        """Writes the present state to both tables."""
        if self.files is None:
            self.begin()
        if O.periodic and self.cell != cell_of():
            raise RuntimeError("yade_export: the cell has changed, which grseg does not import; end the export, or "
                               "begin another one, before the cell changes")
        forces = {}
        rows = [self.contact_row(c, forces) for c in O.interactions if c.isReal]
        grain_rows = [self.grain_row(body, forces) for body in O.bodies if isinstance(body.shape, Sphere)]
        for file, some in zip(self.files, (grain_rows, rows)):
            file.write("".join(" ".join(map(repr, row)) + "\n" for row in some))
            file.flush()

    def begin(self):
        self.files = [gzip.open(name, "wt") if name.endswith(".gz") else open(name, "w") for name in self.names]
        for file in self.files:
            atexit.register(file.close)  # otherwise the end of a compressed file may be missing
        grains, contacts = self.files
        for body in O.bodies:
            if not isinstance(body.shape, Sphere):
                self.wall_of(body)
        grains.write(f"# grains: spheres\n# gravity: {' '.join(repr(float(g)) for g in self.newton.gravity)}\n# step: {float(O.dt)!r}\n")
        if O.periodic:
            self.cell = cell_of()
            for axis in self.periods():
                grains.write(f"# periodic: {axis} 0 {self.cell[AXES.index(axis)]!r}\n")
        grains.write(GRAIN_COLUMNS + "\n")
        contacts.write(CONTACT_COLUMNS + "\n")

    def periods(self):
        if self.periodic is None:
            pull = [abs(g) for g in self.newton.gravity]
            self.periodic = "".join(a for a in AXES if max(pull) == 0 or pull[AXES.index(a)] < max(pull))
        return self.periodic

    def id_of(self, body):
        """Id of the body in the tables. YADE uses the id of an erased body again for a later body; they are two grains."""
        birth = body.id, body.iterBorn
        if birth not in self.ids:
            free = body.id not in self.used
            self.ids[birth] = body.id if free else 1 + max(self.used)
            self.used.add(self.ids[birth])
        return self.ids[birth]

    def wall_of(self, body):
        if body.dynamic or "xyz" not in body.state.blockedDOFs:
            raise RuntimeError(f"yade_export: body {body.id} ({type(body.shape).__name__}) moves freely; only spheres "
                               "can be grains")
        return self.walls.setdefault(body.id, len(self.walls))

    def contact_row(self, contact, forces):
        first, second = O.bodies[contact.id1], O.bodies[contact.id2]
        side = 1.0  # the normal points from the first to the second body, and the force of `phys` acts on the second
        if not isinstance(first.shape, Sphere):
            first, second, side = second, first, -1.0
        geom, phys = contact.geom, contact.phys
        self.require_open(contact)
        force = [-side * float(f) for f in phys.normalForce + phys.shearForce]
        add(forces, first.id, force)
        reach = first.shape.radius - geom.penetrationDepth
        if isinstance(second.shape, Sphere):
            j = self.id_of(second)
            reach += second.shape.radius
            add(forces, second.id, [-f for f in force])
        else:
            j = -1 - self.wall_of(second)
        branch = [-side * float(n) * float(reach) for n in geom.normal]
        return [float(O.time), self.id_of(first), j, *force, float(geom.penetrationDepth), *branch]

    def require_open(self, contact):
        if not O.periodic:
            return
        for axis, periods in zip(AXES, contact.cellDist):
            if periods != 0 and axis not in self.periods():
                raise RuntimeError(f"yade_export: grains {contact.id1} and {contact.id2} touch across the cell along "
                                   f"{axis}; make the cell longer along {axis}, or set periodic='xyz'")

    def grain_row(self, body, forces):
        if body.isClumpMember:
            raise RuntimeError(f"yade_export: body {body.id} is part of a clump; only single spheres can be grains")
        state = body.state
        held = not body.dynamic or "xyz" in state.blockedDOFs
        felt = [float(f) for f in O.forces.f(body.id, True)]
        summed = forces.get(body.id, [0.0, 0.0, 0.0])
        scale = max(map(abs, felt + summed + [float(state.mass * g) for g in self.newton.gravity]))
        if self.check_forces and not held and max(abs(a - b) for a, b in zip(felt, summed)) > 1e-9 * scale:
            raise RuntimeError(f"yade_export: the force on body {body.id} is {felt}, but the sum over its contacts is "
                               f"{summed}: another engine exerts forces; check_forces=False writes the tables anyway")
        force = [f + float(state.mass * g) for f, g in zip(felt, self.newton.gravity)]
        numbers = [*state.pos, body.shape.radius, state.mass, *state.vel, *state.angVel]
        return [float(O.time), self.id_of(body), int(self.kind(body)), *map(float, numbers), *force, int(held)]


def add(forces, body, force):
    forces[body] = [a + b for a, b in zip(forces.get(body, (0.0, 0.0, 0.0)), force)]


def cell_of():
    """Lengths of the cell. Raises RuntimeError unless the cell is rectangular."""
    size = O.cell.hSize
    if any(size[p, q] != 0 for p in range(3) for q in range(3) if p != q):
        raise RuntimeError("yade_export: the cell is sheared, which grseg does not import")
    return [float(size[p, p]) for p in range(3)]
