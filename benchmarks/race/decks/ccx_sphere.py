"""Problem G, 3D eighth sphere, CalculiX C3D10. usage: ccx_sphere.py MSH JOB K DISPLACEMENT (writes JOB.inp)"""
import sys

import numpy as np
from ccx_files import read_msh2

msh, job, K, D = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
RZ = 1.3*np.sqrt(D/0.1)
names, nodes, els = read_msh2(msh); tets = [(e, c[:8]+[c[9], c[8]]) for e, ty, ph, c in els if ty == 11]
tri = [c for e, ty, ph, c in els if ty == 9]
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
fm = {}
for e, c in tets:
    for k, f in enumerate(FACES): fm[frozenset(c[i] for i in f)] = (e, k+1)
used = set(n for e, c in tets for n in c); P = {n: np.array(nodes[n]) for n in used}
slv = []; sn = set()
for c in tri:
    if all(abs(np.linalg.norm(P[n])-10) < 1e-6 and np.hypot(P[n][0], P[n][1]) < 1.04*RZ and P[n][2] > 5 for n in c):
        slv.append(fm[frozenset(c[:3])]); sn.update(c)
N0 = max(used)+1; E0 = max(e for e, c in tets)+1
pl = [(-1, -1, 10), (3, -1, 10), (3, 3, 10), (-1, 3, 10), (-1, -1, 11), (3, -1, 11), (3, 3, 11), (-1, 3, 11)]
with open(job+'.inp', 'w') as f:
    f.write('*NODE\n'+''.join('%d,%.12g,%.12g,%.12g\n' % ((n,)+tuple(P[n])) for n in sorted(used)))
    f.write(''.join('%d,%g,%g,%g\n' % ((N0+i,)+p) for i, p in enumerate(pl)))
    f.write('*ELEMENT,TYPE=C3D10,ELSET=ESPH\n'+''.join('%d,%s\n' % (e, ','.join(map(str, c))) for e, c in tets))
    f.write('*ELEMENT,TYPE=C3D8,ELSET=EPL\n%d,%s\n' % (E0, ','.join(str(N0+i) for i in range(8))))
    for nm, k in (('NX', 0), ('NY', 1), ('NZ', 2)):
        f.write('*NSET,NSET=%s\n' % nm+''.join('%d,\n' % n for n in sorted(used) if abs(P[n][k]) < 1e-7))
    f.write('*NSET,NSET=NPL\n'+''.join('%d,\n' % (N0+i) for i in range(8)))
    f.write('*SURFACE,NAME=SSLV\n'+''.join('%d,S%d\n' % s for s in slv)+'*SURFACE,NAME=SMST\n%d,S1\n' % E0)
    f.write("""*MATERIAL,NAME=EL
*ELASTIC
1000.,0.3
*SOLID SECTION,ELSET=ESPH,MATERIAL=EL
*SOLID SECTION,ELSET=EPL,MATERIAL=EL
*SURFACE INTERACTION,NAME=SI
*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR
%g
*CONTACT PAIR,INTERACTION=SI,TYPE=SURFACE TO SURFACE
SSLV,SMST
*BOUNDARY
NX,1,1
NY,2,2
NZ,3,3
*STEP,INC=100
*STATIC
0.2,1.,1e-5,0.2
*BOUNDARY
NPL,1,2
NPL,3,3,-%g
*NODE FILE,FREQUENCY=100
U
*CONTACT FILE,FREQUENCY=100
CDIS,CSTR
*NODE PRINT,NSET=NPL,TOTALS=ONLY
RF
*END STEP
""" % (K, D))
