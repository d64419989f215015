"use strict";

/** Draws who calls whom, and lists the same in two tables. Rates are those between the last two messages. */
class ActorGraph {
  static MOST_NODES = 40;
  static WIDTH = 172;
  static HEIGHT = 54;
  static COLUMN = 222;
  static ROW = 68;
  static LINE_CHARACTERS = 26;
  /** Not a space of actors: its nodes are components and hosts, whose turns are not counted here. */
  static BUS = "bus";
  static STALL_MILLIS = 250;

  constructor(svg, nodes, edges) {
    this.svg = svg;
    this.nodeRows = nodes;
    this.edgeRows = edges;
    this.before = null;
    this.now = null;
  }

  update(counts) {
    this.before = this.now && this.now.ms < counts.ms ? this.now : null;
    this.now = counts;
  }

  isEmpty() {
    return !this.now || this.now.nodes.length === 0;
  }

  /** Nodes and edges with their rates, as they are to be shown. */
  figures() {
    const {now, before} = this;
    const seconds = before ? (now.ms - before.ms) / 1000 : Infinity;
    const key = each => `${each.space}/${each.name}`;
    const oldNodes = new Map((before?.nodes ?? []).map(each => [key(each), each]));
    const edgeKey = (of, each) => `${key(of.nodes[each.from])} > ${key(of.nodes[each.to])}`;
    const oldEdges = new Map((before?.edges ?? []).map(each => [edgeKey(before, each), each]));
    const names = new Map(); // how many have a name; names that differ in capitals only are too much alike
    const plain = each => each.name.toLowerCase();
    now.nodes.forEach(each => names.set(plain(each), (names.get(plain(each)) ?? 0) + 1));
    const nodes = now.nodes.map((each, index) => {
      const old = oldNodes.get(key(each)) ?? {turns: 0, busy: 0, stalls: 0};
      return {...each, index, label: names.get(plain(each)) > 1 && each.space ? `${each.name} (${each.space})` : each.name,
        counted: each.space !== ActorGraph.BUS,
        rate: (each.turns - old.turns) / seconds, share: (each.busy - old.busy) / 1000 / seconds,
        alarm: each.current > ActorGraph.STALL_MILLIS || before !== null && each.stalls > old.stalls};
    });
    const edges = now.edges.map(each => {
      const old = oldEdges.get(edgeKey(now, each)) ?? {calls: 0, results: 0};
      return {...each, rate: (each.calls - old.calls) / seconds, resultRate: (each.results - old.results) / seconds};
    });
    return {nodes, edges};
  }

  draw() {
    if (this.isEmpty()) {
      return;
    }
    const {nodes, edges} = this.figures();
    this.list(nodes, edges);
    const traffic = node => edges.filter(each => each.from === node.index || each.to === node.index)
      .reduce((sum, each) => sum + each.calls + each.results, 0);
    const shown = new Set([...nodes].sort((a, b) => traffic(b) - traffic(a)).slice(0, ActorGraph.MOST_NODES));
    const drawn = nodes.filter(each => shown.has(each));
    const lines = edges.filter(each => shown.has(nodes[each.from]) && shown.has(nodes[each.to]) && each.calls + each.results > 0);
    const places = ActorGraph.layout(drawn, lines);
    const width = Math.max(...[...places.values()].map(each => each.x)) + ActorGraph.WIDTH + 10;
    const height = Math.max(...[...places.values()].map(each => each.y)) + ActorGraph.HEIGHT + 34;
    this.svg.setAttribute("viewBox", `-50 -24 ${width + 60} ${height}`);
    this.svg.replaceChildren(ActorGraph.arrow("arrow"), ActorGraph.arrow("quiet-arrow"),
      ...lines.flatMap(each => this.line(each, nodes, places)), ...drawn.map(each => this.box(each, places.get(each.index))));
  }

  /** A column for each step from the callers that nobody calls; in a column in the order of their callers. */
  static layout(nodes, edges) {
    const calls = [];
    for (const each of edges) {
      if (each.calls > 0 && each.from !== each.to && !ActorGraph.leads(calls, each.to, each.from)) {
        calls.push(each); // without circles
      }
    }
    const column = new Map(nodes.map(each => [each.index, 0]));
    for (let round = 0; round < nodes.length; round++) {
      for (const {from, to} of calls) {
        if (column.get(to) <= column.get(from)) {
          column.set(to, column.get(from) + 1);
        }
      }
    }
    const row = new Map();
    const places = new Map();
    const count = Math.max(...column.values()) + 1;
    const columns = Array.from({length: count}, (_, i) => nodes.filter(each => column.get(each.index) === i));
    const most = Math.max(...columns.map(each => each.length));
    columns.forEach((members, i) => {
      const weight = node => {
        const rows = calls.filter(each => each.to === node.index && row.has(each.from)).map(each => row.get(each.from));
        return rows.length ? rows.reduce((sum, each) => sum + each, 0) / rows.length : 0;
      };
      const ordered = members.map(node => [weight(node), node]).sort((a, b) => a[0] - b[0] || a[1].index - b[1].index);
      ordered.forEach(([, node], j) => {
        const at = j + (most - members.length) / 2;
        row.set(node.index, at);
        places.set(node.index, {x: i * ActorGraph.COLUMN, y: at * ActorGraph.ROW});
      });
    });
    return places;
  }

  /** Whether calls lead from one node to another. */
  static leads(calls, from, to) {
    const seen = new Set([from]);
    const open = [from];
    while (open.length) {
      const at = open.pop();
      if (at === to) {
        return true;
      }
      for (const each of calls) {
        if (each.from === at && !seen.has(each.to)) {
          seen.add(each.to);
          open.push(each.to);
        }
      }
    }
    return false;
  }

