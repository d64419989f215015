"use strict";

/** Reads the messages of a stream: docs/live-view-format.md. */
const Messages = {
  ALIVE: 0, WORLD: 1, FRAME: 2, SENSORS: 3, EVENTS: 4, TIME: 5, HELLO: 6, END: 7, CALLS: 8, DEVICES: 9,
  MOST_BYTES: 1 << 26,
  TAKEN_OUT: -0x8000,
  UNKNOWN: 0, FIDUCIALS: 1, BUMPERS: 2, GRIPPER: 3, PICTURE: 4, // kinds of devices
  PADDLES: ["open", "closed", "opening", "closing"],

  /** Returns a function that takes bytes as they come, and calls `handle(type, value)` for each whole message. */
  reader(handle) {
    let rest = new Uint8Array(0);
    return bytes => {
      let all = bytes;
      if (rest.length > 0) {
        all = new Uint8Array(rest.length + bytes.length);
        all.set(rest);
        all.set(bytes, rest.length);
      }
      let at = 0;
      while (all.length - at >= 5) {
        const head = new DataView(all.buffer, all.byteOffset + at, 5);
        const length = head.getUint32(1, true);
        if (length > Messages.MOST_BYTES) {
          throw new Error(`a message of ${length} bytes, expected at most ${Messages.MOST_BYTES}`);
        }
        if (all.length - at - 5 < length) {
          break;
        }
        const content = new DataView(all.buffer, all.byteOffset + at + 5, length);
        const value = Messages.value(head.getUint8(0), content);
        if (value !== undefined) {
          handle(head.getUint8(0), value);
        }
        at += 5 + length;
      }
      rest = all.slice(at);
    };
  },

  /** The content of a message; undefined for a type that this page does not know. */
  value(type, content) {
    switch (type) {
      case Messages.ALIVE:
        return null;
      case Messages.FRAME:
        return Messages.frame(content);
      case Messages.SENSORS:
        return Messages.sensors(content);
      case Messages.DEVICES:
        return Messages.devices(content);
      case Messages.WORLD: case Messages.EVENTS: case Messages.TIME: case Messages.HELLO: case Messages.END:
      case Messages.CALLS:
        return JSON.parse(new TextDecoder().decode(content));
      default:
        return undefined;
    }
  },

  /** Positions in steps; `obstacles` are those that are not as in the world's description. */
  frame(content) {
    const count = content.getUint16(18, true);
    const frame = {
      time: content.getFloat64(0, true), number: content.getUint32(8, true), speed: content.getFloat32(12, true),
      past: (content.getUint16(16, true) & 1) !== 0, count, obstacles: new Map(),
      x: new Uint16Array(count), y: new Uint16Array(count), heading: new Float32Array(count), state: new Uint16Array(count),
    };
    for (let i = 0, at = 20; i < count; i++, at += 8) {
      frame.x[i] = content.getUint16(at, true);
      frame.y[i] = content.getUint16(at + 2, true);
      frame.heading[i] = content.getInt16(at + 4, true) / 1e4;
      frame.state[i] = content.getUint16(at + 6, true);
    }
    let at = 20 + 8 * count;
    const displaced = content.byteLength > at ? content.getUint16(at, true) : 0;
    for (at += 2; frame.obstacles.size < displaced; at += 8) {
      const heading = content.getInt16(at + 6, true);
      frame.obstacles.set(content.getUint16(at, true), heading === Messages.TAKEN_OUT ? null
        : {x: content.getUint16(at + 2, true), y: content.getUint16(at + 4, true), heading: heading / 1e4});
    }
    return frame;
  },

  sensors(content) {
    const readings = new Map();
    let at = 0;
    const u16 = () => { const value = content.getUint16(at, true); at += 2; return value; };
    const i16 = () => { const value = content.getInt16(at, true); at += 2; return value; };
    const metres = () => { const value = u16(); return value === 0xFFFF ? Infinity : value / 1000; };
    const list = (count, read) => Array.from({length: count}, read);
    const number = content.getUint32(0, true);
    at = 4;
    const robots = u16();
    for (let i = 0; i < robots; i++) {
      const robot = u16();
      const sonars = u16();
      const rays = u16();
      const blobs = u16();
      const reading = {gap: metres(), forward: i16() / 1000, turn: i16() / 1000};
      reading.sonar = list(sonars, metres);
      reading.rays = list(rays, metres);
      reading.blobs = list(blobs, () => {
        const colour = content.getUint32(at, true);
        at += 4;
        return {colour, left: u16(), right: u16(), height: u16(), range: metres()};
      });
      readings.set(robot, reading);
    }
    return {number, readings};
  },

  /** What further devices read: lists in the order of the world's description; null for a device that is not known. */
  devices(content) {
    const robots = new Map();
    let at = 6;
    const u16 = () => { const value = content.getUint16(at, true); at += 2; return value; };
    const f32 = () => { const value = content.getFloat32(at, true); at += 4; return value; };
    for (let i = content.getUint16(4, true); i > 0; i--) {
      const robot = u16();
      const [devices, intensities, held] = [u16(), u16(), u16()];
      const reading = {devices: [], intensities: [], held: []};
      for (let j = 0; j < devices; j++) {
        const kind = content.getUint8(at);
        const length = content.getUint32(at + 1, true);
        reading.devices.push(Messages.device(kind, new DataView(content.buffer, content.byteOffset + at + 5, length)));
        at += 5 + length;
      }
      for (let j = 0; j < intensities; j++) {
        reading.intensities.push(f32());
      }
      for (let j = 0; j < held; j++) {
        reading.held.push(u16());
      }
      robots.set(robot, reading);
    }
    return {number: content.getUint32(0, true), robots};
  },

  device(kind, content) {
    const list = (at, size, read) => Array.from({length: content.getUint16(at, true)}, (_, i) => read(at + 2 + i * size));
    switch (kind) {
      case Messages.FIDUCIALS:
        return {seen: list(0, 14, at => ({id: content.getInt32(at, true), x: content.getFloat32(at + 4, true),
          y: content.getFloat32(at + 8, true), heading: content.getInt16(at + 12, true) / 1e4}))};
      case Messages.BUMPERS:
        return {pressed: list(0, 1, at => content.getUint8(at) === 1)};
      case Messages.GRIPPER: {
        const bits = content.getUint8(1);
        return {paddles: Messages.PADDLES[content.getUint8(0)] ?? "unknown", outerBeam: (bits & 1) !== 0,
          innerBeam: (bits & 2) !== 0, holds: (bits & 4) !== 0};
      }
      case Messages.PICTURE:
        return {height: content.getUint16(0, true), columns: list(2, 8, at => ({colour: content.getUint32(at, true),
          top: content.getUint16(at + 4, true), bottom: content.getUint16(at + 6, true)}))};
      default:
        return null;
    }
  },
};
