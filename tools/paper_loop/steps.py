"""The steps of the loop, each with the files that it leaves."""

import dataclasses
import json
import math
import pathlib
import random
import re

import head
import photographs
import robot
import trajectory
from frames import plus
from programs import JOINTS_DEG, Failed, degrees, read_joints, write_table, write_whole

DRAWING = pathlib.Path(__file__).with_name("problem.yaml")
VOLUME_M = "0.3,-1.1,0,1.6,1.1,1.4"  # where there is room for the edge
SENSES = [f"dir{joint}" for joint in range(1, 7)]
POSE = ["x_mm", "y_mm", "z_mm", "roll_deg", "pitch_deg", "yaw_deg"]
SAME_POINT = 1e-8  # [m] how near two calculations of the drawn robot must come


@dataclasses.dataclass
class Plan:
    """What is made once, before anything is measured."""

    robot: str  # which of robot.LEFT_OUT
    edges: head.Edges
    poses: list  # [rad] to measure at
    edge_of_pose: list
    points: list  # [m] wanted of the tool
    commands: list  # [rad] that the drawn robot needs for them


@dataclasses.dataclass
class Outcome:
    """Of one seed: (mean, RMS, worst) of the trajectory's 3-D errors [m]."""

    seed: int
    before: tuple
    rigid: tuple  # corrected by the best rows without effects
    after: tuple
    predicted: float  # [m] RMS
    verdict: str
    right: bool  # all that was put in is found, nothing else, and no alternative


def wanted_table(path, points, commands=None):
    """Wanted poses; beside them where the arm is then, and how it gets there."""
    rows = [[f"{1e3 * x:.6f}" for x in point] + list(trajectory.RPY_DEG) for point in points]
    if commands is None:
        write_table(path, POSE, rows)
        return
    write_table(path, POSE + JOINTS_DEG + SENSES,
                [row + degrees(q) + list(senses)
                 for row, q, senses in zip(rows, commands, robot.senses(commands))])


def make_plan(options, programs):
    """planned.csv, plan.txt: where to put the edge; wanted.csv, nominal.csv: the trajectory, and
    the joint angles of the drawn robot for it."""
    out = options.out
    write_whole(out / "plan.yaml", DRAWING.read_text(encoding="utf-8"))
    report = programs.run(out, "dhcal_plan", "--problem", "plan.yaml", "--criterion", "I",
                          "--poses", options.placements, "--candidates", options.candidates,
                          "--volume_m", VOLUME_M, "--out", "planned.csv")
    write_whole(out / "plan.txt", report)
    poses, rows = read_joints(out / "planned.csv", "rad")
    points = trajectory.wanted_points()
    wanted_table(out / "wanted.csv", points)
    home = ",".join(f"{math.degrees(x):.6g}" for x in robot.HOME)
    programs.run(out, "dhcal_compensate", "--model", "plan.yaml", "--poses", "wanted.csv",
                 "--seed_deg", home, "--out", "nominal.csv")
    commands, _ = read_joints(out / "nominal.csv")
    off = max(math.dist(a, b) for a, b in zip(robot.drawn().follow(commands), points))
    if off > SAME_POINT:
        raise Failed(f"the drawn robots of {DRAWING.name} and robot.py stand {1e6 * off:.3g} um "
                     "apart; one of them was changed: make them alike")
    return Plan(options.robot, head.Edges(report), poses, [row["edge"] for row in rows], points,
                commands)


def problem_text(plan):
    """The user's file: the drawing, where the edge was put, about, and the work as the task."""
    return (re.sub(r"(?m)^task: .*$", "task: {poses: ../nominal.csv}",
                   DRAWING.read_text(encoding="utf-8"))
            + "  edges:\n" + "".join(f"    {line}\n" for line in plan.edges.lines))


def measure(folder, plan, arm, seed):
    """recording.csv of the real robot, and what photographs of the same poses need."""
    rng = random.Random(f"measure {seed}")
    placed = plan.edges.set_up(rng)
    arm.go(robot.HOME)
    rows, seen = [], []
    for q, senses, edge in zip(plan.poses, robot.senses(plan.poses), plan.edge_of_pose):
        X_EQ = placed[edge].inverse() * arm.go(q)
        noise = [rng.gauss(0, sigma) for sigma in head.NOISE]
        readings = [x + e for x, e in zip(head.numbers(X_EQ), noise)]
        rows.append(degrees(q) + list(senses) + [edge] + [f"{1e3 * x:.4f}" for x in readings])
        seen.append((X_EQ, noise[0]))
    write_table(folder / "recording.csv",
                JOINTS_DEG + SENSES + ["edge", "ruler_mm", "height1_mm", "height2_mm"], rows)
    return seen


