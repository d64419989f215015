#!/usr/bin/env python3
"""Drives one robot of a Player server where there is room.

usage: wanderer.py HOST PORT INDEX

Python's standard library is all it needs. It speaks the Player 3 protocol: framed XDR messages over TCP. It asks for its
data frame by frame (pull mode), so a world in lock step waits for it. Its first line of output says that it is ready; it
ends with status 0 when the server goes away or when it is terminated, with status 1 when it is refused.
"""

import math
import signal
import socket
import struct
import sys

PLAYER, POSITION2D, SONAR = 1, 4, 5  # interfaces
DATA, COMMAND, REQUEST, ACK, SYNCH, NACK = 1, 2, 3, 4, 5, 6  # types of messages
SUBSCRIBE, NEXT_FRAME, DATA_MODE = 3, 4, 5  # requests to the server itself
SET_INTEGER_PROPERTY = 253  # request to a device
OPEN, PULL = 1, 2
BANNER_BYTES = 32
HEADER = struct.Struct(">6IdII")  # host, robot, interface, index, type, subtype, time, sequence, size

NEAR_M = 0.5
FAST_MPS = 0.4
TURN_RADPS = 0.6
COMMAND_LIMIT_MS = 400  # our robot stops when this program has been silent for so long


class Player:
    """A connection with a Player server, in pull mode."""

    def __init__(self, host, port):
        self.socket = socket.create_connection((host, port), timeout=10)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.receive(BANNER_BYTES)
        self.request(DATA_MODE, struct.pack(">I", PULL))
        self.socket.settimeout(None)  # a world may stand still for as long as it likes

    def receive(self, size):
        """Exactly so many bytes."""
        parts = []
        while size > 0:
            part = self.socket.recv(size)
            if not part:
                raise ConnectionError("the Player server has closed the connection")
            parts.append(part)
            size -= len(part)
        return b"".join(parts)

    def send(self, interface, index, kind, subtype, body=b""):
        header = HEADER.pack(0, 0, interface, index, kind, subtype, 0.0, 0, len(body))
        self.socket.sendall(header + body)

    def read(self):
        """The next message: interface, index, type, subtype and body."""
        _, _, interface, index, kind, subtype, _, _, size = HEADER.unpack(self.receive(HEADER.size))
        return interface, index, kind, subtype, self.receive(size)

    def request(self, subtype, body=b""):
        """Asks the server itself, and waits for its consent."""
        self.send(PLAYER, 0, REQUEST, subtype, body)
        while True:
            interface, _, kind, answered, _ = self.read()
            if interface == PLAYER and kind in (ACK, NACK) and answered == subtype:
                if kind == NACK:
                    raise PermissionError(f"the Player server has refused request {subtype}")
                return

    def subscribe(self, interface, index):
        self.request(SUBSCRIBE, struct.pack(">7I", 0, 0, interface, index, OPEN, 0, 0))

    def next_frame(self):
        """Waits for the next frame; all data messages in it."""
        self.send(PLAYER, 0, REQUEST, NEXT_FRAME)
        messages = []
        while True:
            interface, index, kind, subtype, body = self.read()
            if kind == SYNCH:
                return messages
            if kind == DATA:
                messages.append((interface, index, subtype, body))

    def limit_commands(self, index, millis):
        """Lets speeds expire; a server of another make refuses that, and its answer is passed over by next_frame."""
        key = b"troupe_command_limit_ms\0"
        body = struct.pack(f">II{len(key)}si", len(key), len(key), key, millis)
        self.send(POSITION2D, index, REQUEST, SET_INTEGER_PROPERTY, body)

    def drive(self, index, forward_mps, turn_radps):
        self.send(POSITION2D, index, COMMAND, 1, struct.pack(">3dI", forward_mps, 0.0, turn_radps, 1))


def ranges(body):
    """The readings of a ring of sonars, in metres."""
    count, again = struct.unpack_from(">II", body)
    if count != again or len(body) < 8 + 4 * count:
        raise ValueError(f"a sonar message says {count} and {again} readings in {len(body)} bytes")
    return struct.unpack_from(f">{count}f", body, 8)


def steer(sonar):
    """Metres and radians per second: ahead while there is room, else away from what is nearer."""
    left, front, right = min(sonar[0:3]), min(sonar[3:5]), min(sonar[5:8])
    if front < NEAR_M or min(left, right) < NEAR_M / 2:
        return 0.0, TURN_RADPS if left > right else -TURN_RADPS
    balance = max(-1.0, min(1.0, (left - right) / 5))
    return min(FAST_MPS, front / 4), balance * math.radians(30)


def main(host, port, index):
    player = Player(host, port)
    player.subscribe(SONAR, index)
    player.subscribe(POSITION2D, index)
    player.limit_commands(index, COMMAND_LIMIT_MS)
    print(f"ready: robot {index + 1} of {host}:{port}", flush=True)
    try:
        while True:
            newest = None
            for interface, device, subtype, body in player.next_frame():
                if (interface, device, subtype) == (SONAR, index, 1):
                    newest = ranges(body)
            if newest is not None:
                player.drive(index, *steer(newest))
    except SystemExit:  # terminated: a Player server keeps the last command for ever
        player.drive(index, 0.0, 0.0)
        raise


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(f"{sys.argv[0]}: {len(sys.argv) - 1} arguments, expected HOST PORT INDEX")
    for ending in (signal.SIGTERM, signal.SIGINT):
        signal.signal(ending, lambda *_: sys.exit(0))
    try:
        main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
    except ConnectionError as gone:
        print(gone, file=sys.stderr)
    except (OSError, ValueError) as problem:
        sys.exit(f"{sys.argv[0]}: {problem}")
