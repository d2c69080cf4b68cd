#!/usr/bin/python3
"""Finite-element reference of the sheared cylinder on a block: small strain, Coulomb friction, no penalty.

usage: getfem_mean_normal.py FRAME EDGE CURVE.csv [PRESSING]

FRAME     vertical: contact normal (0, -1), each point paired with the one below, gap y of the circle;
          mean: normal, pairing and gap of the surface half-way between circle and line. This is the parabola
          y = x^2/40, whose normal has the slope s = x/20: from X on the circle s = X_1 / (20 - X_2), the partner
          lies at (20 s, 0), the gap is 20 s^2.
EDGE      of the triangles at the contact [mm]
PRESSING  number of steps in which the cylinder is pressed, with friction (default 1), or `frictionless`: pressed in
          one step, friction acts from the first sideways step on. All motion of a step counts as slip, also that
          before a point closes: with tilted normals this is wrong by x/20 of the approach and needs small steps.

Needs python3-getfem and gmsh. P2 displacements, P1 multiplier on the circle, augmented Lagrangian (Alart and
Curnier 1991). Writes x [mm] on the half-way surface, p, the tangential traction on the cylinder in the frame of the
contact and its x-component [MPa].
"""
import os
import re
import subprocess
import sys
import tempfile

import getfem as gf
import numpy as np

E, NU, MU, PRESS, SHEAR, STEPS = 1e4, 0.3, 0.5, 0.04, 0.012, 4
AUGMENTATION = 1e5
GEOMETRY = """
Point(1) = {-10, -4, 0}; Point(2) = {10, -4, 0}; Point(3) = {10, 0, 0}; Point(4) = {-10, 0, 0};
Point(5) = {-1, 0, 0}; Point(6) = {1, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 6}; Line(4) = {6, 5}; Line(5) = {5, 4}; Line(6) = {4, 1};
Line Loop(1) = {1:6}; Plane Surface(1) = {1};
y = 10 - Sqrt(99);
Point(10) = {0, 10, 0}; Point(11) = {-1, y, 0}; Point(12) = {1, y, 0}; Point(13) = {8, 4, 0}; Point(14) = {-8, 4, 0};
Circle(11) = {14, 10, 11}; Circle(12) = {11, 10, 12}; Circle(13) = {12, 10, 13}; Line(14) = {13, 14};
Line Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("block") = {1}; Physical Surface("cylinder") = {2};
Physical Line("base") = {1}; Physical Line("top") = {14}; Physical Line("contact") = {12};
Field[1] = MathEval;
Field[1].F = Sprintf("Min(1, %g + 0.22*Sqrt(Max(Fabs(x) - 0.8, 0)^2 + Max(Fabs(y) - 0.15, 0)^2))", edge);
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0; Mesh.CharacteristicLengthFromPoints = 0; Mesh.Algorithm = 6;
"""
FRAMES = {'vertical': {'partner': '[X(1); 0]', 'normal': '[0; -1]', 'gap': 'X(2)'},
          'mean': {'partner': '[20*X(1)/(20 - X(2)); 0]',
                   'normal': '([X(1)/(20 - X(2)); -1]/sqrt(1 + sqr(X(1)/(20 - X(2)))))',
                   'gap': '(20*sqr(X(1)/(20 - X(2))))'}}


def make_mesh(edge):
    """The mesh and the numbers of its named parts."""
    with tempfile.TemporaryDirectory() as folder:
        geo, msh = os.path.join(folder, 'hertz.geo'), os.path.join(folder, 'hertz.msh')
        with open(geo, 'w') as file:
            file.write('edge = %g;\n' % edge + GEOMETRY)
        subprocess.run(['gmsh', '-2', '-order', '2', '-format', 'msh2', '-v', '1', '-o', msh, geo],
                       check=True)
        with open(msh) as file:
            parts = {name: int(number)
                     for number, name in re.findall(r'^[12] (\d+) "(\w+)"', file.read(), re.M)}
        return gf.Mesh('import', 'gmsh', msh), parts


def part_of(mesh, number):
    part = gf.Mesh('clone', mesh)
    keep = set(mesh.region(number)[0])
    part.del_convex([c for c in mesh.cvid() if c not in keep])
    return part