  static element(name, attributes, ...children) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) {
      made.setAttribute(key, value);
    }
    made.append(...children);
    return made;
  }

  static arrow(id) {
    return ActorGraph.element("marker", {id, viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 8, markerHeight: 8,
      markerUnits: "userSpaceOnUse", orient: "auto"}, ActorGraph.element("path", {d: "M0 0L8 4L0 8Z"}));
  }

  line(edge, nodes, places) {
    const from = places.get(edge.from);
    const to = places.get(edge.to);
    const middle = ActorGraph.HEIGHT / 2;
    const forward = to.x > from.x;
    const text = `${nodes[edge.from].label} to ${nodes[edge.to].label}: ${edge.calls} calls, ${edge.results} results`;
    const lines = [];
    const add = (rate, kind, shift) => {
      const x1 = from.x + (forward ? ActorGraph.WIDTH : 0);
      const x2 = to.x + (forward ? 0 : ActorGraph.WIDTH);
      const y1 = from.y + middle + shift;
      const y2 = to.y + middle + shift;
      const own = edge.from === edge.to;
      const same = !own && from.x === to.x;
      const bend = same ? -40 : (x2 - x1) / 2;
      const path = own ? `M${from.x + 50} ${from.y}c0 -26 60 -26 60 0`
        : same ? `M${from.x} ${y1}C${from.x + bend} ${y1} ${to.x + bend} ${y2} ${to.x} ${y2}`
          : `M${x1} ${y1}C${x1 + bend} ${y1} ${x2 - bend} ${y2} ${x2} ${y2}`;
      const active = rate > 0;
      const drawn = ActorGraph.element("path", {d: path, class: `${kind}${active ? "" : " quiet"}`,
        "stroke-width": active ? Math.min(5, 1.5 + Math.log10(1 + rate)) : 1.2,
        "marker-end": `url(#${active ? "arrow" : "quiet-arrow"})`});
      drawn.append(ActorGraph.element("title", {}, text));
      lines.push(drawn);
      const at = own ? [from.x + 80, from.y - 12] : same ? [from.x - 32, (y1 + y2) / 2] : [(x1 + x2) / 2, (y1 + y2) / 2 - 4];
      lines.push(ActorGraph.element("text", {x: at[0], y: at[1], class: "rate"}, active ? ActorGraph.rate(rate) : ""));
    };
    if (edge.calls > 0) {
      add(edge.rate, "calls", edge.results > 0 ? -6 : 0);
    }
    if (edge.results > 0) {
      add(edge.resultRate, "results", 9);
    }
    return lines;
  }

  box(node, place) {
    const names = ActorGraph.lines(node.label);
    const middle = ActorGraph.WIDTH / 2;
    const current = node.current > ActorGraph.STALL_MILLIS ? `, ${(node.current / 1000).toFixed(1)} s in one turn` : "";
    const what = node.counted ? `${ActorGraph.rate(node.rate)}, ${node.waiting} waiting${current}` : "on the bus";
    const group = ActorGraph.element("g", {transform: `translate(${place.x} ${place.y})`, class: node.alarm ? "alarm" : ""},
      ActorGraph.element("rect", {width: ActorGraph.WIDTH, height: ActorGraph.HEIGHT, rx: 6}),
      ...names.map((name, i) => ActorGraph.element("text", {x: middle, y: (names.length > 1 ? 16 : 24) + 14 * i}, name)),
      ActorGraph.element("text", {x: middle, y: names.length > 1 ? 46 : 40, class: "small"}, what),
      ActorGraph.element("title", {}, `${node.label} of space ${node.space || "none"}`));
    group.dataset.name = node.name;
    return group;
  }

  /** A name in at most two lines, cut where a word ends if that is possible; its title has all of it. */
  static lines(name) {
    const most = ActorGraph.LINE_CHARACTERS;
    if (name.length <= most) {
      return [name];
    }
    const end = Math.max(...[" ", "/", ":", "-"].map(each => name.lastIndexOf(each, most - 1)));
    const cut = end > 0 ? end + 1 : most;
    const rest = name.slice(cut);
    return [name.slice(0, cut).trimEnd(), rest.length > most ? `${rest.slice(0, 8)}…${rest.slice(9 - most)}` : rest];
  }

  static rate(value) {
    return value === 0 ? "0/s" : value < 10 ? `${value.toFixed(1)}/s` : `${Math.round(value)}/s`;
  }

  list(nodes, edges) {
    const row = (texts, alarm) => {
      const made = document.createElement("tr");
      made.className = alarm ? "alarm" : "";
      made.append(...texts.map(each => {
        const cell = document.createElement("td");
        cell.textContent = each;
        cell.title = each;
        return cell;
      }));
      return made;
    };
    const busiest = [...nodes].sort((a, b) => b.turns - a.turns);
    const used = edges.filter(each => each.calls + each.results > 0)
      .sort((a, b) => b.calls + b.results - a.calls - a.results);
    this.nodeRows.replaceChildren(...busiest.map(each => row(each.counted
      ? [each.label, each.rate.toFixed(1), each.waiting, `${(each.share * 100).toFixed(1)} %`,
        `${each.longest.toFixed(1)} ms${each.stalls ? `, ${each.stalls} stalls` : ""}`]
      : [each.label, "", "", "", "on the bus"], each.alarm)));
    this.edgeRows.replaceChildren(...used.flatMap(each => {
      const names = [nodes[each.from].label, nodes[each.to].label];
      const calls = row([...names, each.rate.toFixed(1), each.calls]);
      const results = row([names[0], `${names[1]} (results)`, each.resultRate.toFixed(1), each.results]);
      return each.calls === 0 ? [results] : each.results === 0 ? [calls] : [calls, results];
    }));
  }
}
