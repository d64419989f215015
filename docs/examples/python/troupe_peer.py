"""A node of a Troupe bus in Python: it steers a robot by its sonar readings, handles requests, and sends some itself.

    python3 troupe_peer.py nats://127.0.0.1:4222

The format is that of docs/wire-format.md. Needs the packages nats-py and cbor2.
"""

import asyncio
import random
import re
import sys
import time

import cbor2
import nats

PUBLICATION, REQUEST, NOTICE, REPLY, REJECTION, CANCELLATION, MARK = range(7)
SAFE_M = 0.5


def token(name):
    """A name as one part of a subject."""
    escaped = re.sub(rb"[^A-Za-z0-9_-]", lambda found: b"%%%02x" % found[0][0], name.encode())
    return escaped.decode() or "%"


class NotDelivered(Exception):
    """No handler has got the request."""


class Failed(Exception):
    """The handler of the request has failed."""


class Node:
    """One process on the bus, with one port."""

    def __init__(self, name, port, application="troupe"):
        self.name, self.port, self.application = name, port, application
        self.incarnation = random.SystemRandom().randrange(1, 1 << 53)
        self.start = time.monotonic()
        self.number = 0
        self.series = {}  # topic: how many values were published
        self.handlers = {}  # operation: function of a value
        self.pending = {}  # number of a request: its future
        self.replies = f"{application}.x.{token(name)}.{self.incarnation}"

    async def open(self, server):
        self.connection = await nats.connect(server, no_echo=True, pending_size=0)  # keeps nothing for later
        await self.connection.subscribe(f"{self.application}.who.{token(self.name)}", cb=self._answer_who)
        await self.connection.subscribe(f"{self.replies}.*", cb=self._receive_reply)
        if await self._is_taken():
            await self.connection.close()
            raise SystemExit(f"another process has the name {self.name}")
        await self.connection.subscribe(f"{self.application}.n.{token(self.name)}", cb=self._receive)

    # ---- topics

    async def subscribe(self, topic, subscriber):
        async def receive(message):
            frame = cbor2.loads(message.data)
            if frame[1] == PUBLICATION:
                await subscriber(frame[9])

        await self.connection.subscribe(self._subject(topic), cb=receive)

    async def publish(self, topic, value):
        self.series[topic] = self.series.get(topic, 0) + 1
        frame = self._frame(PUBLICATION, self._next(), topic, self.series[topic], value)
        await self.connection.publish(self._subject(topic), frame)

    # ---- requests

    def answer(self, operation, handler):
        self.handlers[operation] = handler

    async def ask(self, node, port, operation, value, limit_s=1.0):
        """The reply; raises NotDelivered, Failed, or TimeoutError."""
        number = self._next()
        reply_to = f"{self.replies}.{number}-{token(node)}"
        frame = self._frame(REQUEST, number, port, operation, 0, int(limit_s * 1e6), value)
        self.pending[number] = asyncio.get_running_loop().create_future()
        try:
            await self.connection.publish(f"{self.application}.n.{token(node)}", frame, reply=reply_to)
            return await asyncio.wait_for(self.pending[number], limit_s)
        finally:
            del self.pending[number]

    async def _receive_reply(self, message):
        number = message.subject.rsplit(".", 1)[1]
        if number == "who":
            self.pending["who"].set_result(not self._is_missing(message))
            return
        future = self.pending.get(int(number.split("-")[0]))
        if future is None or future.done():
            return  # nothing waits for it any more
        if self._is_missing(message):
            future.set_exception(NotDelivered("no node of that name is connected now"))
            return
        frame = cbor2.loads(message.data)
        if frame[1] == REPLY:
            future.set_result(frame[12])
        else:
            kind, details = frame[12]
            future.set_exception(
                NotDelivered(details["why"]) if kind == "NotDelivered" else Failed(details["message"])
            )

    async def _receive(self, message):
        frame = cbor2.loads(message.data)
        kind, node, port, incarnation, number, operation = *frame[1:6], frame[8]
        handler = self.handlers.get(operation) if frame[7] == self.port else None
        if kind == NOTICE and handler:
            handler(frame[10])
        if kind != REQUEST:
            return
        asyncio.create_task(self._handle(handler, frame[11], node, (port, incarnation, number, operation, frame[9])))

    async def _handle(self, handler, value, node, to):
        try:
            if handler is None:
                kind, answer = REJECTION, ["NotDelivered", {"why": f"{self.name}/{self.port} does not answer that"}]
            else:
                kind, answer = REPLY, await handler(value)
        except Exception as error:
            kind, answer = REJECTION, ["Failed", {"type": type(error).__name__, "message": str(error)}]
        subject = f"{self.application}.x.{token(node)}.{to[1]}.{to[2]}"
        await self.connection.publish(subject, self._frame(kind, self._next(), *to, answer))

    # ---- the name of the node

    async def _is_taken(self):
        self.pending["who"] = asyncio.get_running_loop().create_future()
        who = f"{self.application}.who.{token(self.name)}"
        await self.connection.publish(who, self._who(established=False), reply=f"{self.replies}.who")
        try:
            return await asyncio.wait_for(self.pending["who"], 1.0)
        except asyncio.TimeoutError:
            return True
        finally:
            del self.pending["who"]

    async def _answer_who(self, message):
        await self.connection.publish(message.reply, self._who(established=True))

    def _who(self, established):
        return self.incarnation.to_bytes(8, "big") + bytes([established])

    # ---- frames

    def _next(self):
        self.number += 1
        return self.number

    def _frame(self, kind, number, *fields):
        micros = int((time.monotonic() - self.start) * 1e6)
        return cbor2.dumps([1, kind, self.name, self.port, self.incarnation, number, micros, *fields])

    def _subject(self, topic):
        return f"{self.application}.t." + ".".join(token(part) for part in topic.split("/"))

    @staticmethod
    def _is_missing(message):
        return bool(message.headers) and message.headers.get("Status") == "503"


async def main(server):
    node = Node("python", "driver")
    await node.open(server)

    async def steer(reading):
        is_free = min(reading["rangesM"]) > SAFE_M
        await node.publish("robot1/drive", {"forwardMps": 0.2 if is_free else 0.0, "turnRadps": 0.0 if is_free else 0.6})

    async def inspect(request):
        battery = await node.ask("robot", "battery", "charge", {"cell": request["cell"]})
        try:
            await node.ask("arm", "gripper", "charge", {"cell": 1})
            return {"text": "there is an arm"}
        except NotDelivered as why:
            return {"text": f"cell {request['cell']} has {battery['percent']} percent; arm: {why}"}

    node.answer("inspect", inspect)
    await node.subscribe("robot1/sonar", steer)
    await node.connection.flush()
    print("ready", flush=True)
    await asyncio.Event().wait()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit("usage: troupe_peer.py nats://HOST:4222")
    asyncio.run(main(sys.argv[1]))