class Problem:
    """Cylinder 1 on block 2."""

    def __init__(self, frame, edge):
        mesh, parts = make_mesh(edge)
        cylinder, block = part_of(mesh, parts['cylinder']), part_of(mesh, parts['block'])
        self.parts, self.model = parts, gf.Model('real')
        self.kept = [mesh, cylinder, block]  # GetFEM frees what Python no longer holds
        model = self.model
        model.add_initialized_data('lambda', E * NU / ((1 + NU) * (1 - 2 * NU)))
        model.add_initialized_data('G', E / (2 * (1 + NU)))
        for i, body in (('1', cylinder), ('2', block)):
            basis = gf.MeshFem(body, 2)
            basis.set_classical_fem(2)
            rule = gf.MeshIm(body, gf.Integ('IM_TRIANGLE(6)'))
            model.add_fem_variable('u' + i, basis)
            model.add_fem_data('old' + i, basis)
            model.add_isotropic_linearized_elasticity_brick(rule, 'u' + i, 'lambda', 'G')
            self.kept += [basis, rule]
            if i == '1':
                self.rule = rule
        model.add_initialized_data('top', [0., 0.])
        model.add_initialized_data('base', [0., 0.])
        model.add_Dirichlet_condition_with_simplification('u1', parts['top'], 'top')
        model.add_Dirichlet_condition_with_simplification('u2', parts['base'], 'base')
        self.add_contact(FRAMES[frame], cylinder, block)

    def add_contact(self, frame, cylinder, block):
        model, where = self.model, self.parts['contact']
        linear = gf.MeshFem(cylinder, 2)
        linear.set_classical_fem(1)
        nodes = linear.basic_dof_on_region(where)
        self.points = np.array(linear.basic_dof_nodes(nodes))[:, ::2]
        on_circle = gf.MeshFem('partial', linear, nodes)
        self.kept += [linear, on_circle]
        model.add_fem_variable('traction', on_circle)
        model.add_initialized_data('r', [AUGMENTATION])
        model.add_initialized_data('mu', [MU])
        model.add_interpolate_transformation_from_expression('Partner', cylinder, block,
                                                             frame['partner'])
        model.add_macro('n', frame['normal'])
        model.add_macro('jump', '(u1 - Interpolate(u2, Partner))')
        model.add_macro('slip', '(jump - old1 + Interpolate(old2, Partner))')
        model.add_macro('gap', '(%s - n.jump)' % frame['gap'])
        model.add_nonlinear_term(
            self.rule, '-traction.(Test_u1 - Interpolate(Test_u2, Partner))', where)
        model.add_nonlinear_term(
            self.rule, '-0.01*(traction - Coulomb_friction_coupled_projection(traction, n, slip, '
            'gap, mu, r)).Test_traction', where)

    def step(self, u_x, u_y, friction=MU):
        """Moves the top to (u_x, u_y); the state before is that of the last call."""
        model = self.model
        for i in '12':
            model.set_variable('old' + i, model.variable('u' + i))
        model.set_variable('top', [u_x, u_y])
        model.set_variable('mu', [friction])
        iterations, converged = model.solve('max_res', 1e-9, 'max_iter', 60, 'lsearch', 'simplest',
                                            'alpha min', 1., 'alpha max ratio', 1e12)
        if not converged:
            sys.exit('no convergence at u = (%g, %g)' % (u_x, u_y))
        force = [gf.asm_generic(self.rule, 0, 'traction(%d)' % i, self.parts['contact'], model)
                 for i in (1, 2)]
        print('u = (%.4f, %.4f): force on the cylinder (%.4f, %.4f) N/mm, %d iterations'
              % (u_x, u_y, float(np.squeeze(force[0])), float(np.squeeze(force[1])), iterations),
              flush=True)

    def write(self, path, frame):
        """p, tangential traction and x-component at the nodes of the circle."""
        x, y = self.points
        slope = x / (20 - y) if frame == 'mean' else np.zeros_like(x)
        normal = np.stack([slope, -np.ones_like(x)]) / np.sqrt(1 + slope ** 2)
        traction = self.model.variable('traction').reshape(-1, 2).T
        columns = np.stack([20 * slope if frame == 'mean' else x,
                            -np.sum(traction * normal, 0),
                            traction[1] * normal[0] - traction[0] * normal[1], traction[0]])
        np.savetxt(path, columns[:, np.argsort(x)].T, fmt='%.8g', delimiter=',', comments='',
                   header='x_mm,p_MPa,q_MPa,q_x_MPa')


def main():
    frame, edge, path = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    pressing = sys.argv[4] if len(sys.argv) > 4 else '1'
    gf.util('trace level', 0)
    problem = Problem(frame, edge)
    if pressing == 'frictionless':
        problem.step(0., -PRESS, 0.)
    else:
        for k in range(1, int(pressing) + 1):
            problem.step(0., -PRESS * k / int(pressing))
    problem.write(path.replace('.csv', '_pressed.csv'), frame)
    for k in range(1, STEPS + 1):
        problem.step(SHEAR * k / STEPS, -PRESS)
    problem.write(path, frame)


if __name__ == '__main__':
    main()
