"""Problem C with CalculiX.  usage: ccx_hertz.py MSH JOB K STICK [UX]   (writes JOB.inp)"""
import os
import sys

from ccx_files import Ccx2D

msh, job, K, ST = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
UX = float(sys.argv[5]) if len(sys.argv) > 5 else 0.0
UY = float(os.environ.get('UY', '0.04'))
m = Ccx2D(msh)
with open(job+'.inp', 'w') as f:
    m.write(f)
    f.write("""*MATERIAL,NAME=EL
*ELASTIC
10000.,0.3
*SOLID SECTION,ELSET=EBLOCK,MATERIAL=EL
1.
*SOLID SECTION,ELSET=ECYL,MATERIAL=EL
1.
*SURFACE INTERACTION,NAME=SI
*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR
%g
*FRICTION
0.5,%g
*CONTACT PAIR,INTERACTION=SI,TYPE=SURFACE TO SURFACE
SSLV,SMST
*BOUNDARY
NBOT,1,2
*STEP,INC=200
*STATIC
0.5,1.,1e-5,1.
*BOUNDARY
NTOP,1,1
NTOP,2,2,-%g
*NODE FILE,FREQUENCY=1000
U
*CONTACT FILE,FREQUENCY=1000
CDIS,CSTR
*NODE PRINT,NSET=NTOP,TOTALS=ONLY,FREQUENCY=1000
RF
*END STEP
""" % (K, ST, UY))
    if UX:
        f.write("""*STEP,INC=200
*STATIC
0.25,1.,1e-5,1.
*BOUNDARY
NTOP,1,1,%g
NTOP,2,2,-%g
*NODE FILE,FREQUENCY=1
U
*CONTACT FILE,FREQUENCY=1
CDIS,CSTR
*NODE PRINT,NSET=NTOP,TOTALS=ONLY,FREQUENCY=1
RF
*END STEP
""" % (UX, UY))
