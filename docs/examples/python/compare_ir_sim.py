"""Drives the same robots in the same halls by Troupe and by ir-sim, and compares what they sense and how fast they are.

    pip install . ir-sim==2.12.0
    python compare_ir_sim.py 2 100

Halls of 16 m by 16 m with six boxes; robots of 0.44 m by 0.33 m with 16 rays of 5 m, read every 0.1 s, which wander.
Both are commanded from Python.
"""

import math
import os
import statistics
import sys
import tempfile
import time

import irsim
import numpy as np
import yaml
from troupe_gym.worlds import Worlds

HALL = 16.0
BOXES = [(4, 4, 1, 0.3), (12, 4, 0.3, 1), (4, 12, 0.3, 1), (12, 12, 1, 0.3), (8, 6, 1, 0.3), (8, 10, 0.3, 1)]
RAYS = [math.radians(-168.75 + 22.5 * i) for i in range(16)]
LENGTH, WIDTH, RANGE = 0.44, 0.33, 5.0
TURN_S = 2.0
ROUNDS = 5


class Scene:
    """Boxes (x, y, length, width) and the start poses of robots, up to 64 in each hall; all coordinates are positive."""

    def __init__(self, robots):
        halls = -(-robots // 64)
        self.columns = math.ceil(math.sqrt(halls))
        self.rows = -(-halls // self.columns)
        self.width, self.height = self.columns * HALL, self.rows * HALL
        self.boxes = [(self.width / 2, y, self.width, 0.2) for y in (0.1, self.height - 0.1)]
        self.boxes += [(x, self.height / 2, 0.2, self.height) for x in (0.1, self.width - 0.1)]
        halls = self.columns * self.rows
        for hall in range(halls):
            left, bottom = hall % self.columns * HALL, hall // self.columns * HALL
            self.boxes += [(left + x, bottom + y, length, width) for x, y, length, width in BOXES]
        self.poses = []
        for i in range(robots):
            hall, slot = i % halls, (i // halls * 27 + 13) % 64
            x = hall % self.columns * HALL + (slot % 8 + 0.5) * 2
            y = hall // self.columns * HALL + (slot // 8 + 0.5) * 2
            self.poses.append((x, y, math.remainder(i * 2.399963, 2 * math.pi)))

    def world(self):
        """The world file of Troupe, whose origin is in the middle."""
        middle = (self.width / 2, self.height / 2)
        lines = ['define wall model ( color "black" )']
        for x, y, length, width in self.boxes:
            lines.append(f"wall ( pose [ {x - middle[0]} {y - middle[1]} 0 0 ] size [ {length} {width} 0.5 ] )")
        ring = " ".join(f"spose[{i}] [ 0 0 {math.degrees(ray)} ]" for i, ray in enumerate(RAYS))
        for i, (x, y, heading) in enumerate(self.poses):
            lines.append(f'position ( name "r{i}" pose [ {x - middle[0]} {y - middle[1]} 0 {math.degrees(heading)} ]')
            lines.append(f"  size [ {LENGTH} {WIDTH} 0.2 ] ranger ( scount 16 {ring} sview [ 0 {RANGE} 15 ] ) )")
        return "\n".join(lines)

    def ir_sim(self, poses):
        """The world of ir-sim, with robots at these poses."""
        lidar = {"name": "lidar2d", "range_min": 0, "range_max": RANGE, "number": 16, "noise": False}
        lidar["angle_range"] = RAYS[-1] - RAYS[0]
        robots = [
            {
                "kinematics": {"name": "diff"},
                "shape": {"name": "rectangle", "length": LENGTH, "width": WIDTH},
                "state": [float(value) for value in pose],
                "vel_max": [1, 3],
                "vel_min": [-1, -3],
                "sensors": [lidar],
            }
            for pose in poses
        ]
        boxes = [
            {"shape": {"name": "rectangle", "length": length, "width": width}, "state": [x, y, 0]}
            for x, y, length, width in self.boxes
        ]
        world = {"width": self.width, "height": self.height, "step_time": 0.1, "sample_time": 0.1}
        world["collision_mode"] = "stop"
        return yaml.dump({"world": world, "robot": robots, "obstacle": boxes})


class Wander:
    """Drives ahead, towards the freer side; turns where something is near. Takes and gives a row for each robot."""

    def __init__(self, robots):
        self.side = np.zeros(robots)

    def actions(self, ranges):
        right, left = ranges[:, 5:8].sum(axis=1), ranges[:, 8:11].sum(axis=1)
        blocked = ranges[:, 5:11].min(axis=1) < 0.6
        self.side = np.where(blocked, np.where(self.side == 0, np.where(left >= right, 1, -1), self.side), 0)
        turn = np.where(blocked, 1.2 * self.side, np.clip(0.05 * (left - right), -0.5, 0.5))
        return np.stack([np.where(blocked, 0, 0.4), turn], axis=1)


class Troupe:
    def __init__(self, scene, folder):
        file = os.path.join(folder, "halls.world")
        with open(file, "w") as out:
            out.write(scene.world())
        self.worlds = Worlds(1, world=file)
        self.seen = self.worlds.exchange([1])[0]
        self.ranges = self.seen.ranges

    def step(self, actions):
        self.ranges = self.worlds.exchange([actions])[0].ranges


class IrSim:
    def __init__(self, scene, poses, folder):
        file = os.path.join(folder, "halls.yaml")
        with open(file, "w") as out:
            out.write(scene.ir_sim(poses))
        self.env = irsim.make(file, display=False, log_level="ERROR")
        self.robots = len(poses)
        self.step(np.zeros((self.robots, 2)))

    def step(self, actions):
        self.env.step([action.reshape(2, 1) for action in actions], list(range(self.robots)))
        self.ranges = np.array([self.env.get_lidar_scan(i)["ranges"] for i in range(self.robots)])


def speed(world, wander):
    """Simulated seconds per second, of a turn."""
    steps = 0
    start = time.perf_counter()
    while time.perf_counter() - start < TURN_S:
        world.step(wander.actions(world.ranges))
        steps += 1
    return steps * 0.1 / (time.perf_counter() - start)


def compare(robots, folder):
    scene = Scene(robots)
    troupe = Troupe(scene, folder)
    seen = troupe.seen
    poses = np.stack([seen.x + scene.width / 2, seen.y + scene.height / 2, seen.heading], axis=1)
    ir_sim = IrSim(scene, poses, folder)
    differences = np.abs(troupe.ranges - ir_sim.ranges)
    print(f"{robots} robots: {np.mean(differences < 0.03):.1%} of the first ranges differ by less than 3 cm")
    worlds = [(troupe, Wander(robots)), (ir_sim, Wander(robots))]
    for world, wander in worlds:
        speed(world, wander)  # warms up
    rounds = [[speed(world, wander) for world, wander in worlds] for _ in range(ROUNDS)]
    ours, theirs = (statistics.median(column) for column in zip(*rounds))
    ratios = sorted(a / b for a, b in rounds)
    print(f"  Troupe {ours:,.0f}, ir-sim {theirs:,.2f} simulated seconds a second;", end=" ")
    print(f"ratio {statistics.median(ratios):,.1f} ({ratios[0]:,.1f} to {ratios[-1]:,.1f})", flush=True)
    troupe.worlds.close()
    ir_sim.env.end(0)


if __name__ == "__main__":
    for number in sys.argv[1:] or ["2", "100"]:
        with tempfile.TemporaryDirectory() as folder:
            compare(int(number), folder)
