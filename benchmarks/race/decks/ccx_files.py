"""What the CalculiX decks share: gmsh files (msh 2.2), 2D decks, results (.frd)."""
def read_msh2(fn):
    names = {}; nodes = {}; els = []
    with open(fn) as f:
        L = f.read().split('\n')
    i = 0
    while i < len(L):
        s = L[i].strip()
        if s == '$PhysicalNames':
            n = int(L[i+1])
            for k in range(n):
                d, t, nm = L[i+2+k].split(None, 2)
                names[(int(d), int(t))] = nm.strip().strip('"')
            i += n+2
        elif s == '$Nodes':
            n = int(L[i+1])
            for k in range(n):
                a = L[i+2+k].split()
                nodes[int(a[0])] = (float(a[1]), float(a[2]), float(a[3]))
            i += n+2
        elif s == '$Elements':
            n = int(L[i+1])
            for k in range(n):
                a = list(map(int, L[i+2+k].split()))
                nt = a[2]
                els.append((a[0], a[1], a[3], a[3+nt:]))   # id, type, phys, conn
            i += n+2
        i += 1
    return names, nodes, els

# gmsh types: 1 line2, 2 tri3, 3 quad4, 8 line3, 9 tri6, 10 quad9, 16 quad8
TYPE2CCX = {2: 'CPE3', 3: 'CPE4', 9: 'CPE6', 16: 'CPE8'}
CORNERS = {2: 3, 3: 4, 9: 3, 16: 4}

class Ccx2D:
    def __init__(self, msh, axisym=False):
        self.names, self.nodes, self.els = read_msh2(msh)
        self.surf = {}; self.line_nodes = {}; self.vol = {}
        edge = {}
        self.ax = axisym
        FLIP = {2: (0, 2, 1), 9: (0, 2, 1, 5, 4, 3), 3: (0, 3, 2, 1), 16: (0, 3, 2, 1, 7, 6, 5, 4)}
        for i, (eid, ty, ph, c) in enumerate(self.els):      # CalculiX wants counterclockwise elements
            if ty in FLIP:
                P = [self.nodes[n] for n in c[:3]]
                if (P[1][0]-P[0][0])*(P[2][1]-P[0][1])-(P[2][0]-P[0][0])*(P[1][1]-P[0][1]) < 0:
                    self.els[i] = (eid, ty, ph, [c[k] for k in FLIP[ty]])
        for (eid, ty, ph, c) in self.els:
            if ty in TYPE2CCX:
                nm = self.names[(2, ph)]
                self.vol.setdefault(nm, {}).setdefault(ty, []).append((eid, c))
                nc = CORNERS[ty]
                for k in range(nc):
                    edge.setdefault(frozenset((c[k], c[(k+1) % nc])), []).append((eid, k+1))
        for (eid, ty, ph, c) in self.els:
            if ty in (1, 8):
                nm = self.names[(1, ph)]
                self.line_nodes.setdefault(nm, set()).update(c)
                for e in edge[frozenset(c[:2])]:
                    self.surf.setdefault(nm, []).append(e)
    def used_nodes(self):
        s = set()
        for d in self.vol.values():
            for l in d.values():
                for _, c in l: s.update(c)
        return s
    def write(self, f):
        f.write('*NODE,NSET=NALL\n')
        for n in sorted(self.used_nodes()):
            x, y, z = self.nodes[n]
            f.write('%d,%.12g,%.12g,0.\n' % (n, x, y))
        for nm, d in self.vol.items():
            for ty, l in d.items():
                t = TYPE2CCX[ty]
                if self.ax: t = t.replace('CPE', 'CAX')
                f.write('*ELEMENT,TYPE=%s,ELSET=E%s\n' % (t, nm))
                for e, c in l:
                    f.write('%d,%s\n' % (e, ','.join(map(str, c))))
        for nm, s in self.line_nodes.items():
            f.write('*NSET,NSET=N%s\n' % nm)
            for n in sorted(s): f.write('%d,\n' % n)
        for nm, s in self.surf.items():
            f.write('*SURFACE,NAME=S%s,TYPE=ELEMENT\n' % nm)
            for e, k in s: f.write('%d,S%d\n' % (e, k))

def read_frd(fn):
    """list of (time, {block: {node: values}}), node coordinates"""
    xyz = {}; steps = []
    cur = None; blk = None; mode = None; t = None
    for ln in open(fn):
        k = ln[:5]
        if ln.startswith('    2C'): mode = 'n'; continue
        if ln.startswith('  100C'):
            t = float(ln[12:24]); mode = 'r'
            if not steps or abs(steps[-1][0]-t) > 1e-12: steps.append((t, {}))
            continue
        if ln.startswith(' -4'):
            nm = ln[5:13].strip(); blk = steps[-1][1].setdefault(nm, {}); continue
        if ln.startswith(' -3'): mode = None if mode == 'n' else mode; continue
        if ln.startswith(' -1'):
            if mode == 'n':
                xyz[int(ln[3:13])] = (float(ln[13:25]), float(ln[25:37]), float(ln[37:49]))
            elif mode == 'r' and blk is not None:
                b = ln.rstrip('\n')[13:]
                blk[int(ln[3:13])] = [float(b[i:i+12]) for i in range(0, len(b), 12) if b[i:i+12].strip()]
    return steps, xyz
