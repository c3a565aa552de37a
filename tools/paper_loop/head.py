"""The measuring head of English et al. (2004) along placements of a straight edge: a camera over
its rulings and two lasers over its flat face. Sights are followed from the tool to the face."""

import math
import re

from frames import by_rpy, plus, turned

CAMERA = (0.020, 0, 0)  # [m] in the tool frame; all sensors look along its z axis
LASERS = ((-0.030, 0.050, 0.010), (-0.030, -0.050, 0.010))
NOISE = (20e-6, 10e-6, 10e-6)  # [m] of ruler and heights
RULER_BEGINS = 0.317  # [m] what the ruler says in the middle of a placement
EDGE_LINE = re.compile(r"\s*((P\d+): \{xyz_mm: \[(.*)\], rpy_deg: \[(.*)\]\})")


class Edges:
    """Placements as dhcal_plan printed them, as lines for the key measurement.edges."""

    def __init__(self, report):
        found = [match for match in map(EDGE_LINE.fullmatch, report.splitlines()) if match]
        self.lines = [match[1] for match in found]
        self.planned = {}  # name: X_BE
        for _, name, xyz_mm, rpy_deg in (match.groups() for match in found):
            self.planned[name] = by_rpy([1e-3 * float(x) for x in xyz_mm.split(",")],
                                        [math.radians(float(x)) for x in rpy_deg.split(",")])

    def set_up(self, rng):
        """{name: X_BE} where they come to stand: some millimetres and milliradians elsewhere."""
        return {name: X_BE * turned([rng.gauss(0, 2e-3) for _ in range(3)],
                                    [rng.gauss(0, 3e-3) for _ in range(3)])
                for name, X_BE in self.planned.items()}


def meets(X_EQ, sensor, height=0):
    """(x along the ruler, length of the sight) where a sensor meets a face z = height [m]."""
    eye, way = X_EQ.point(sensor), X_EQ.axis(2)
    length = (height - eye[2]) / way[2]
    return plus(eye, way, length)[0], length


def numbers(X_EQ):
    """Ruler, height 1, height 2 [m], without noise."""
    return (RULER_BEGINS + meets(X_EQ, CAMERA)[0], *(meets(X_EQ, laser)[1] for laser in LASERS))


def coarse(X_EQ, heights):
    """[m] Where the camera should be along the ruler by a rough pose over the edge: the face lies
    where the lasers meet it."""
    faces = [X_EQ.point(laser)[2] + height * X_EQ.axis(2)[2]
             for laser, height in zip(LASERS, heights)]
    return RULER_BEGINS + meets(X_EQ, CAMERA, sum(faces) / len(faces))[0]