def read_photographs(folder, plan, seen, programs, seed):
    """images/*.png of the poses; recording.csv anew, its ruler read from them."""
    rng = random.Random(f"photographs {seed}")
    (folder / "images").mkdir(exist_ok=True)
    turn_of = {edge: photographs.camera_turn([X for (X, _), e in zip(seen, plan.edge_of_pose)
                                              if e == edge]) for edge in plan.edges.planned}
    names = [f"images/{k:03}.png" for k in range(len(seen))]
    for name, (X_EQ, moved), edge in zip(names, seen, plan.edge_of_pose):
        image = photographs.photograph(X_EQ, turn_of[edge], moved, rng)
        (folder / name).write_bytes(photographs.png(image))
    _, rows = read_joints(folder / "recording.csv")
    drawn, table = robot.drawn(), []
    for row, q in zip(rows, plan.poses):
        X_EQ = plan.edges.planned[row["edge"]].inverse() * drawn.go(q)
        heights = [1e-3 * float(row[f"height{k}_mm"]) for k in (1, 2)]
        row["coarse_mm"] = f"{1e3 * head.coarse(X_EQ, heights):.2f}"
        del row["ruler_mm"]
        table.append(list(row.values()))
    write_table(folder / "readings.csv", list(rows[0]), table)
    programs.run(folder, "dhcal_ruler", *names, "--pitch_mm", 1e3 * photographs.PITCH, "--readings",
                 "readings.csv", "--out", "recording.csv", "--details", "details.csv")


def corrected(folder, plan, programs, model, name):
    """Commands for the real robot by a model of it. The sense in which a joint arrives is that of
    the commands, so they are made twice."""
    commands = plan.commands
    for _ in range(2):
        wanted_table(folder / "wanted.csv", plan.points, commands)
        programs.run(folder, "dhcal_compensate", "--model", f"result/{model}",
                     "--poses", "wanted.csv", "--out", name)
        commands, _ = read_joints(folder / name)
    return commands


def found_in(result):
    """Names, joints and orders of the effects that the delivered model holds."""
    effects = result.get("delivered", {"effects": []})["effects"]
    return {(e["effect"], e.get("joint"), e.get("settings", {}).get("order")) for e in effects}


def errors_of(plan, arm, commands):
    """(mean, RMS, worst) of the trajectory that the real robot follows [m]."""
    errors = [plus(at, wanted, -1) for at, wanted in zip(arm.follow(commands), plan.points)]
    return trajectory.figures(trajectory.without_motion(plan.points, errors))


def go_round(out, plan, programs, seed, images=False):
    """The loop for one seed, in the folder seed_N (with photographs seed_N_images)."""
    folder = out / (f"seed_{seed}_images" if images else f"seed_{seed}")
    folder.mkdir(exist_ok=True)
    physics = robot.LEFT_OUT[plan.robot]
    arm = robot.built(random.Random(f"robot {seed}"), physics)
    seen = measure(folder, plan, arm, seed)
    if images:
        read_photographs(folder, plan, seen, programs, seed)
    write_whole(folder / "problem.yaml", problem_text(plan))
    programs.run(folder, "ceres_dhcal", "--problem", "problem.yaml", "--out", "result", "--quiet")
    result = json.loads((folder / "result/result.json").read_text(encoding="utf-8"))
    commands = corrected(folder, plan, programs, "calibrated.yaml", "commands.csv")
    rigid = commands
    if (folder / "result/calibrated_rigid.yaml").exists():
        rigid = corrected(folder, plan, programs, "calibrated_rigid.yaml", "commands_rigid.csv")
    verdict = result["diagnosis"]["verdict"]
    right = (verdict in ("explained", "consistent")
             and found_in(result) == robot.names_of(physics))
    return Outcome(seed, errors_of(plan, arm, plan.commands), errors_of(plan, arm, rigid),
                   errors_of(plan, arm, commands), result["task"]["after_rms_m"],
                   verdict, right)
