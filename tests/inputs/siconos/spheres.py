from siconos.mechanics.collision.tools import Contactor
from siconos.io.mechanics_run import MechanicsHdf5Runner
import siconos.numerics as sn
with MechanicsHdf5Runner(io_filename='spheres.hdf5') as io:
    io.add_primitive_shape('S','Sphere',[0.5])
    io.add_primitive_shape('G','Box',(10,10,1.0))
    io.add_Newton_impact_friction_nsl('contact', mu=0.5, e=0.0)
    io.add_object('s1',[Contactor('S')],translation=[0,0,0.5],mass=2.0)
    io.add_object('s2',[Contactor('S')],translation=[0,0,1.5],mass=3.0)
    io.add_object('g',[Contactor('G')],translation=[0,0,-0.5])
opt = sn.SolverOptions(sn.SICONOS_FRICTION_3D_NSGS) if hasattr(sn,'SolverOptions') else sn.solver_options_create(sn.SICONOS_FRICTION_3D_NSGS)
with MechanicsHdf5Runner(io_filename='spheres.hdf5',mode='r+') as io:
    io.run(t0=0,T=0.05,h=0.005,theta=0.50001,Newton_max_iter=1,output_frequency=1)
