"use strict";

const element = id => document.getElementById(id);

/** The page: what the stream or the file in it says, on the canvas and in lists, and the controls. */
class Page {
  static SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 50];
  static MOST_LISTED = 200;
  static MOST_LISTED_EVENTS = 300;
  static DRIVE_MPS = 0.4;
  static DRIVE_RADPS = 0.8;
  static SEND_MILLIS = 50;

  constructor() {
    this.model = new Model();
    this.view = new WorldCanvas(element("world"), this.model);
    this.timeline = new Timeline(element("timeline"), this.model);
    this.actors = new ActorGraph(
      element("calls"), element("actor-figures").tBodies[0], element("call-figures").tBodies[0]);
    this.source = null;
    this.paused = false;
    this.waitsFor = "";
    this.listed = 0;
    this.keys = new Set();
    this.chooseTheme(window.matchMedia("(prefers-color-scheme: dark)").matches);
    this.addControls();
    requestAnimationFrame(now => this.animate(now));
  }

  // ---- what comes in

  handle(type, value) {
    switch (type) {
      case Messages.WORLD:
        this.begin(value);
        break;
      case Messages.FRAME:
        this.model.setFrame(value, performance.now());
        break;
      case Messages.SENSORS:
        this.model.setReadings(value);
        break;
      case Messages.DEVICES:
        this.model.nextDevices = value;
        break;
      case Messages.EVENTS:
        this.model.addEvents(value);
        value.filter(each => each.kind === "refused").forEach(each => this.complain(this.model.describe(each)));
        break;
      case Messages.CALLS:
        this.actors.update(value);
        element("actors-shown").hidden = this.actors.isEmpty();
        this.showActors(!element("actors").hidden);
        break;
      case Messages.TIME:
        this.paused = value.paused;
        this.waitsFor = value.waitsFor;
        this.showTime(value.speed);
        break;
    }
  }

  begin(world) {
    const selected = this.model.world && this.model.world.name === world.name ? [...this.view.selected] : [];
    this.model.setWorld(world);
    this.view.setWorld(world);
    element("name").textContent = world.name;
    document.title = `${world.name} - Troupe`;
    element("events").replaceChildren();
    this.listed = 0;
    document.body.classList.toggle("many", world.robots.length > 20);
    for (const [control, word] of [["play", "pause"], ["step", "step"], ["reset", "reset"], ["speeds", "speed"]]) {
      element(control).hidden = !world.controls.includes(word);
    }
    element("watched").hidden = world.controls.length > 0;
    for (const what of ["box", "box-colour"]) {
      element(what).hidden = !world.controls.includes("box");
    }
    element("legend").replaceChildren(...world.services.map(each => Page.labelled(each.colour, each.name)));
    this.view.selected = new Set(selected.length ? selected : world.robots.length <= 2 ? world.robots.keys() : []);
    this.listRobots();
    this.selectionChanged();
  }

  static labelled(colour, text) {
    const label = document.createElement("span");
    const chip = document.createElement("span");
    chip.className = "chip";
    chip.style.background = colour;
    label.append(chip, text);
    return label;
  }

  // ---- what is shown

  animate(now) {
    requestAnimationFrame(next => this.animate(next));
    const frame = this.source ? this.source.shown(now) : null;
    this.view.draw(frame, this.source?.trailEnd() ?? Infinity);
    if (!this.model.world) {
      return;
    }
    if (!(now - this.refreshed < 200)) {
      this.refreshed = now;
      this.refresh(frame);
    }
    this.driveByKeys(now);
  }

  /** Everything that need not change with every frame. */
  refresh(frame) {
    if (frame) {
      element("clock").textContent = `${frame.time.toFixed(1)} s`;
      element("rate").textContent = this.paused ? "paused"
        : this.waitsFor ? `waits for ${this.waitsFor}` : this.source.rate(frame);
    }
    const state = this.source.state();
    element("state").textContent = state ? `state ${state.state}${state.colourName ? ` (${state.colourName})` : ""}` : "";
    this.timeline.draw(this.view.colours, this.source.time(), this.source.end(), this.source.canSeek);
    this.listEvents();
    this.showRobots(frame);
    this.showDetails(frame);
  }

  showActors(asked) {
    const wanted = asked && !this.actors.isEmpty();
    element("actors").hidden = !wanted;
    element("actors-shown").setAttribute("aria-pressed", wanted);
    document.querySelector("main").classList.toggle("with-actors", wanted);
    if (wanted) {
      this.actors.draw();
    }
  }

  listRobots() {
    const wanted = element("find").value.trim().toLowerCase();
    const found = [...this.model.world.robots.entries()]
      .filter(([, robot]) => robot.name.toLowerCase().includes(wanted));
    const robots = found.slice(0, Page.MOST_LISTED);
    element("unlisted").hidden = robots.length === found.length;
    element("unlisted").textContent = `${robots.length} of ${found.length} robots are listed; find others by their names`;
    element("robots").replaceChildren(...robots.map(([index, robot]) => {
      const item = document.createElement("li");
      const button = document.createElement("button");
      button.type = "button";
      button.dataset.robot = index;
      const name = document.createElement("span");
      const what = document.createElement("span");
      what.className = "what";
      const chip = document.createElement("span");
      chip.className = "chip";
      name.append(chip, robot.name);
      button.append(name, what);
      button.setAttribute("aria-pressed", this.view.selected.has(index));
      button.onclick = event => this.select(index, event.shiftKey || event.ctrlKey);
      item.append(button);
      return item;
    }));
  }

  showRobots(frame) {
    if (!frame) {
      return;
    }
    for (const button of element("robots").querySelectorAll("button")) {
      const index = Number(button.dataset.robot);
      const state = frame.state[index];
      const alarm = (state & Model.STALLED) !== 0;
      const by = state & Model.BY_HAND ? "by hand" : this.model.serviceName(state);
      const node = this.model.drivers.get(index);
      const text = state & Model.AWAY ? "not in the world" : alarm ? "stuck" : node ? `${by}, ${node}` : by;
      const what = button.lastChild;
      if (what.textContent !== text) {
        what.textContent = text;
        what.classList.toggle("alarm", alarm);
      }
      const world = this.model.world;
      button.firstChild.firstChild.style.background =
        world.services.length ? this.model.serviceColour(state) : Model.colour(world.robots[index].colour);
    }
  }

  showDetails(frame) {
    const robot = [...this.view.selected][0];
    const shown = robot !== undefined && frame && robot < frame.count;
    element("details").hidden = !shown;
    if (!shown) {
      return;
    }
    element("details-title").textContent = this.model.world.robots[robot].name;
    const reading = this.model.readings.get(robot);
    const figures = {
      position: `${frame.x[robot].toFixed(2)} m, ${frame.y[robot].toFixed(2)} m`,
      heading: `${(frame.heading[robot] * 180 / Math.PI).toFixed(0)}°`,
    };
    if (reading) {
      figures.speed = `${reading.forward.toFixed(2)} m/s, ${(reading.turn * 180 / Math.PI).toFixed(0)}°/s`;
      figures["nearest wall"] = Number.isFinite(reading.gap) ? `${reading.gap.toFixed(2)} m` : "none";
      Object.assign(figures, this.deviceFigures(robot));
      figures.sees = reading.blobs.length ? `${reading.blobs.length} blob${reading.blobs.length > 1 ? "s" : ""}` : "no blob";
    }
    element("figures").replaceChildren(...Object.entries(figures).flatMap(([name, value]) => {
      const term = document.createElement("dt");
      const text = document.createElement("dd");
      term.textContent = name;
      text.textContent = value;
      return [term, text];
    }));
    this.showCamera(robot, reading);
    this.showImages(robot);
    const services = this.model.world.services.length > 0;
    element("help").textContent = this.model.world.controls.includes("drive")
      ? `Arrow keys drive it, and its ${services ? "service" : "program"} takes over again. Drag it to move it, its ring to turn it.` : "";
  }

  showCamera(robot, reading) {
    const camera = this.model.world.kinds[this.model.world.robots[robot].kind].camera;
    const canvas = element("camera");
    canvas.hidden = !camera || !reading;
    if (canvas.hidden) {
      return;
    }
    const to = canvas.getContext("2d");
    to.fillStyle = this.view.colours.floor;
    to.fillRect(0, 0, canvas.width, canvas.height);
    const column = canvas.width / camera.width;
    for (const blob of reading.blobs) {
      to.fillStyle = Model.colour(blob.colour);
      const height = Math.min(canvas.height, Math.max(8, blob.height / camera.width * canvas.width));
      to.fillRect(blob.left * column, (canvas.height - height) / 2, (blob.right - blob.left + 1) * column, height);
    }
  }

  /** What the further devices of a robot read, in words. */
  deviceFigures(robot) {
    const figures = {};
    const add = (name, text) => {
      let key = name;
      for (let number = 2; key in figures; number++) {
        key = `${name} ${number}`;
      }
      figures[key] = text;
    };
    for (const {reading} of this.model.devicesOf(robot, "fiducial")) {
      add("markers", reading.seen.map(each => each.id || "?").join(", ") || "none");
    }
    for (const {reading} of this.model.devicesOf(robot, "bumper")) {
      const pressed = reading.pressed.filter(each => each).length;
      add("bumpers", pressed ? `${pressed} of ${reading.pressed.length} pressed` : "free");
    }
    for (const {reading} of this.model.devicesOf(robot, "gripper")) {
      const held = this.model.devices.get(robot).held.map(each => this.model.world.obstacles[each]?.name);
      add("gripper", reading.paddles + (reading.holds ? `, holds ${held.join(", ") || "something"}` : ""));
    }
    return figures;
  }

  /** The images of the cameras of a robot, each on its own canvas. */
  showImages(robot) {
    const cameras = this.model.devicesOf(robot, "camera");
    const all = element("images");
    while (all.children.length > cameras.length) {
      all.lastChild.remove();
    }
    while (all.children.length < cameras.length) {
      const canvas = document.createElement("canvas");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", "Image of the camera");
      all.append(canvas);
    }
    cameras.forEach(({reading}, i) => Page.drawImage(all.children[i], reading));
  }

  /** Draws an image: what a column shows, between the sky and the floor. */
  static drawImage(canvas, {height, columns}) {
    canvas.width = columns.length;
    canvas.height = height;
    const to = canvas.getContext("2d");
    const middle = Math.floor(height / 2);
    to.fillStyle = "#ffffff";
    to.fillRect(0, 0, columns.length, middle);
    to.fillStyle = "#c0c0c0";
    to.fillRect(0, middle, columns.length, height - middle);
    columns.forEach(({colour, top, bottom}, x) => {
      to.fillStyle = Model.colour(colour);
      to.fillRect(x, top, 1, bottom - top);
    });
  }

  /** Lists new events; the newest is the first. An intervention that goes on is one line. */
  listEvents() {
    const list = element("events");
    const act = this.model.events.findLast(each => each.kind === "intervention");
    if (act?.shown) {
      act.shown.data = this.model.describe(act);
    }
    this.listed = Math.max(this.listed, this.model.forgotten);
    for (; this.listed < this.model.forgotten + this.model.events.length; this.listed++) {
      const event = this.model.events[this.listed - this.model.forgotten];
      if (!this.model.isListed(event)) {
        continue;
      }
      const item = document.createElement("li");
      item.dataset.kind = event.kind;
      item.dataset.time = event.t;
      const time = document.createElement("time");
      time.textContent = `${event.t.toFixed(1)} s`;
      const what = document.createElement(this.source.canSeek && event.kind === "state" ? "button" : "span");
      if (event.kind === "state") {
        const chip = document.createElement("span");
        chip.className = "chip";
        chip.style.background = Model.colour(event.colour);
        what.append(chip);
      }
      const text = document.createTextNode(this.model.describe(event));
      what.append(text);
      event.shown = text;
      what.classList.toggle("alarm", event.kind === "stall" || event.kind === "refused");
      if (this.source.canSeek) {
        what.onclick = () => this.source.seek(event.t);
      }
      item.append(time, what);
      list.prepend(item);
      while (list.children.length > Page.MOST_LISTED_EVENTS) {
        list.lastChild.remove();
      }
    }
  }

  status(text, alarm = false) {
    if (element("status").textContent !== text) {
      element("status").textContent = text;
    }
    element("status").classList.toggle("alarm", alarm);
  }

  complain(text) {
    element("problem").textContent = text;
    element("problem").hidden = false;
    clearTimeout(this.complaint);
    this.complaint = setTimeout(() => { element("problem").hidden = true; }, 4000);
  }

  showTime(speed) {
    element("play").textContent = this.paused ? this.source.canSeek ? "Play" : "Go on" : "Pause";
    const select = element("speed");
    if (![...select.options].some(each => Number(each.value) === speed)) {
      select.append(new Option(`${speed} x`, speed));
    }
    select.value = String(speed);
  }

  // ---- controls

  chooseTheme(dark) {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    element("theme").setAttribute("aria-pressed", dark);
    this.view.readColours();
  }

  addControls() {
    const view = this.view;
    element("theme").onclick = () => this.chooseTheme(document.documentElement.dataset.theme !== "dark");
    element("actors-shown").onclick = () => this.showActors(element("actors").hidden);
    element("zoom-in").onclick = () => view.zoom(1.4);
    element("zoom-out").onclick = () => view.zoom(1 / 1.4);
    element("fit").onclick = () => { view.follow = false; view.fit(); this.showToggles(); };
    for (const what of ["follow", "rays", "trails", "names"]) {
      element(what).onclick = () => { view[what] = !view[what]; this.showToggles(); };
    }
    element("play").onclick = () => this.source?.pause(!this.paused);
    element("step").onclick = () => this.source?.step();
    element("reset").onclick = () => this.source?.send("reset");
    element("speed").onchange = event => this.source?.setSpeed(Number(event.target.value));
    element("box-colour").replaceChildren(
      ...Object.entries(Model.BOX_COLOURS).map(([name, colour]) => new Option(name, colour)));
    element("box").onclick = () => this.choosePlaces(!this.putsBox);
    element("find").oninput = () => this.listRobots();
    this.addPointer();
    document.addEventListener("keydown", event => this.keyDown(event));
    document.addEventListener("keyup", event => this.keyUp(event));
    window.addEventListener("blur", () => this.keys.clear());
  }

  showToggles() {
    for (const what of ["follow", "rays", "trails", "names"]) {
      element(what).setAttribute("aria-pressed", this.view[what]);
    }
  }

  select(index, more = false) {
    const selected = this.view.selected;
    if (more) {
      if (!selected.delete(index)) {
        selected.add(index);
      }
    } else {
      selected.clear();
      selected.add(index);
    }
    this.selectionChanged();
  }

  selectionChanged() {
    for (const button of element("robots").querySelectorAll("button")) {
      button.setAttribute("aria-pressed", this.view.selected.has(Number(button.dataset.robot)));
    }
    this.source?.select([...this.view.selected]);
  }

  addPointer() {
    const canvas = element("world");
    const pointers = new Map();
    let drag = null;
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.view.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
    }, {passive: false});
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
      drag = pointers.size > 1 ? null : this.beginDrag(event);
    });
    canvas.addEventListener("pointermove", event => {
      const before = pointers.get(event.pointerId);
      if (!before) {
        canvas.classList.toggle("over", this.model.frame !== null && (this.view.robotAt(event.offsetX, event.offsetY) >= 0
          || this.view.boxAt(event.offsetX, event.offsetY) !== undefined));
        return;
      }
      const now = [event.offsetX, event.offsetY];
      if (pointers.size === 2) {
        const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
        const distance = point => Math.hypot(point[0] - other[0], point[1] - other[1]);
        this.view.zoom(distance(now) / Math.max(1, distance(before)), ...other);
      } else if (drag) {
        this.moveDrag(drag, now, before);
      }
      pointers.set(event.pointerId, now);
    });
    const end = event => {
      pointers.delete(event.pointerId);
      if (drag) {
        this.endDrag(drag, event);
      }
      drag = null;
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
  }

  beginDrag(event) {
    const at = [event.offsetX, event.offsetY];
    const frame = this.model.frame;
    const mayPlace = frame !== null && this.model.world.controls.includes("place");
    if (frame !== null && this.model.world.controls.includes("box")) {
      const [x, y] = this.view.toWorld(...at);
      const box = this.putsBox ? this.newBox(x, y) : this.view.robotAt(...at) < 0 ? this.view.boxAt(...at) : undefined;
      if (box) {
        return {robot: -1, begin: at, moved: false, sent: 0, isNew: this.putsBox, box: {...box}, grip: [box.x - x, box.y - y]};
      }
    }
    const handle = mayPlace ? this.view.handleAt(...at) : -1;
    const robot = handle >= 0 ? handle : frame ? this.view.robotAt(...at) : -1;
    const drag = {robot, turns: handle >= 0, begin: at, moved: false, mayPlace, sent: 0};
    if (robot >= 0 && mayPlace) {
      drag.pose = {robot, x: frame.x[robot], y: frame.y[robot], heading: frame.heading[robot]};
    }
    return drag;
  }

  moveDrag(drag, now, before) {
    drag.moved ||= Math.hypot(now[0] - drag.begin[0], now[1] - drag.begin[1]) > 4;
    if (!drag.moved) {
      return;
    }
    if (drag.box) {
      const [x, y] = this.view.toWorld(...now);
      drag.box.x = x + drag.grip[0];
      drag.box.y = y + drag.grip[1];
      this.view.boxGhost = drag.box;
      return;
    }
    if (!drag.pose) {
      this.view.pan(now[0] - before[0], now[1] - before[1]);
      this.showToggles();
      return;
    }
    const [x, y] = this.view.toWorld(...now);
    if (drag.turns) {
      drag.pose.heading = Math.atan2(y - drag.pose.y, x - drag.pose.x);
    } else {
      drag.pose.x = x;
      drag.pose.y = y;
    }
    this.view.ghost = drag.pose;
    if (performance.now() - drag.sent > Page.SEND_MILLIS) {
      drag.sent = performance.now();
      this.place(drag.pose);
    }
  }

  endDrag(drag, event) {
    this.view.ghost = null;
    this.view.boxGhost = null;
    if (drag.box) {
      this.box = drag.box.number;
      if (drag.moved || drag.isNew) {
        this.putBox(drag.box);
      }
      return;
    }
    if (drag.moved && drag.pose) {
      this.place(drag.pose);
      if (this.paused) {
        this.view.drop(drag.pose);
      }
    } else if (!drag.moved && drag.robot >= 0) {
      this.select(drag.robot, event.shiftKey || event.ctrlKey);
    } else if (!drag.moved) {
      this.view.selected.clear();
      this.selectionChanged();
    }
  }

  place(pose) {
    this.source.send(`place ${pose.robot + 1} ${pose.x.toFixed(3)} ${pose.y.toFixed(3)} ${pose.heading.toFixed(4)}`);
  }

  /** Whether the next click puts a box. */
  choosePlaces(wanted) {
    this.putsBox = wanted;
    element("box").setAttribute("aria-pressed", wanted);
    element("world").classList.toggle("puts", wanted);
  }

  newBox(x, y) {
    const used = new Set(this.model.boxes.map(each => each.number));
    const number = [...Array(20).keys()].map(each => each + 1).find(each => !used.has(each));
    if (number === undefined) {
      this.complain("there are 20 boxes, and that is the most: choose one by a click, and remove it by Delete");
      return undefined;
    }
    return {number, colour: parseInt(element("box-colour").value, 16), x, y, side: Model.BOX_M};
  }

  putBox(box) {
    this.choosePlaces(false);
    this.box = box.number;
    if (this.paused) {
      this.view.drop(box);
    }
    const colour = box.colour.toString(16).padStart(6, "0");
    this.source.send(`box ${box.number} ${colour} ${box.x.toFixed(3)} ${box.y.toFixed(3)}`);
  }

  keyDown(event) {
    if (event.target.closest("input, select") || event.ctrlKey || event.altKey || event.metaKey) {
      return;
    }
    const onButton = event.target.closest("button") !== null;
    const clicks = {".": "step", "+": "zoom-in", "-": "zoom-out", "0": "fit", "f": "follow", "r": "rays", "t": "trails",
      "n": "names", "a": "actors-shown", "b": "box"};
    if (event.key.startsWith("Arrow")) {
      event.preventDefault();
      this.arrow(event.key);
    } else if (event.key === " " && !onButton) {
      event.preventDefault();
      element("play").click();
    } else if (event.key === "Enter" && this.putsBox && event.target === element("world")) {
      const box = this.newBox(this.view.x, this.view.y);
      if (box) {
        this.putBox(box);
      }
    } else if ((event.key === "Delete" || event.key === "Backspace") && this.model.boxes.some(each => each.number === this.box)) {
      this.source.send(`unbox ${this.box}`);
    } else if (event.key === "Escape") {
      this.choosePlaces(false);
      this.view.selected.clear();
      this.selectionChanged();
    } else if (clicks[event.key.toLowerCase()]) {
      element(clicks[event.key.toLowerCase()]).click();
    }
  }

  arrow(key) {
    if (this.view.selected.size > 0 && this.model.world?.controls.includes("drive")) {
      this.keys.add(key);
      return;
    }
    const steps = {ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40]};
    this.view.pan(...steps[key]);
  }

  keyUp(event) {
    this.keys.delete(event.key);
  }

  /** While arrow keys are down, the first selected robot is driven by them. */
  driveByKeys(now) {
    const robot = [...this.view.selected][0];
    const wants = this.keys.size > 0 && robot !== undefined;
    if (!wants && this.driving !== undefined) {
      this.source.send(`release ${this.driving + 1}`);
      this.driving = undefined;
    } else if (wants && (this.driving === undefined || now - this.drove > 200 || this.keys.size !== this.droveKeys)) {
      if (this.driving !== undefined && this.driving !== robot) {
        this.source.send(`release ${this.driving + 1}`);
      }
      const axis = (plus, minus) => Number(this.keys.has(plus)) - Number(this.keys.has(minus));
      const forward = Page.DRIVE_MPS * axis("ArrowUp", "ArrowDown");
      const turn = Page.DRIVE_RADPS * axis("ArrowLeft", "ArrowRight");
      this.source.send(`drive ${robot + 1} ${forward} ${turn}`);
      this.driving = robot;
      this.drove = now;
      this.droveKeys = this.keys.size;
    }
  }
}

