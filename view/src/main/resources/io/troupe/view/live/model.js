"use strict";

/** What is known of a world: its description, the newest frame, readings, events and trails. */
class Model {
  static STALLED = 0x100;
  static TOUCHED = 0x200;
  static BY_HAND = 0x400;
  static AWAY = 0x800;
  static JUMPS_SHIFT = 12;
  static TRAIL_STEP_M = 0.03;
  static CROWD_TRAIL_STEP_M = 0.15;
  /** An obstacle that is so much farther away in the next frame was not pushed there. */
  static JUMP_M = 0.6;
  static BOX_M = 0.4;
  /**
   * A viewer who drags or drives sends commands all the time; what comes so soon after the one before belongs to it.
   */
  static SAME_ACT_S = 1;
  static BOX_COLOURS = {red: "ff0000", green: "00ff00", blue: "0000ff", yellow: "ffff00", orange: "ffa500", black: "000000"};
  /** A trail has a gap where frames are farther apart: the way of the robot is not known. */
  static TRAIL_GAP_S = 2.5;

  /** As many as the server keeps; a page beside a world that runs for days forgets the older ones. */
  static MOST_EVENTS = 20_000;

  constructor() {
    this.mostEvents = Model.MOST_EVENTS;
    this.clear();
  }

  clear() {
    this.world = null;
    this.frame = null;
    this.before = null;
    this.readings = new Map();
    this.devices = new Map(); // what further devices read, by robot
    this.nextDevices = null; // they come before the readings of their frame
    this.events = [];
    this.forgotten = 0; // number of older events
    this.hands = []; // events that say who drives a robot
    this.trails = [];
    this.trailTime = 0; // of the newest frame
    this.drivers = new Map();
    this.state = null;
    this.boxes = [];
    this.frames = 0;
  }

  setWorld(world) {
    this.clear();
    this.world = world;
    this.trails = world.robots.map(() => []);
  }

  /** Positions in metres. */
  place(frame) {
    const world = this.world;
    const x = new Float32Array(frame.count);
    const y = new Float32Array(frame.count);
    for (let i = 0; i < frame.count; i++) {
      x[i] = world.left + frame.x[i] * world.step;
      y[i] = world.bottom + frame.y[i] * world.step;
    }
    frame.x = x;
    frame.y = y;
    for (const pose of frame.obstacles.values()) {
      if (pose) {
        pose.x = world.left + pose.x * world.step;
        pose.y = world.bottom + pose.y * world.step;
      }
    }
    return frame;
  }

  setFrame(frame, arrived) {
    this.place(frame);
    frame.arrived = arrived;
    this.lengthenTrails(frame);
    if (frame.past) {
      return;
    }
    this.before = this.frame && this.frame.time <= frame.time ? this.frame : null;
    this.frame = frame;
    this.frames++;
  }

  setReadings({number, readings}) {
    this.readings = readings;
    this.devices = this.nextDevices?.number === number ? this.nextDevices.robots : new Map();
  }

  kind(robot) {
    return this.world.kinds[this.world.robots[robot].kind];
  }

  /** The further devices of a robot of an interface that have been read: their descriptions and readings. */
  devicesOf(robot, name) {
    const readings = this.devices.get(robot)?.devices ?? [];
    return (this.kind(robot).devices ?? []).map((spec, i) => ({spec, reading: readings[i]}))
      .filter(each => each.spec.interface === name && each.reading);
  }

  lengthenTrails(frame) {
    const crowd = frame.count > 100;
    const most = crowd ? 15 : 4000;
    const step = crowd ? Model.CROWD_TRAIL_STEP_M : Model.TRAIL_STEP_M;
    const unknown = frame.time - this.trailTime > Model.TRAIL_GAP_S;
    this.trailTime = frame.time;
    for (let i = 0; i < frame.count; i++) {
      const trail = this.trails[i];
      const last = trail[trail.length - 1];
      const jumps = frame.state[i] >> Model.JUMPS_SHIFT;
      const service = frame.state[i] & 0xFF;
      if (frame.state[i] & Model.AWAY) {
        if (last) {
          trail.push(null); // where it returns, another line begins
        }
        continue;
      }
      if (last && last.t > frame.time) {
        trail.length = 0; // time began again
      } else if (last && (unknown || last.jumps !== jumps)) {
        trail.push(null);
      } else if (last && last.service === service && Math.hypot(frame.x[i] - last.x, frame.y[i] - last.y) < step) {
        continue;
      }
      trail.push({x: frame.x[i], y: frame.y[i], t: frame.time, service, jumps});
      if (trail.length > most) {
        trail.splice(0, trail.length - most);
      }
    }
  }

  addEvents(events) {
    for (const event of events) {
      const act = event.kind === "intervention" ? this.sameAct(event) : undefined;
      if (act) {
        act.text = event.text;
        act.until = event.t;
        continue;
      }
      this.events.push(event);
      if (this.events.length > this.mostEvents) {
        const old = this.events.length >> 3;
        this.events.splice(0, old);
        this.forgotten += old;
      }
      if (event.kind === "state") {
        this.state = event;
      } else if (event.kind === "boxes") {
        event.boxes = event.boxes.map(Model.box);
        this.boxes = event.boxes;
      } else if (event.kind === "driver") {
        this.drivers.set(event.robot - 1, event.node);
        if (this.mostEvents === Infinity) {
          this.hands.push(event);
        }
      }
    }
  }

