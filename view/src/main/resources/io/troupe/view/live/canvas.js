"use strict";

/** Draws a model on a canvas; has the part of the world that is seen, its scale, and what is selected. */
class WorldCanvas {
  static MARGIN_M = 0.4;
  static MOST_NAMES = 80;
  static HANDLE_M = 0.6;
  static SMALL_PX = 6;
  static CROWD = 100;

  constructor(canvas, model) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.model = model;
    this.selected = new Set();
    this.follow = false;
    this.rays = true;
    this.trails = true;
    this.names = true;
    this.ghost = null; // a robot that is being dragged
    this.boxGhost = null;
    this.dropped = []; // robots and boxes that were dropped while time is paused: they are there after the next interval
    this.fitted = true;
    this.x = 0;
    this.y = 0;
    this.scale = 50;
    this.drawn = 0;
    this.drawMillis = 0;
  }

  /** Colours of the page, which depend on its theme. */
  readColours() {
    const style = getComputedStyle(document.documentElement);
    const read = name => style.getPropertyValue("--" + name).trim();
    this.colours = Object.fromEntries(
      ["floor", "grid", "wall", "text", "quiet", "alarm", "ray", "accent", "panel", "line", "marker", "free"].map(each => [each, read(each)]));
  }

  setWorld(world) {
    this.still = null;
    this.bounds = [Infinity, Infinity, -Infinity, -Infinity];
    const extend = (x, y) => {
      const b = this.bounds;
      this.bounds = [Math.min(b[0], x), Math.min(b[1], y), Math.max(b[2], x), Math.max(b[3], y)];
    };
    for (const obstacle of world.obstacles) {
      WorldCanvas.obstacle(new Path2D(), obstacle, obstacle.pose, extend);
    }
    this.radius = world.kinds.map(kind => Math.max(0.1, ...kind.outlines.flat().map(Math.abs)));
    if (!world.obstacles.length) {
      extend(-5, -5);
      extend(5, 5);
    }
    this.trailPaths = null;
    this.fitted = true;
    this.fit();
  }

  static trace(path, line, extend = () => {}) {
    for (let i = 0; i < line.length; i += 2) {
      extend(line[i], line[i + 1]);
      if (i === 0) {
        path.moveTo(line[i], line[i + 1]);
      } else {
        path.lineTo(line[i], line[i + 1]);
      }
    }
    path.closePath();
  }

  resize() {
    const box = this.canvas.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(box.width * ratio));
    const height = Math.max(1, Math.round(box.height * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      if (this.fitted) {
        this.fit();
      }
    }
    this.ratio = ratio;
  }

  fit() {
    if (!this.bounds) {
      return;
    }
    const [left, bottom, right, top] = this.bounds;
    const margin = WorldCanvas.MARGIN_M;
    const ratio = window.devicePixelRatio || 1;
    const tools = document.querySelector("#stage .tools").offsetHeight + 14; // above the world
    const legend = 40; // below
    this.x = (left + right) / 2;
    const height = this.canvas.height / ratio - tools - legend;
    this.scale = Math.min(this.canvas.width / ratio / (right - left + 2 * margin), height / (top - bottom + 2 * margin));
    this.y = (bottom + top) / 2 + (tools - legend) / 2 / this.scale;
    this.fitted = true;
  }

  zoom(factor, pageX = this.canvas.clientWidth / 2, pageY = this.canvas.clientHeight / 2) {
    const [x, y] = this.toWorld(pageX, pageY);
    this.scale = Math.min(2000, Math.max(0.5, this.scale * factor));
    const [newX, newY] = this.toWorld(pageX, pageY);
    this.x += x - newX;
    this.y += y - newY;
    this.fitted = false;
  }

  pan(pageX, pageY) {
    this.x -= pageX / this.scale;
    this.y += pageY / this.scale;
    this.fitted = false;
    this.follow = false;
  }

  toWorld(pageX, pageY) {
    return [this.x + (pageX - this.canvas.clientWidth / 2) / this.scale,
      this.y - (pageY - this.canvas.clientHeight / 2) / this.scale];
  }

  toPage(x, y) {
    return [this.canvas.clientWidth / 2 + (x - this.x) * this.scale, this.canvas.clientHeight / 2 - (y - this.y) * this.scale];
  }

  /** Index of the robot at a point of the page, or -1. */
  robotAt(pageX, pageY) {
    const frame = this.model.frame;
    const [x, y] = this.toWorld(pageX, pageY);
    let best = -1;
    let least = Infinity;
    for (let i = 0; frame && i < frame.count; i++) {
      if (frame.state[i] & Model.AWAY) {
        continue;
      }
      const distance = Math.hypot(frame.x[i] - x, frame.y[i] - y);
      const reach = Math.max(this.radius[this.model.world.robots[i].kind], 12 / this.scale);
      if (distance < reach && distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  }

  /** Index of the selected robot whose handle for turning is at a point of the page, or -1. */
  handleAt(pageX, pageY) {
    const frame = this.model.frame;
    for (const i of this.selected) {
      const [x, y] = this.handle(frame, i);
      const [handleX, handleY] = this.toPage(x, y);
      if (Math.hypot(handleX - pageX, handleY - pageY) < 12) {
        return i;
      }
    }
    return -1;
  }

  handle(frame, i) {
    const reach = Math.max(WorldCanvas.HANDLE_M, 30 / this.scale);
    return [frame.x[i] + Math.cos(frame.heading[i]) * reach, frame.y[i] + Math.sin(frame.heading[i]) * reach];
  }

  /** Draws a frame of the model. */
  draw(frame, trailEnd = Infinity) {
    const begin = performance.now();
    const to = this.context;
    this.dropped = this.dropped.filter(each => each.frame === this.model.frame?.number);
    this.resize();
    const centre = [...this.selected][0];
    if (this.follow && frame && centre !== undefined && centre < frame.count) {
      this.x = frame.x[centre];
      this.y = frame.y[centre];
    }
    to.setTransform(1, 0, 0, 1, 0, 0);
    to.fillStyle = this.colours.floor;
    to.fillRect(0, 0, this.canvas.width, this.canvas.height);
    const k = this.scale * this.ratio;
    to.setTransform(k, 0, 0, -k, this.canvas.width / 2 - this.x * k, this.canvas.height / 2 + this.y * k);
    this.pixel = 1 / this.scale;
    this.drawGrid();
    this.drawObstacles(frame?.obstacles ?? new Map());
    this.drawBoxes();
    if (!frame) {
      return;
    }
    if (this.trails) {
      this.drawTrails(trailEnd);
    }
    if (this.rays) {
      for (const robot of this.selected) {
        this.drawReadings(frame, robot);
      }
    }
    this.drawRobots(frame);
    for (const robot of this.selected) {
      this.drawDevices(frame, robot);
    }
    this.drawSelection(frame);
    to.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.drawNames(frame);
    this.drawMarkerNumbers(frame);
    this.drawScale();
    this.drawn++;
    this.drawMillis = performance.now() - begin;
  }

  drawGrid() {
    const to = this.context;
    const step = this.scale < 20 ? 10 : 1;
    const [left, top] = this.toWorld(0, 0);
    const [right, bottom] = this.toWorld(this.canvas.clientWidth, this.canvas.clientHeight);
    to.beginPath();
    for (let x = Math.ceil(left / step) * step; x < right; x += step) {
      to.moveTo(x, bottom);
      to.lineTo(x, top);
    }
    for (let y = Math.ceil(bottom / step) * step; y < top; y += step) {
      to.moveTo(left, y);
      to.lineTo(right, y);
    }
    to.strokeStyle = this.colours.grid;
    to.lineWidth = this.pixel;
    to.stroke();
  }

  /** Draws what stands where the world has it, and what is displaced: poses by index, null = not in the world. */
  drawObstacles(displaced) {
    const all = this.model.world?.obstacles ?? [];
    const key = [...displaced.keys()].join();
    if (!this.still || this.stillWithout !== key) {
      this.still = new Map(); // by colour
      this.stillWithout = key;
      all.forEach((obstacle, i) => {
        if (!displaced.has(i)) {
          const path = this.still.get(obstacle.colour) ?? new Path2D();
          this.still.set(obstacle.colour, path);
          WorldCanvas.obstacle(path, obstacle, obstacle.pose);
        }
      });
    }
    for (const [colour, path] of this.still) {
      this.drawObstacle(colour, path);
    }
    for (const [i, pose] of displaced) {
      if (pose && i < all.length) {
        const path = new Path2D();
        WorldCanvas.obstacle(path, all[i], [pose.x, pose.y, pose.heading]);
        this.drawObstacle(all[i].colour, path);
      }
    }
  }

  drawObstacle(colour, path) {
    const to = this.context;
    to.fillStyle = Model.colour(colour);
    to.fill(path); // nonzero: overlaps are filled, and holes are open because their lines run the other way round
    to.strokeStyle = this.colours.wall;
    to.lineWidth = this.pixel;
    to.stroke(path);
  }

  static obstacle(path, obstacle, [x, y, heading], extend) {
    WorldCanvas.body(path, WorldCanvas.placer({x: [x], y: [y], heading: [heading]}, 0), obstacle, extend);
  }

  drawBoxes() {
    const to = this.context;
    to.lineWidth = this.pixel;
    for (const box of this.model.boxes) {
      to.fillStyle = Model.colour(box.colour);
      to.strokeStyle = this.colours.text;
      to.beginPath();
      to.rect(box.x - box.side / 2, box.y - box.side / 2, box.side, box.side);
      to.fill();
      to.stroke();
    }
    for (const {x, y, side} of [this.boxGhost, ...this.dropped].filter(each => each?.side)) {
      to.strokeStyle = this.colours.accent;
      to.lineWidth = 2 * this.pixel;
      to.strokeRect(x - side / 2, y - side / 2, side, side);
    }
  }

  /** Shows where a robot or box was dropped until the next frame has it there. */
  drop(what) {
    const same = each => each.side ? each.number === what.number : each.robot === what.robot;
    this.dropped = this.dropped.filter(each => Boolean(each.side) !== Boolean(what.side) || !same(each));
    this.dropped.push({...what, frame: this.model.frame.number});
  }

  /** The box at a point of the page, or undefined. */
  boxAt(pageX, pageY) {
    const [x, y] = this.toWorld(pageX, pageY);
    return this.model.boxes.findLast(box => Math.max(Math.abs(box.x - x), Math.abs(box.y - y)) <= box.side / 2);
  }

  drawTrails(end) {
    const to = this.context;
    const now = performance.now();
    if (this.model.trails.length < WorldCanvas.CROWD || !this.trailPaths || now - this.trailsMade > 300) {
      this.trailPaths = this.trailsUntil(end);
      this.trailsMade = now;
    }
    to.lineWidth = (this.scale < 20 ? 1 : 1.6) * this.pixel;
    for (const [key, path] of this.trailPaths) {
      to.strokeStyle = this.trailColour(key);
      to.globalAlpha = 0.7;
      to.stroke(path);
    }
    to.globalAlpha = 1;
  }

  /**
   * What gives a robot its colour: its service, or, in a world without services, its own colour as a negative number.
   */
  colourKey(robot, state) {
    return this.model.world.services.length ? state & 0xFF : -1 - this.model.world.robots[robot].colour;
  }

  colourOf(key) {
    return key < 0 ? Model.colour(-1 - key) : this.model.serviceColour(key);
  }

  /** A black robot on a dark floor has an outline, but its trail would not be seen. */
  trailColour(key) {
    const light = [16, 8, 0].reduce((sum, shift) => sum + (-1 - key >> shift & 255), 0) / 3;
    const dark = document.documentElement.dataset.theme === "dark";
    return key < 0 && (dark ? light < 50 : light > 205) ? "#888888" : this.colourOf(key);
  }

  /** A path for each colour, by its key. */
  trailsUntil(end) {
    const paths = new Map();
    for (const [robot, trail] of this.model.trails.entries()) {
      let last = null;
      let joined = null; // the path whose end is the last point
      for (const point of trail) {
        if (point && point.t > end) {
          break;
        }
        if (last && point) {
          const key = this.colourKey(robot, point.service);
          let path = paths.get(key);
          if (!path) {
            paths.set(key, path = new Path2D());
          }
          if (path !== joined) {
            path.moveTo(last.x, last.y);
          }
          path.lineTo(point.x, point.y);
          joined = path;
        } else {
          joined = null;
        }
        last = point;
      }
    }
    return paths;
  }

  /** The ends of the rays of a robot's sonars, in the world; for tests, too. */
  sonarEnds(frame, robot) {
    const reading = this.model.readings.get(robot);
    const sonar = this.model.world.kinds[this.model.world.robots[robot].kind].sonar;
    if (!reading || !sonar) {
      return [];
    }
    const place = WorldCanvas.placer(frame, robot);
    return reading.sonar.map((range, i) => {
      const [x, y, heading] = sonar.mounts[i];
      const from = place(x, y);
      const to = place(x + Math.cos(heading) * range, y + Math.sin(heading) * range);
      return {from, to, hit: range < sonar.most};
    });
  }

  static placer(frame, robot) {
    const cos = Math.cos(frame.heading[robot]);
    const sin = Math.sin(frame.heading[robot]);
    return (x, y) => [frame.x[robot] + cos * x - sin * y, frame.y[robot] + sin * x + cos * y];
  }

  drawReadings(frame, robot) {
    const reading = this.model.readings.get(robot);
    if (!reading || robot >= frame.count || frame.state[robot] & Model.AWAY) {
      return;
    }
    const to = this.context;
    const kind = this.model.world.kinds[this.model.world.robots[robot].kind];
    this.drawCamera(frame, robot, kind.camera, reading);
    this.drawFans(frame, robot, kind.sensors, reading);
    const rays = new Path2D();
    const hits = new Path2D();
    for (const ray of this.sonarEnds(frame, robot)) {
      rays.moveTo(...ray.from);
      rays.lineTo(...ray.to);
      if (ray.hit) {
        hits.moveTo(ray.to[0] + 3 * this.pixel, ray.to[1]);
        hits.arc(...ray.to, 3 * this.pixel, 0, 7);
      }
    }
    to.strokeStyle = this.colours.ray;
    to.fillStyle = this.colours.ray;
    to.lineWidth = this.pixel;
    to.globalAlpha = 0.5;
    to.stroke(rays);
    to.globalAlpha = 1;
    to.fill(hits);
    this.drawMarkers(frame, robot);
  }

  /** The markers that the finders of a robot see, in the world; for tests, too. */
  markers(frame, robot) {
    if (robot >= frame.count || frame.state[robot] & Model.AWAY) {
      return [];
    }
    const place = WorldCanvas.placer(frame, robot);
    return this.model.devicesOf(robot, "fiducial").flatMap(({spec, reading}) => {
      const [x, y, heading] = spec.mount;
      const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
      return reading.seen.map(each => ({id: each.id, from: place(x, y),
        to: place(x + cos * each.x - sin * each.y, y + sin * each.x + cos * each.y)}));
    });
  }

  drawMarkers(frame, robot) {
    const to = this.context;
    to.strokeStyle = this.colours.marker;
    to.lineWidth = 1.5 * this.pixel;
    to.beginPath();
    for (const each of this.markers(frame, robot)) {
      to.moveTo(...each.from);
      to.lineTo(...each.to);
    }
    to.stroke();
  }

  /** The numbers of markers, or a question mark if one is too far away for it. */
  drawMarkerNumbers(frame) {
    if (!this.rays) {
      return;
    }
    const to = this.context;
    to.font = "bold 12px system-ui, 'DejaVu Sans', sans-serif";
    to.textAlign = "center";
    to.lineWidth = 4;
    to.strokeStyle = this.colours.floor;
    to.fillStyle = this.colours.marker;
    for (const robot of this.selected) {
      for (const each of this.markers(frame, robot)) {
        const [x, y] = this.toPage(...each.to);
        const number = each.id === 0 ? "?" : String(each.id);
        to.strokeText(number, x, y - 10);
        to.fillText(number, x, y - 10);
      }
    }
  }

  /** Bumpers and grippers of a robot, on its body. */
  drawDevices(frame, robot) {
    if (robot >= frame.count || frame.state[robot] & Model.AWAY) {
      return;
    }
    const to = this.context;
    const place = WorldCanvas.placer(frame, robot);
    for (const {spec, reading} of this.model.devicesOf(robot, "gripper")) {
      this.drawGripper(place, spec, reading, this.model.devices.get(robot).held, frame);
    }
    to.lineCap = "round";
    for (const {spec, reading} of this.model.devicesOf(robot, "bumper")) {
      spec.parts.forEach(({mount: [x, y, heading], length}, i) => {
        const [dx, dy] = [-Math.sin(heading) * length / 2, Math.cos(heading) * length / 2];
        to.beginPath();
        to.moveTo(...place(x - dx, y - dy));
        to.lineTo(...place(x + dx, y + dy));
        to.strokeStyle = reading.pressed[i] ? this.colours.alarm : this.colours.free;
        to.lineWidth = (reading.pressed[i] ? 6 : 3) * this.pixel;
        to.stroke();
      });
    }
    to.lineCap = "butt";
  }

  /** Paddles that move are drawn half closed and dashed; those that hold a thing are at its sides. */
  drawGripper(place, {mount: [x, y, heading], length, width, paddleLength, paddleWidth}, reading, held, frame) {
    const to = this.context;
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    const rectangle = (path, left, bottom, right, top) => WorldCanvas.trace(path,
      [[left, bottom], [right, bottom], [right, top], [left, top]]
        .flatMap(([ahead, aside]) => place(x + cos * ahead - sin * aside, y + sin * ahead + cos * aside)));
    const thick = paddleWidth * width;
    const inner = width / 2 - thick;
    const base = length / 2 - paddleLength * length;
    const moves = reading.paddles === "opening" || reading.paddles === "closing";
    const side = reading.holds && held.length ? Math.min(inner, this.obstacleWidth(held[0]) / 2)
      : reading.paddles === "open" ? inner : moves ? inner / 2 : 0;
    const path = new Path2D();
    rectangle(path, -length / 2, -width / 2, base, width / 2);
    rectangle(path, base, side, length / 2, side + thick);
    rectangle(path, base, -side - thick, length / 2, -side);
    to.fillStyle = this.colours.quiet;
    to.fill(path);
    to.strokeStyle = this.colours.text;
    to.lineWidth = this.pixel;
    to.setLineDash(moves ? [3 * this.pixel, 3 * this.pixel] : []);
    to.stroke(path);
    to.setLineDash([]);
    for (const index of held) {
      const obstacle = this.model.world.obstacles[index];
      const pose = frame.obstacles.get(index);
      if (obstacle && pose !== null) {
        const outline = new Path2D();
        WorldCanvas.obstacle(outline, obstacle, pose ? [pose.x, pose.y, pose.heading] : obstacle.pose);
        to.fillStyle = Model.colour(obstacle.colour);
        to.fill(outline);
        to.strokeStyle = this.colours.accent;
        to.lineWidth = 2.5 * this.pixel;
        to.stroke(outline);
      }
    }
  }

  /** Extent of an obstacle along its y axis. */
  obstacleWidth(index) {
    const y = (this.model.world.obstacles[index]?.outlines ?? []).flatMap(line => line.filter((_, i) => i % 2 === 1));
    return y.length ? Math.max(...y) - Math.min(...y) : 0;
  }

  drawFans(frame, robot, sensors, reading) {
    const to = this.context;
    const place = WorldCanvas.placer(frame, robot);
    const intensities = this.model.devices.get(robot)?.intensities ?? [];
    const echoes = new Path2D(); // of things that are not dark
    let next = 0;
    for (const sensor of sensors) {
      const [x, y, heading] = sensor.mount;
      const fan = new Path2D();
      fan.moveTo(...place(x, y));
      for (let i = 0; i < sensor.samples; i++) {
        const angle = heading + (sensor.samples < 2 ? 0 : sensor.fov * (i / (sensor.samples - 1) - 0.5));
        const echo = intensities[next] > 0;
        const range = Math.min(reading.rays[next++] ?? 0, sensor.most);
        const end = place(x + Math.cos(angle) * range, y + Math.sin(angle) * range);
        fan.lineTo(...end);
        if (echo) {
          echoes.moveTo(end[0] + 3 * this.pixel, end[1]);
          echoes.arc(...end, 3 * this.pixel, 0, 7);
        }
      }
      fan.closePath();
      to.fillStyle = this.colours.ray;
      to.strokeStyle = this.colours.ray;
      to.lineWidth = this.pixel;
      to.globalAlpha = 0.12;
      to.fill(fan);
      to.globalAlpha = 0.5;
      to.stroke(fan);
      to.globalAlpha = 1;
    }
    to.fillStyle = this.colours.ray;
    to.fill(echoes);
  }

  drawCamera(frame, robot, camera, reading) {
    if (!camera) {
      return;
    }
    const to = this.context;
    const place = WorldCanvas.placer(frame, robot);
    const [x, y, heading] = camera.mount;
    const sector = (from, until, range) => {
      const path = new Path2D();
      path.moveTo(...place(x, y));
      for (let i = 0; i <= 12; i++) {
        const angle = heading + camera.fov * (0.5 - (from + (until - from) * i / 12) / camera.width);
        path.lineTo(...place(x + Math.cos(angle) * range, y + Math.sin(angle) * range));
      }
      path.closePath();
      return path;
    };
    to.fillStyle = this.colours.quiet;
    to.globalAlpha = 0.1;
    to.fill(sector(0, camera.width, camera.range));
    to.globalAlpha = 0.45;
    for (const blob of reading.blobs) {
      to.fillStyle = Model.colour(blob.colour);
      to.fill(sector(blob.left, blob.right + 1, Math.min(blob.range, camera.range)));
    }
    to.globalAlpha = 1;
  }

  drawRobots(frame) {
    const to = this.context;
    const world = this.model.world;
    const bodies = new Map();
    const noses = new Path2D();
    const alarms = new Path2D();
    const hands = new Path2D();
    let small = true; // too small for outlines
    for (let i = 0; i < frame.count; i++) {
      if (frame.state[i] & Model.AWAY) {
        continue;
      }
      const kindNumber = world.robots[i].kind;
      const radius = this.radius[kindNumber];
      const key = this.colourKey(i, frame.state[i]);
      let path = bodies.get(key);
      if (!path) {
        bodies.set(key, path = new Path2D());
      }
      if (radius * this.scale < WorldCanvas.SMALL_PX) {
        this.arrow(path, frame, i, Math.max(radius, 3 * this.pixel));
      } else {
        small = false;
        const place = WorldCanvas.placer(frame, i);
        WorldCanvas.body(path, place, world.kinds[kindNumber]);
        noses.moveTo(...place(0, 0));
        noses.lineTo(...place(radius, 0));
      }
      const alarm = frame.state[i] & (Model.STALLED | Model.TOUCHED);
      const ring = alarm ? alarms : frame.state[i] & Model.BY_HAND ? hands : null;
      if (ring) {
        ring.moveTo(frame.x[i] + radius * 1.35, frame.y[i]);
        ring.arc(frame.x[i], frame.y[i], radius * 1.35, 0, 7);
      }
    }
    to.lineWidth = this.pixel;
    for (const [key, path] of bodies) {
      to.fillStyle = this.colourOf(key);
      to.fill(path);
      if (!small) {
        to.strokeStyle = this.colours.text;
        to.stroke(path);
      }
    }
    this.drawCargo(frame);
    to.lineWidth = 2 * this.pixel;
    to.strokeStyle = "#ffffff";
    to.stroke(noses);
    to.lineWidth = (small ? 1.5 : 3) * this.pixel;
    to.strokeStyle = this.colours.alarm;
    to.stroke(alarms);
    to.strokeStyle = this.colours.accent;
    to.setLineDash([6 * this.pixel, 4 * this.pixel]);
    to.stroke(hands);
    to.setLineDash([]);
  }

  /** A robot that is too small for its outline. */
  arrow(path, frame, i, size) {
    const forward = Math.cos(frame.heading[i]) * size;
    const left = Math.sin(frame.heading[i]) * size;
    const x = frame.x[i];
    const y = frame.y[i];
    path.moveTo(x + forward, y + left);
    path.lineTo(x - forward - 0.8 * left, y - left + 0.8 * forward);
    path.lineTo(x - forward + 0.8 * left, y - left - 0.8 * forward);
    path.closePath();
  }

  static body(path, place, kind, extend) {
    for (const line of kind.outlines) {
      const placed = [];
      for (let i = 0; i < line.length; i += 2) {
        placed.push(...place(line[i], line[i + 1]));
      }
      WorldCanvas.trace(path, placed, extend);
    }
  }

  drawCargo(frame) {
    const world = this.model.world;
    for (let i = 0; i < frame.count; i++) {
      const kind = world.kinds[world.robots[i].kind];
      if (!(frame.state[i] & Model.AWAY) && kind.cargo.length && this.radius[world.robots[i].kind] * this.scale >= WorldCanvas.SMALL_PX) {
        const place = WorldCanvas.placer(frame, i);
        for (const piece of kind.cargo) {
          const path = new Path2D();
          WorldCanvas.body(path, place, piece);
          this.context.fillStyle = Model.colour(piece.colour);
          this.context.fill(path);
        }
      }
    }
  }

  drawSelection(frame) {
    const to = this.context;
    to.strokeStyle = this.colours.accent;
    to.lineWidth = 2 * this.pixel;
    for (const i of this.selected) {
      if (i >= frame.count || frame.state[i] & Model.AWAY) {
        continue;
      }
      const radius = Math.max(this.radius[this.model.world.robots[i].kind] * 1.2, 9 * this.pixel);
      to.beginPath();
      to.arc(frame.x[i], frame.y[i], radius, 0, 7);
      to.stroke();
      if (this.model.world.controls.includes("place")) {
        const [x, y] = this.handle(frame, i);
        to.beginPath();
        to.arc(x, y, 6 * this.pixel, 0, 7);
        to.fillStyle = this.colours.panel;
        to.fill();
        to.stroke();
      }
    }
    for (const ghost of [this.ghost, ...this.dropped].filter(each => each && !each.side)) {
      to.globalAlpha = 0.5;
      const shown = {x: [ghost.x], y: [ghost.y], heading: [ghost.heading]};
      const kindNumber = this.model.world.robots[ghost.robot].kind;
      const path = new Path2D();
      const place = WorldCanvas.placer(shown, 0);
      WorldCanvas.body(path, place, this.model.world.kinds[kindNumber]);
      path.moveTo(...place(0, 0));
      path.lineTo(...place(this.radius[kindNumber], 0));
      to.stroke(path);
      to.globalAlpha = 1;
    }
  }

  drawNames(frame) {
    const to = this.context;
    to.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    to.textAlign = "center";
    to.lineWidth = 3;
    to.strokeStyle = this.colours.floor;
    to.fillStyle = this.colours.text;
    const all = this.names && frame.count <= WorldCanvas.MOST_NAMES;
    for (let i = 0; i < frame.count; i++) {
      if (!all && !this.selected.has(i) || frame.state[i] & Model.AWAY) {
        continue;
      }
      const [x, y] = this.toPage(frame.x[i], frame.y[i]);
      const below = y + this.radius[this.model.world.robots[i].kind] * this.scale + 16;
      const stuck = frame.state[i] & Model.STALLED ? " (stuck)" : "";
      to.strokeText(this.model.world.robots[i].name + stuck, x, below);
      to.fillText(this.model.world.robots[i].name + stuck, x, below);
    }
  }

  drawScale() {
    const to = this.context;
    const wanted = 80 / this.scale;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const metres = [5, 2, 1].map(each => each * power).find(each => each <= wanted) ?? power;
    const length = metres * this.scale;
    const right = this.canvas.clientWidth - 14;
    const y = this.canvas.clientHeight - 14;
    to.strokeStyle = this.colours.text;
    to.lineWidth = 2;
    to.beginPath();
    to.moveTo(right - length, y - 4);
    to.lineTo(right - length, y);
    to.lineTo(right, y);
    to.lineTo(right, y - 4);
    to.stroke();
    to.textAlign = "right";
    to.fillStyle = this.colours.text;
    to.lineWidth = 3;
    to.strokeStyle = this.colours.floor;
    const label = `${Number(metres.toPrecision(1))} m`;
    to.strokeText(label, right, y - 8);
    to.fillText(label, right, y - 8);
  }
}