/** A server's stream: reconnects when it breaks off. */
class Live {
  static SILENT_S = 3;

  canSeek = false;

  constructor(page) {
    this.page = page;
    this.query = location.search;
    this.bytes = 0;
    this.queue = Promise.resolve();
    element("speed").replaceChildren(...[...Page.SPEEDS, 0].map(each => new Option(each ? `${each} x` : "fastest", each)));
    element("speed").value = "1";
    this.run();
  }

  async run() {
    for (let failures = 0; ; failures++) {
      try {
        const answer = await fetch("stream" + this.query, {cache: "no-store"});
        if (!answer.ok) {
          throw new Error(await answer.text());
        }
        failures = 0;
        await this.read(answer.body.getReader());
      } catch (error) {
        this.why ??= failures > 0 && error.message && !(error instanceof TypeError) ? error.message.trim() : null;
      }
      this.page.status(`${this.why ?? "no connection"}; trying again`, true);
      await new Promise(resume => setTimeout(resume, Math.min(2000, 250 * (failures + 1))));
    }
  }

  async read(reader) {
    const push = Messages.reader((type, value) => {
      if (type === Messages.HELLO) {
        this.viewer = value.viewer;
        this.why = null;
        this.page.status("live");
      } else if (type === Messages.END) {
        this.why = value.why;
      } else {
        this.page.handle(type, value);
      }
    });
    for (;;) {
      const {value, done} = await reader.read();
      if (done) {
        return;
      }
      this.bytes += value.length;
      push(value);
    }
  }

