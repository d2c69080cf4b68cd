"""The packing of prm/grains/packing.prm as rigid discs with springs at their contacts, by YADE: yade -n -x discs.py DISCS.csv RESULT.json.

The springs are those of elastic discs pressed at one point: the approach of centre and contact under a force F per length is
2 F (1 - nu^2)/(pi E) (ln(4 R/a) - 1/2) with the half width a of Hertz (Johnson, Contact Mechanics, 5.6), nearly linear in F; each disc has
the secant for F = 15, the mean contact force. Two discs are springs in series; walls are stiff. Tangential springs are as stiff.
"""
import csv
import json
import math
import sys

from yade import *  # noqa: F403  the names of YADE's own shell

YOUNG, POISSON, FRICTION, EDGE, MOTION, FORCE, N_STEPS = 1000.0, 0.3, 0.3, 40.0, 0.2, 15.0, 10


def spring(radius):
    modulus = YOUNG / (1.0 - POISSON ** 2)
    half_width = math.sqrt(4.0 * FORCE * radius / (math.pi * modulus))
    return math.pi * modulus / (2.0 * (math.log(4.0 * radius / half_width) - 0.5))


with open(sys.argv[1], encoding="utf-8") as file:
    DISCS = [{key.strip(): value.strip() for key, value in row.items()} for row in csv.DictReader(file)]
angle = math.atan(FRICTION)
stiff = O.materials.append(FrictMat(young=1e9, poisson=1.0, frictionAngle=angle, density=1.0))
for disc in DISCS:
    radius = float(disc["Radius"])
    # YADE takes kn = 2 / (1/(E1 R1) + 1/(E2 R2)) and ks = poisson kn: E R/2 is our spring from centre to contact, times two.
    material = O.materials.append(FrictMat(young=spring(radius) / radius / 2.0, poisson=1.0, frictionAngle=angle, density=1.0))
    ball = sphere((float(disc["Centre x"]), float(disc["Centre y"]), 0.0), radius, material=material)
    ball.state.blockedDOFs = "zXY"
    disc["id"] = O.bodies.append(ball)
# Name: number, axis, sense of its way inwards.
WALLS = {name: (O.bodies.append(wall(place, axis, sense=sense, material=stiff)), axis, sense)
         for name, place, axis, sense in (("left", 0.0, 0, 1), ("right", EDGE, 0, -1), ("bottom", 0.0, 1, 1), ("top", EDGE, 1, -1))}
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.4),
]
O.dt = 0.3 * PWaveTimeStep()


def velocity(speed):
    for number, axis, sense in WALLS.values():
        O.bodies[number].state.vel = tuple(sense * speed if d == axis else 0.0 for d in range(3))


def settle():
    """Until forces on discs are in balance to 1e-5 of the mean contact force."""
    velocity(0.0)
    for _ in range(2000):
        O.run(500, True)
        if unbalancedForce() < 1e-5:
            return
    sys.exit("no equilibrium")


curve = []
for step in range(1, N_STEPS + 1):
    n = 20000
    velocity(MOTION / N_STEPS / (n * O.dt))
    O.run(n, True)
    settle()
    curve.append([step / N_STEPS, *(abs(O.forces.f(number)[axis]) for number, axis, _ in WALLS.values())])

names = {disc["id"]: disc["Name"] for disc in DISCS}
names.update({number: name for name, (number, _, _) in WALLS.items()})
contacts = [[names[i.id1], names[i.id2], i.phys.normalForce.norm(), i.phys.shearForce.norm()] for i in O.interactions
            if i.isReal and i.phys.normalForce.norm() > 0.0]
with open(sys.argv[2], "w", encoding="utf-8") as file:
    json.dump({"curve": curve, "contacts": contacts, "seconds": O.time}, file)
