"""Vectors and poses in space, without numpy: a pose is the rows of its rotation and a shift."""

import math


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def plus(a, b, times=1.0):
    """a + times b"""
    return (a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2])


def norm(a):
    return math.sqrt(dot(a, a))


def solve3(rows, b):
    """x of rows x = b, 3 x 3, by Cramer's rule."""
    columns = list(zip(*rows))
    determinant = dot(columns[0], cross(columns[1], columns[2]))
    return tuple(
        dot(c[0], cross(c[1], c[2])) / determinant
        for c in ([b if k == j else columns[k] for k in range(3)] for j in range(3)))


class Pose:
    """X_AB: `shift` is B's origin in A, the rows of `turn` are those of R_AB."""

    def __init__(self, turn=((1, 0, 0), (0, 1, 0), (0, 0, 1)), shift=(0, 0, 0)):
        self.turn, self.shift = turn, shift

    def __mul__(self, other):
        columns = list(zip(*other.turn))
        return Pose(tuple(tuple(dot(row, column) for column in columns) for row in self.turn),
                    self.point(other.shift))

    def way(self, v):
        """A direction or difference of B in A's axes."""
        return tuple(dot(row, v) for row in self.turn)

    def point(self, p):
        return plus(self.shift, self.way(p))

    def axis(self, k):
        return tuple(row[k] for row in self.turn)

    def inverse(self):
        back = Pose(tuple(zip(*self.turn)))
        return Pose(back.turn, plus((0, 0, 0), back.way(self.shift), -1))


def turned(rotation, shift=(0, 0, 0)):
    """The pose of a rotation vector [rad] (Rodrigues) and a shift."""
    angle = norm(rotation)
    if angle == 0:
        return Pose(shift=shift)
    x, y, z = (r / angle for r in rotation)
    c, s = math.cos(angle), math.sin(angle)
    v = 1 - c
    return Pose(((c + x * x * v, x * y * v - z * s, x * z * v + y * s),
                 (y * x * v + z * s, c + y * y * v, y * z * v - x * s),
                 (z * x * v - y * s, z * y * v + x * s, c + z * z * v)), shift)


def by_rpy(shift, rpy):
    """Turned about the fixed x, then y, then z axis [rad]."""
    roll, pitch, yaw = rpy
    return turned((0, 0, yaw), shift) * turned((0, pitch, 0)) * turned((roll, 0, 0))