  /** The newest intervention, if it does the same with the same robot or box. */
  sameAct(event) {
    const act = words => words.split(" ", 2).join(" "); // what is done, and the number of the robot or box
    const before = this.events.findLast(each => each.kind === "intervention");
    return before && act(before.text) === act(event.text)
      && event.t - (before.until ?? before.t) <= Model.SAME_ACT_S ? before : undefined;
  }

  /** Where the robots are drawn: between the last two frames, so that they move smoothly. */
  shown(now) {
    const frame = this.frame;
    const before = this.before;
    if (!frame || !before || before.count !== frame.count) {
      return frame;
    }
    const gap = Math.min(frame.arrived - before.arrived, 400);
    const share = gap < 25 ? 1 : (now - frame.arrived) / gap;
    return share >= 1 ? frame : this.between(before, frame, Math.max(0, share));
  }

  between(one, other, share) {
    const frame = {...other, x: new Float32Array(one.count), y: new Float32Array(one.count),
      heading: new Float32Array(one.count), time: one.time + (other.time - one.time) * share, moving: true};
    for (let i = 0; i < one.count; i++) {
      const dx = other.x[i] - one.x[i];
      const dy = other.y[i] - one.y[i];
      const part = one.state[i] >> Model.JUMPS_SHIFT !== other.state[i] >> Model.JUMPS_SHIFT ? 1 : share;
      let turn = other.heading[i] - one.heading[i];
      turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
      frame.x[i] = one.x[i] + dx * part;
      frame.y[i] = one.y[i] + dy * part;
      frame.heading[i] = one.heading[i] + turn * part;
    }
    frame.obstacles = new Map([...other.obstacles].map(([i, pose]) => [i, this.obstacleBetween(i, one, pose, share)]));
    return frame;
  }

  obstacleBetween(index, one, pose, share) {
    const [x, y, heading] = this.world.obstacles[index]?.pose ?? [0, 0, 0];
    const from = one.obstacles.has(index) ? one.obstacles.get(index) : {x, y, heading};
    if (!from || !pose || Math.hypot(pose.x - from.x, pose.y - from.y) > Model.JUMP_M) {
      return pose;
    }
    let turn = pose.heading - from.heading;
    turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    return {x: from.x + (pose.x - from.x) * share, y: from.y + (pose.y - from.y) * share, heading: from.heading + turn * share};
  }

  serviceName(state) {
    const number = state & 0xFF;
    if (this.world.services.length === 0) {
      return "";
    }
    const service = this.world.services[number - 1];
    return number === 0 ? "no service" : service ? service.name : "several services";
  }

  serviceColour(state) {
    const service = this.world.services[(state & 0xFF) - 1];
    return service ? service.colour : "#888888";
  }

  /** Events for lists: in a crowd robots touch each other all the time. */
  isListed(event) {
    return event.kind !== "boxes" && (this.world.robots.length <= 20 || event.kind !== "contact" && event.kind !== "stall");
  }

  /** The boxes at a time, for a recorded run. */
  boxesAt(time) {
    return this.events.findLast(each => each.kind === "boxes" && each.t <= time + 1e-9)?.boxes ?? [];
  }

  /** Who drives which robot at a time, for a recorded run. */
  driversAt(time) {
    const drivers = new Map();
    for (const event of this.hands) {
      if (event.t <= time + 1e-9) {
        drivers.set(event.robot - 1, event.node);
      }
    }
    return drivers;
  }

  /** Changes of state, and what else happened to be shown, as text. */
  describe(event) {
    const robot = event.robot ? this.robotName(event.robot) : "";
    switch (event.kind) {
      case "state":
        return `state ${event.state}: ${robot ? `${robot} sees ${event.colourName ?? "a colour"}` : event.text ?? "start"}`;
      case "contact":
        return `${robot} touches ${event.otherRobot ? this.robotName(event.otherRobot) : event.obstacle}`;
      case "stall":
        return `${robot} is stuck`;
      case "driver":
        return event.node ? `${robot} is driven by ${event.node}` : `${robot} has no driver`;
      case "intervention":
        return this.describeIntervention(event.text.split(" "));
      case "refused":
        return `not possible: ${event.text}`;
      default:
        return event.text ?? event.kind;
    }
  }

  robotName(number) {
    return this.world.robots[number - 1]?.name ?? `robot ${number}`;
  }

  /** What a viewer did, of the words of the command. */
  describeIntervention([what, number, ...rest]) {
    const place = (x, y) => `to ${Number(x).toFixed(2)} m, ${Number(y).toFixed(2)} m`;
    switch (what) {
      case "place":
        return `by hand: ${this.robotName(number)} put ${place(...rest)}`;
      case "drive":
        return `by hand: ${this.robotName(number)} driven`;
      case "release":
        return `by hand: ${this.robotName(number)} released`;
      case "box":
        return `by hand: ${Model.colourName(rest[0])} box ${number} put ${place(...rest.slice(1))}`;
      case "unbox":
        return `by hand: box ${number} removed`;
      case "reset":
        return "by hand: the world is as at its start";
      default:
        return `by hand: ${[what, number, ...rest].join(" ")}`;
    }
  }

  /** A box of its words: number, colour, x and y of its centre. */
  static box(words) {
    const [number, colour, x, y] = words.split(" ");
    return {number: Number(number), colour: parseInt(colour, 16), x: Number(x), y: Number(y), side: Model.BOX_M};
  }

  static colourName(digits) {
    return Object.keys(Model.BOX_COLOURS).find(name => Model.BOX_COLOURS[name] === digits) ?? `#${digits}`;
  }

  static colour(number) {
    return "#" + (number & 0xFFFFFF).toString(16).padStart(6, "0");
  }
}
