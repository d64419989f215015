"use strict";

/** Shows who calls whom: a drawing, a table, and the state of the spaces. */
function showActors(actors, colours) {
  element("actors").hidden = !actors;
  if (!actors) {
    return;
  }
  const text = JSON.stringify(actors);
  if (showActors.shown === text) {
    return;
  }
  showActors.shown = text;
  element("calls").replaceChildren(...actors.calls.slice(0, 12).map(call => {
    const row = document.createElement("tr");
    for (const value of [call.from, `${call.to}.${call.method}`, String(call.perSecond)]) {
      const cell = document.createElement("td");
      cell.textContent = value;
      row.append(cell);
    }
    return row;
  }));
  element("spaces").textContent = actors.spaces
    .map(each => `${each.name}: ${each.actors} actors, ${each.waiting} waiting, ${each.stalls} stalls`).join("; ");
  drawGraph(element("graph"), actors, colours);
}

function drawGraph(canvas, actors, colours) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const to = canvas.getContext("2d");
  to.setTransform(ratio, 0, 0, ratio, 0, 0);
  to.clearRect(0, 0, width, height);
  const names = [...new Set(actors.calls.flatMap(each => [each.from, each.to]))].slice(0, 24);
  const places = new Map(names.map((name, i) => {
    const angle = 2 * Math.PI * i / names.length - Math.PI / 2;
    return [name, [width / 2 + Math.cos(angle) * width * 0.32, height / 2 + Math.sin(angle) * height * 0.38]];
  }));
  for (const call of actors.calls) {
    const from = places.get(call.from);
    const end = places.get(call.to);
    if (from && end) {
      drawCall(to, from, end, call.perSecond, colours);
    }
  }
  to.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  to.textAlign = "center";
  for (const [name, [x, y]] of places) {
    to.beginPath();
    to.arc(x, y, 6, 0, 7);
    to.fillStyle = colours.accent;
    to.fill();
    to.lineWidth = 3;
    to.strokeStyle = colours.panel;
    const waiting = actors.mailboxes?.[name];
    const label = waiting ? `${name} (${waiting} waiting)` : name;
    to.strokeText(label, x, y - 10);
    to.fillStyle = colours.text;
    to.fillText(label, x, y - 10);
  }
}

function drawCall(to, from, end, perSecond, colours) {
  to.strokeStyle = colours.quiet;
  to.lineWidth = Math.min(6, 1 + Math.log10(1 + perSecond));
  to.globalAlpha = 0.7;
  to.beginPath();
  if (from === end) {
    to.arc(from[0], from[1] + 14, 12, 0, 7);
    to.stroke();
    to.globalAlpha = 1;
    return;
  }
  const angle = Math.atan2(end[1] - from[1], end[0] - from[0]);
  const tip = [end[0] - Math.cos(angle) * 9, end[1] - Math.sin(angle) * 9];
  const bend = [(from[0] + end[0]) / 2 - Math.sin(angle) * 14, (from[1] + end[1]) / 2 + Math.cos(angle) * 14];
  to.moveTo(...from);
  to.quadraticCurveTo(...bend, ...tip);
  for (const side of [0.4, -0.4]) {
    to.moveTo(...tip);
    to.lineTo(tip[0] - Math.cos(angle + side) * 8, tip[1] - Math.sin(angle + side) * 8);
  }
  to.stroke();
  to.globalAlpha = 1;
}
