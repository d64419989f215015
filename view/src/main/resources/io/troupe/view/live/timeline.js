"use strict";

/** Draws the states of a run as a band, and contacts, stalls and interventions as marks above it. */
class Timeline {
  static BAND_PX = 20;
  static LIGHT_PX = 14;

  constructor(canvas, model) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.model = model;
  }

  draw(colours, time, end, isWhole) {
    const ratio = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const to = this.context;
    to.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.end = Math.max(end, 1);
    const x = t => t / this.end * width;
    const top = Timeline.LIGHT_PX;
    to.fillStyle = colours.grid;
    to.fillRect(0, top, width, Timeline.BAND_PX);
    this.drawStates(x, isWhole ? end : time, top);
    this.drawMarks(x, time, colours);
    to.fillStyle = colours.text;
    to.fillRect(Math.min(width - 2, Math.max(0, x(time) - 1)), 0, 2, top + Timeline.BAND_PX + 3);
    this.drawTimes(x, colours, width, height);
  }

  drawStates(x, time, top) {
    const to = this.context;
    const states = this.model.events.filter(each => each.kind === "state");
    to.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    to.textAlign = "left";
    for (let i = 0; i < states.length; i++) {
      const from = x(states[i].t);
      const until = x(i + 1 < states.length ? states[i + 1].t : Math.max(time, states[i].t));
      to.fillStyle = Model.colour(states[i].colour);
      to.fillRect(from, top, Math.max(1, until - from - 0.5), Timeline.BAND_PX);
      if (until - from > 16) {
        to.fillStyle = Timeline.isLight(states[i].colour) ? "#000000" : "#ffffff";
        to.fillText(states[i].state, from + 4, top + 14);
      }
    }
  }

  static isLight(colour) {
    return 0.3 * (colour >> 16 & 255) + 0.59 * (colour >> 8 & 255) + 0.11 * (colour & 255) > 140;
  }

  drawMarks(x, time, colours) {
    const to = this.context;
    const kinds = {contact: colours.quiet, stall: colours.alarm, intervention: colours.accent, driver: colours.text};
    for (const event of this.model.events) {
      if (kinds[event.kind] && this.model.isListed(event)) {
        to.fillStyle = kinds[event.kind];
        to.fillRect(x(event.t) - 1, 2, 2, 9);
      }
    }
  }

  drawTimes(x, colours, width, height) {
    const to = this.context;
    const wanted = this.end / Math.max(2, width / 110);
    const power = 10 ** Math.floor(Math.log10(wanted));
    const step = [1, 2, 5, 10].map(each => each * power).find(each => each >= wanted);
    to.fillStyle = colours.quiet;
    to.textAlign = "center";
    for (let t = step; t < this.end && x(t) < width - 24; t += step) {
      to.fillText(`${Number(t.toPrecision(6))} s`, x(t), height - 1);
    }
  }

  /** The time at a point of the line. */
  timeAt(pageX) {
    return Math.min(1, Math.max(0, pageX / this.canvas.clientWidth)) * (this.end ?? 1);
  }
}
