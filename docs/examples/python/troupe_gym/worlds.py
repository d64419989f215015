"""The process that simulates worlds, and the frames by which it is asked to step them."""

import json
import os
import shlex
import struct
import subprocess
import threading

import numpy as np

LEAVE = b"\0"
STEP = b"\1"
RESET = b"\2"


class TroupeError(RuntimeError):
    """The process refused a request, or it has ended."""


class Seen:
    """What the robots of one world sense and where they are. Arrays have a row for each robot.

    time_s      simulated time since the reset
    x, y        true position, in metres
    heading     in radians, from -pi to pi
    stalled     whether something holds the robot back
    collided    whether it began to touch something in this step
    ranges      of all sonars, in metres
    """

    def __init__(self, numbers, robots):
        self.time_s = float(numbers[0])
        rows = numbers[1:].reshape(robots, -1)
        self.x, self.y, self.heading = rows[:, 0], rows[:, 1], rows[:, 2]
        self.stalled, self.collided = rows[:, 3] != 0, rows[:, 4] != 0
        self.ranges = rows[:, 5:]


def _words(command, options):
    words = command or os.environ.get("TROUPE", "troupe")
    words = shlex.split(words) if isinstance(words, str) else list(words)
    words += ["learn", "serve"]
    for name, value in options.items():
        if value is not None:
            words += ["--" + name, str(value)]
    return words


class Worlds:
    """A process with a number of worlds.

    count       number of worlds
    command     what starts Troupe, a text or a list; by default the variable TROUPE, or "troupe"
    options     of `troupe learn serve`, for example random="maze", side=12, robots=2, or world="my.world"
    """

    def __init__(self, count=1, command=None, **options):
        self._process = None
        words = _words(command, {"worlds": count, **options})
        try:
            self._process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        except OSError as problem:
            raise TroupeError(f"{words[0]} cannot be started: {problem}; name it by command=.. or the variable TROUPE")
        self._errors = []
        self._reader = threading.Thread(target=self._read_errors, daemon=True)
        self._reader.start()
        try:
            hello = json.loads(self._receive())
        except BaseException:
            self.close()
            raise
        if hello["protocol"] != 1:
            self.close()
            raise TroupeError(f"{words[0]} speaks protocol {hello['protocol']}, expected 1")
        self.count = hello["worlds"]
        self.robots = hello["robots"]
        self.sonars = hello["sonars"]
        self.greatest_range_m = hello["greatestRangeM"]
        self.interval_s = hello["intervalS"]

    def _read_errors(self):
        for line in self._process.stderr:
            self._errors.append(line.decode(errors="replace").rstrip())
            del self._errors[:-20]

    def exchange(self, demands):
        """Resets and steps worlds. Returns a list with a Seen, or None, for each world.

        demands     for each world None (leave it alone), an int (reset it with this seed) or an array of two numbers
                    for each robot (step it): speed in m/s and turn rate in rad/s, left positive
        """
        if len(demands) != self.count:
            raise ValueError(f"{len(demands)} demands for {self.count} worlds")
        parts = []
        for demand in demands:
            if demand is None:
                parts.append(LEAVE)
            elif isinstance(demand, (int, np.integer)):
                parts.append(RESET + struct.pack(">q", int(demand)))
            else:
                actions = np.asarray(demand, dtype=">f8").reshape(-1)
                if actions.size != 2 * self.robots:
                    raise ValueError(f"{actions.size} numbers for {self.robots} robots, expected two for each")
                parts.append(STEP + actions.tobytes())
        request = b"".join(parts)
        try:
            self._process.stdin.write(struct.pack(">I", len(request)) + request)
            self._process.stdin.flush()
        except (OSError, ValueError):
            pass  # the answer says why
        answer = self._receive()
        if answer[0] != 0:
            raise TroupeError(answer[1:].decode())
        asked = [i for i, demand in enumerate(demands) if demand is not None]
        numbers = np.frombuffer(answer, dtype=">f8", offset=1).astype(np.float64).reshape(len(asked), -1)
        seen = [None] * self.count
        for i, row in zip(asked, numbers):
            seen[i] = Seen(row, self.robots)
        return seen

    def _receive(self):
        header = self._read(4)
        return self._read(struct.unpack(">I", header)[0])

    def _read(self, length):
        data = self._process.stdout.read(length) if not self._process.stdout.closed else b""
        if len(data) < length:
            if self._process.stdout.closed:
                raise TroupeError("the worlds are closed")
            self._process.stdin.close()
            status = self._process.wait()
            self._reader.join(5)
            raise TroupeError(f"the process of Troupe has ended with status {status}: " + " ".join(self._errors[-3:]))
        return data

    def close(self):
        """Ends the process; may be called twice."""
        if self._process is None:
            return
        for stream in (self._process.stdin, self._process.stdout):
            try:
                stream.close()
            except OSError:
                pass
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._reader.join(5)
        self._process.stderr.close()

    def __enter__(self):
        return self

    def __exit__(self, *problem):
        self.close()
