// What calibrated.py computes with: the chain of core/NOTATION.md, its inverse, and vectors.
#ifndef DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_CHAIN_H_
#define DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_CHAIN_H_

namespace dhcal {

constexpr char kPythonChain[] = R"py(
EYE = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]


def forward(q, run=None, target=None, payload=None, direction=None, incomplete=False):
    """Pose of the measured point in the measurement frame, 4 x 4 [m].

    q: joint coordinates as the controller reports them [rad or m]
    run, target: which base or tool, where ROBOT has several (BASES, TOOLS)
    payload: mass carried [kg]; default: that of the problem file
    direction: sense of each joint's last motion, -1, 0 or 1, as the controller counts (backlash)
    incomplete: True = compute although LEFT_OUT says that effects are missing
    """
    if LEFT_OUT and not incomplete:
        raise RuntimeError("this file cannot hold: " + "; ".join(LEFT_OUT)
                           + ". forward(..., incomplete=True) computes without.")
    if len(q) != len(JOINTS):
        raise ValueError("expected %d joint coordinates, got %d" % (len(JOINTS), len(q)))
    base = _choose(BASES, run, "run")
    # Loads bend the arm, and the bent arm has other loads: twice is enough.
    rows, shift = _zeros(), [0.0] * 6
    for _ in range(3):
        frames = _link_frames(q, rows)
        rows, shift = _effects(q, frames, base, payload, direction)
    frames = _link_frames(q, rows)
    return _times(_perturbed(base, shift), _times(frames[-1], _choose(TOOLS, target, "target")))


def inverse(goal, start, tolerance=1e-10, **circumstances):
    """Joint coordinates near `start` that reach `goal`: a pose (4 x 4) or a position [m] (3).

    Damped Gauss-Newton steps; ValueError where they do not get there from this start.
    """
    q, damping = list(start), 1e-6
    error = _error(forward(q, **circumstances), goal)
    for _ in range(200):
        if max(abs(e) for e in error) < tolerance:
            return q
        columns = []
        for j in range(len(q)):
            ahead, behind = list(q), list(q)
            ahead[j] += 1e-6
            behind[j] -= 1e-6
            e1 = _error(forward(ahead, **circumstances), goal)
            e0 = _error(forward(behind, **circumstances), goal)
            columns.append([(a - b) / 2e-6 for a, b in zip(e1, e0)])
        step = _damped_step(columns, error, damping)
        there = [a + b for a, b in zip(q, step)]
        new = _error(forward(there, **circumstances), goal)
        if sum(e * e for e in new) < sum(e * e for e in error):
            q, error, damping = there, new, max(damping / 10, 1e-15)
        else:
            damping *= 10
            if damping > 1e6:
                break
    raise ValueError("not reached from this start; %.3g m or rad are left"
                     % max(abs(e) for e in error))


# Vectors, rotations, frames.

def _times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def _point(x, p):
    return [sum(x[i][k] * p[k] for k in range(3)) + x[i][3] for i in range(3)]


def _turned(x, v):
    return [sum(x[i][k] * v[k] for k in range(3)) for i in range(3)]


def _column(x, k):
    return [x[0][k], x[1][k], x[2][k]]


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _sum(a, b, times=1.0):
    return [x + times * y for x, y in zip(a, b)]


def _scaled(a, times):
    return [times * x for x in a]


def _norm(a):
    return math.sqrt(_dot(a, a))


def _about(axis, angle):
    c, s, k = math.cos(angle), math.sin(angle), axis
    i, j = [(1, 2), (2, 0), (0, 1)][k]
    x = [row[:] for row in EYE]
    x[i][i], x[i][j], x[j][i], x[j][j] = c, -s, s, c
    return x


def _along(x, y, z):
    return [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]


def _exp(r):
    """Rotation by the vector r (Rodrigues)."""
    angle = _norm(r)
    if angle < 1e-6:
        s, c = 1 - angle * angle / 6, 0.5 - angle * angle / 24
    else:
        s, c = math.sin(angle) / angle, (1 - math.cos(angle)) / (angle * angle)
    w = [[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]]
    return [[EYE[i][j] + s * w[i][j] + c * sum(w[i][k] * w[k][j] for k in range(3))
             for j in range(3)] for i in range(3)]


def _log(r):
    """Rotation vector of a rotation, below half a turn."""
    v = [(r[2][1] - r[1][2]) / 2, (r[0][2] - r[2][0]) / 2, (r[1][0] - r[0][1]) / 2]
    sine, cosine = _norm(v), (r[0][0] + r[1][1] + r[2][2] - 1) / 2
    angle = math.atan2(sine, cosine)
    if sine > 1e-8:
        return _scaled(v, angle / sine)
    if cosine > 0:
        return v
    k = max(range(3), key=lambda i: r[i][i])
    axis = [(r[i][k] + (1.0 if i == k else 0.0)) for i in range(3)]
    return _scaled(axis, angle / _norm(axis))


def _perturbed(x, shift):
    """Translation added, rotation from the left."""
    r = _exp(shift[3:])
    turned = [[sum(r[i][k] * x[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return [turned[i] + [x[i][3] + shift[i]] for i in range(3)] + [EYE[3][:]]


def _choose(frames, name, what):
    if name is None:
        return frames[0][1]
    for own, frame in frames:
        if own == name:
            return frame
    raise ValueError("no %s %r; there are: %s" % (what, name, ", ".join(f[0] for f in frames)))


# The chain. `rows`: what effects add to theta and d of each joint.

def _zeros():
    return [[0.0, 0.0] for _ in JOINTS]


def _link_frames(q, rows):
    """Frames in the base: of the base itself, and where each row ends."""
    frames = [EYE]
    for joint, value, (theta_more, d_more) in zip(JOINTS, q, rows):
        turns = joint["type"] == "revolute"
        moved = joint["sign"] * value
        theta = joint["theta"] + (moved if turns else 0.0) + theta_more
        d = joint["d"] + (0.0 if turns else moved) + d_more
        screw = _times(_about(2, theta), _along(0.0, 0.0, d))
        if MODIFIED:
            x = _times(_about(0, joint["alpha"]), _along(joint["a"], 0.0, 0.0))
            x = _times(_times(x, _about(1, joint["beta"])), screw)
        else:
            x = _times(_times(screw, _along(joint["a"], 0.0, 0.0)), _about(0, joint["alpha"]))
            x = _times(x, _about(1, joint["beta"]))
        frames.append(_times(frames[-1], x))
    return frames


def _axis(frames, joint):
    frame = frames[joint + 1 if MODIFIED else joint]
    return _column(frame, 2), _column(frame, 3)


def _error(pose, goal):
    if len(goal) == 3:
        return [pose[i][3] - goal[i] for i in range(3)]
    rotation = [[sum(pose[i][k] * goal[j][k] for k in range(3)) for j in range(3)]
                for i in range(3)]
    return [pose[i][3] - goal[i][3] for i in range(3)] + _log(rotation)


def _damped_step(columns, error, damping):
    """-(J'J + damping I)^-1 J' e, by elimination with pivots."""
    n = len(columns)
    rows = [[sum(a * b for a, b in zip(columns[i], columns[j])) + (damping if i == j else 0.0)
             for j in range(n)] + [-sum(a * b for a, b in zip(columns[i], error))]
            for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            for j in range(i, n + 1):
                rows[k][j] -= factor * rows[i][j]
    step = [0.0] * n
    for i in reversed(range(n)):
        step[i] = (rows[i][n] - sum(rows[i][j] * step[j] for j in range(i + 1, n))) / rows[i][i]
    return step
)py";

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_CHAIN_H_