  shown(now) {
    return this.page.model.shown(now);
  }

  trailEnd() {
    return Infinity;
  }

  state() {
    return this.page.model.state;
  }

  time() {
    return this.page.model.frame?.time ?? 0;
  }

  end() {
    return Math.max(this.time(), 10);
  }

  rate(frame) {
    const silent = (performance.now() - frame.arrived) / 1000;
    if (silent > Live.SILENT_S) {
      return `no new reading for ${silent.toFixed(0)} s`;
    }
    return frame.speed > 0 ? `${frame.speed.toFixed(frame.speed < 10 ? 1 : 0)} x real time` : "";
  }

  /** Sends commands one after the other, so that they arrive in their order. */
  post(path, text) {
    this.queue = this.queue.then(async () => {
      try {
        const answer = await fetch(path + this.query, {method: "POST", body: text});
        if (!answer.ok) {
          this.page.complain((await answer.text()).trim());
        }
      } catch {
        this.page.complain("no connection");
      }
    });
    return this.queue;
  }

  send(command) {
    return this.post("command", command);
  }

  select(robots) {
    if (this.viewer) {
      this.post("select", [this.viewer, ...robots.map(each => each + 1)].join(" "));
    }
  }

  pause(wanted) {
    this.send(wanted ? "pause" : "resume");
  }

