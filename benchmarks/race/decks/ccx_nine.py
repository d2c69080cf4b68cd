"""Problem F with CalculiX. usage: ccx_nine.py MSH JOBPATH K STICK [NSTEP]   step 1 (1% of the load) holds the disc
centres to bring every pair into contact, step 2 releases them"""
import os
import sys

from ccx_files import Ccx2D

msh, job, K, ST = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4]); NST = int(sys.argv[5]) if len(sys.argv) > 5 else 10
DISP = 0.05; m = Ccx2D(msh)
near = lambda b, x, y: min(set(n for d in m.vol[b].values() for e, c in d for n in c), key=lambda n: (m.nodes[n][0]-x)**2+(m.nodes[n][1]-y)**2)
nB, nC, nD = near('B', 3.4, 0), near('C', 0, 3.4), near('D', 3.4, 3.4)
pairs = [('C1s', 'C1m'), ('C2s', 'C2m'), ('C3s', 'C3m'), ('C4s', 'C4m'), ('C5s', 'C56m'), ('C6s', 'C56m'), ('C7s', 'C78m'), ('C8s', 'C78m')]
bc = ''.join('N%s,%d,%d\n' % (k, 1 if k.startswith('SX') else 2, 1 if k.startswith('SX') else 2) for k in m.line_nodes if k[:2] in ('SX', 'SY'))
def load(f): return 'NOUT_PR,1,1,-%g\nNOUT_PR,2,2,0.\nNOUT_PT,1,1,0.\nNOUT_PT,2,2,-%g\n' % (DISP*f, DISP*f)
outp = ''.join('*CONTACT PRINT,SLAVE=S%s,MASTER=S%s,FREQUENCY=1000\nCF\n' % p for p in pairs)+'*NODE PRINT,NSET=NOUT_PR,TOTALS=ONLY,FREQUENCY=1000\nRF\n'
s = DISP*0.01/6.1*3.4
with open(job+'.inp', 'w') as f:
    m.write(f)
    f.write('*MATERIAL,NAME=EL\n*ELASTIC\n1000.,0.3\n'+''.join('*SOLID SECTION,ELSET=E%s,MATERIAL=EL\n1.\n' % b for b in m.vol))
    f.write('*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n%g\n*FRICTION\n0.5,%g\n' % (K, ST))
    f.write(''.join('*CONTACT PAIR,INTERACTION=SI,TYPE=SURFACE TO SURFACE\nS%s,S%s\n' % p for p in pairs))
    f.write('*STEP,INC=100\n*STATIC\n1.,1.\n*BOUNDARY\n'+bc+load(0.01)+'%d,1,1,-%g\n%d,2,2,-%g\n%d,1,1,-%g\n%d,2,2,-%g\n' % (nB, s, nC, s, nD, s, nD, s)+outp+'*END STEP\n')
    f.write('*STEP,INC=1000\n*STATIC\n%g,1.,1e-6,%g\n*BOUNDARY,OP=NEW\n' % (1/NST, 1/NST)+bc+load(1.0)+'*NODE FILE,FREQUENCY=1000\nU\n*EL FILE,FREQUENCY=1000\nS\n*CONTACT FILE,FREQUENCY=1000\nCDIS,CSTR\n'+outp+'*END STEP\n')
