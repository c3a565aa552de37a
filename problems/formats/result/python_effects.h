// The effects of calibrated.py, as core/physics/effects has them.
#ifndef DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_EFFECTS_H_
#define DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_EFFECTS_H_

namespace dhcal {

constexpr char kPythonEffects[] = R"py(
# Effects: what each adds to theta and d of the joints, and to the base, at one pose.

def _effects(q, frames, base, payload, direction):
    rows, shift = _zeros(), [0.0] * 6
    carried = PAYLOAD["mass"] if payload is None else payload
    for effect in EFFECTS:
        joint = effect["joint"] - 1
        name, values = effect["effect"], effect["values"]
        if name in ("link_bending", "base_compliance", "axis_wobble"):
            _add_twist(_twist(effect, joint, q, frames, carried), base, shift)
            continue
        amount = sum(value * _weight(name, parameter, effect, joint, q, frames, carried, direction)
                     for parameter, value in values.items())
        rows[joint][0 if JOINTS[joint]["type"] == "revolute" else 1] += amount
    return rows, shift


def _weight(name, parameter, effect, joint, q, frames, carried, direction):
    """What one unit of a parameter adds to the joint [rad or m]."""
    settings = effect["settings"]
    own = JOINTS[joint]["sign"] * q[joint]
    if name == "joint_gain":
        return own
    if name == "joint_coupling":
        driver = int(settings.get("driver_joint", joint)) - 1
        return JOINTS[driver]["sign"] * q[driver]
    if name in ("gear_harmonic", "gravity_balancer"):
        wave, order = parameter.split("_")
        order = settings.get("order", 1.0) if name == "gear_harmonic" else float(order)
        return (math.sin if wave == "sin" else math.cos)(order * own)
    if name == "transmission_error":
        return _spline(float(parameter[len("at_"):]), settings.get("knot_deg", 3.0), own)
    if settings.get("moment_link", 0) > 0:
        torque = _torque_of_one_moment(settings, joint, frames)
    else:
        torque = _torque(_masses(parameter, effect, carried), joint, frames)
    if name == "joint_compliance":
        return torque
    if name == "torsion_nonlinearity":
        end = settings.get("soft_torque_Nm", 0.0)
        return max(-end, min(torque, end)) if end > 0 else torque ** 3
    if name == "backlash":
        last = 0.0 if direction is None else JOINTS[joint]["sign"] * direction[joint]
        if settings.get("flank", 0) == 0:
            return 0.5 * last
        friction = settings.get("friction_Nm", 0.0)
        if abs(torque) > friction:
            return 0.5 * ((torque > 0) - (torque < 0))
        return -0.5 * last if friction > 0 else 0.0
    raise NotImplementedError(name)


def _spline(knot_angle_deg, knot_deg, angle):
    """Cubic B-spline of the turn around a knot."""
    count = round(360.0 / knot_deg)
    distance = 2 * math.pi / count
    knot = round(math.radians(knot_angle_deg) / distance)
    at = angle / distance
    f = at - math.floor(at)
    g = 1 - f
    pieces = [g ** 3 / 6, (3 * f ** 3 - 6 * f ** 2 + 4) / 6, (3 * g ** 3 - 6 * g ** 2 + 4) / 6,
              f ** 3 / 6]
    return sum(piece for k, piece in enumerate(pieces)
               if (math.floor(at) + k - 1 - knot) % count == 0)


def _masses(parameter, effect, carried):
    """Mass [kg] and first moment [kg m] of each link and of what is carried, (body, mass, moment).

    Where masses are not known a parameter is the product of a flexibility and the unit mass or
    moment that its name ends with: compliance_x_link3_y, flexibility_x_link4_mass.
    """
    if "_x_link" in parameter:
        link, what = parameter[parameter.index("_x_link") + len("_x_link"):].split("_")
        moment = [1.0 if what == axis else 0.0 for axis in "xyz"]
        return [(int(link) - 1, 1.0 if what == "mass" else 0.0, moment)]
    load = [(len(JOINTS), carried, _scaled(PAYLOAD["com"], carried))]
    if LINKS and effect["settings"].get("free_masses", 0) == 0:
        load += [(i, m["mass"], _scaled(m["com"], m["mass"])) for i, m in enumerate(LINKS)]
    return load


def _load(masses, first, point, frames):
    """Force [N] and moment about a point [N m] of gravity on the bodies from `first` on."""
    force, moment = [0.0] * 3, [0.0] * 3
    for body, mass, first_moment in masses:
        if body < first:
            continue
        frame = frames[min(body, len(JOINTS) - 1) + 1]
        arm = _sum(_column(frame, 3), point, -1.0)
        force = _sum(force, GRAVITY, mass)
        moment = _sum(moment, _cross(_sum(_scaled(arm, mass), _turned(frame, first_moment)),
                                     GRAVITY))
    return force, moment


def _torque(masses, joint, frames):
    axis, point = _axis(frames, joint)
    force, moment = _load(masses, joint, point, frames)
    return _dot(axis, moment if JOINTS[joint]["type"] == "revolute" else force)


def _torque_of_one_moment(settings, joint, frames):
    link = int(settings["moment_link"]) - 1
    angle = math.radians(settings.get("moment_deg", 0.0))
    x, axis = _column(frames[link + 1], 0), _axis(frames, link)[0]
    moment = _sum(_scaled(x, math.cos(angle)), _cross(axis, x), math.sin(angle))
    return _dot(_axis(frames, joint)[0], _cross(moment, GRAVITY))


def _beam_start(link, frames):
    frame = frames[link]
    if not MODIFIED or link >= len(JOINTS):
        return _column(frame, 3)
    return _point(frame, [JOINTS[link]["a"], 0.0, 0.0])


def _twist(effect, joint, q, frames, carried):
    """Rotation, translation and place of what the effect turns, in base coordinates."""
    rotation, translation, at = [0.0] * 3, [0.0] * 3, [0.0] * 3
    for parameter, value in effect["values"].items():
        if effect["effect"] == "axis_wobble":
            r, t, at = _wobble(parameter, effect, joint, q, frames), [0.0] * 3, _axis(frames, joint)[1]
        elif effect["effect"] == "base_compliance":
            moment = _load(_masses(parameter, effect, carried), 0, [0.0] * 3, frames)[1]
            axis = "xyz".index(parameter[len("compliance_")])
            r, t = [moment[k] if k == axis else 0.0 for k in range(3)], [0.0] * 3
        else:
            r, t, at = _bend(_masses(parameter, effect, carried), joint, frames)
        rotation, translation = _sum(rotation, r, value), _sum(translation, t, value)
    return rotation, translation, at


def _wobble(parameter, effect, joint, q, frames):
    axis = _axis(frames, joint)[0]
    phase = effect["settings"].get("order", 2.0) * JOINTS[joint]["sign"] * q[joint]
    x = _column(frames[joint], 0)
    x = _sum(x, axis, -_dot(axis, x))
    if _norm(x) < 0.5:
        x = _column(frames[joint], 1)
        x = _sum(x, axis, -_dot(axis, x))
    x = _scaled(x, 1 / _norm(x))
    y = _cross(axis, x)
    u, v = ((math.cos(phase), math.sin(phase)) if parameter == "x" else
            (-math.sin(phase), math.cos(phase)))
    return _sum(_scaled(x, u), y, v)


def _bend(masses, link, frames):
    start, end = _beam_start(link, frames), _beam_start(link + 1, frames)
    beam = _sum(end, start, -1.0)
    length = _norm(beam)
    e = _scaled(beam, 1 / length)
    force, moment = _load(masses, link + 1, end, frames)
    moment = _sum(moment, e, -_dot(e, moment))
    force = _sum(force, e, -_dot(e, force))
    rotation = _sum(_scaled(moment, length), _cross(e, force), length ** 2 / 2)
    translation = _sum(_scaled(force, length ** 3 / 3), _cross(moment, e), length ** 2 / 2)
    return rotation, translation, end


def _add_twist(twist, base, shift):
    """As a perturbation of the base: the same to first order."""
    rotation, translation, at = twist
    moved = _turned(base, _sum(translation, _cross(rotation, at), -1.0))
    turned = _turned(base, rotation)
    for k in range(3):
        shift[k] += moved[k]
        shift[3 + k] += turned[k]
)py";

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_EFFECTS_H_