  step() {
    this.send("step");
  }

  setSpeed(speed) {
    this.send(`speed ${speed}`);
  }
}

/** A whole run that is in this file. */
class Film {
  canSeek = true;

  constructor(page) {
    this.page = page;
    page.model.mostEvents = Infinity; // what a file holds is bounded
    this.frames = [];
    this.readings = [];
    this.devices = [];
    this.now = 0;
    this.speed = 1;
    element("speed").replaceChildren(...Page.SPEEDS.map(each => new Option(`${each} x`, each)));
    element("speed").value = "1";
  }

  static async open(page, base64) {
    const film = new Film(page);
    page.source = film;
    const packed = Uint8Array.from(atob(base64), each => each.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    Messages.reader((type, value) => film.take(type, value))(bytes);
    film.begin();
  }

  take(type, value) {
    const model = this.page.model;
    if (type === Messages.WORLD) {
      this.page.handle(type, {...value, controls: ["pause", "step", "speed"]});
    } else if (type === Messages.FRAME) {
      model.lengthenTrails(model.place(value));
      this.frames.push(value);
    } else if (type === Messages.SENSORS) {
      model.setReadings(value);
      this.readings[this.frames.length - 1] = model.readings;
      this.devices[this.frames.length - 1] = model.devices;
    } else {
      this.page.handle(type, value);
    }
  }

  begin() {
    const scrub = element("scrub");
    scrub.hidden = false;
    scrub.max = this.end();
    scrub.oninput = () => this.seek(Number(scrub.value));
    element("timeline").onclick = event => this.seek(this.page.timeline.timeAt(event.offsetX));
    this.page.status("recorded");
    this.pause(true);
    this.seek(0);
  }

  shown(now) {
    if (!this.page.paused && this.last !== undefined) {
      this.seek(this.now + (now - this.last) / 1000 * this.speed);
      if (this.now >= this.end()) {
        this.pause(true);
      }
    }
    this.last = now;
    const i = this.index();
    const frame = this.frames[i];
    const next = this.frames[i + 1];
    this.page.model.frame = frame ?? null;
    this.page.model.boxes = this.page.model.boxesAt(this.now);
    this.page.model.drivers = this.page.model.driversAt(this.now);
    this.page.model.readings = this.readings[i] ?? new Map();
    this.page.model.devices = this.devices[i] ?? new Map();
    if (!frame || !next) {
      return frame ?? null;
    }
    return this.page.model.between(frame, next, Math.min(1, Math.max(0, (this.now - frame.time) / (next.time - frame.time))));
  }

  /** The last frame up to now. */
  index() {
    let low = 0;
    let high = this.frames.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.frames[middle].time <= this.now + 1e-9) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    return low;
  }

  seek(time) {
    this.now = Math.min(this.end(), Math.max(0, time));
    element("scrub").value = this.now;
  }

  trailEnd() {
    return this.now;
  }

  state() {
    return this.page.model.events.findLast(each => each.kind === "state" && each.t <= this.now + 1e-9);
  }

  time() {
    return this.now;
  }

  end() {
    return this.frames.length ? this.frames[this.frames.length - 1].time : 0;
  }

  rate() {
    return `${this.speed} x`;
  }

  select() {}

  send() {}

  pause(wanted) {
    if (!wanted && this.now >= this.end()) {
      this.seek(0);
    }
    this.page.paused = wanted;
    this.page.showTime(this.speed);
  }

  step() {
    this.pause(true);
    this.seek(this.frames[Math.min(this.index() + 1, this.frames.length - 1)].time);
  }

  setSpeed(speed) {
    this.speed = speed;
  }
}

const troupe = new Page();
const film = element("data").textContent.trim();
if (film) {
  Film.open(troupe, film).catch(error => troupe.complain(`the run in this file cannot be read: ${error.message}`));
} else {
  troupe.source = new Live(troupe);
}
