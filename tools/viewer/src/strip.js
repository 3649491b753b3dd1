// Channels over time, with a cursor that follows it; a press or a drag moves the time.
import { Series } from './unpack.js';

const GUTTER = 168;
const HIGHEST = 46; // pixels of a row
const LOWEST = 30;
const SHARE = 0.32; // of the page
const AXIS = 18;
const HEAD = 17; // of the names of stages
const COLOURS = ['#0b5a8a', '#c2581a', '#2f7d3a', '#8a2f6b', '#6b6b1a', '#333f4a'];

export class Strip {
  constructor(canvas, panels, stages, buffer, motion, seek) {
    Object.assign(this, { canvas, motion, stages, head: stages.length ? HEAD : 0 });
    this.panels = panels.map((panel) => ({ ...panel, series: new Series(buffer, panel.values), bounds: new Series(buffer, panel.bounds) }));
    canvas.hidden = !this.panels.length && !stages.length;
    const move = (event) => {
      const box = canvas.getBoundingClientRect();
      const u = (event.clientX - box.left - GUTTER) / (box.width - GUTTER - 12);
      seek(motion.start + Math.min(1, Math.max(0, u)) * (motion.end - motion.start));
    };
    canvas.addEventListener('pointerdown', (event) => { canvas.setPointerCapture(event.pointerId); move(event); });
    canvas.addEventListener('pointermove', (event) => { if (event.buttons) move(event); });
  }

  size() {
    if (this.canvas.hidden) return;
    this.row = Math.round(Math.min(HIGHEST, Math.max(LOWEST, (SHARE * window.innerHeight) / this.panels.length)));
    this.canvas.style.height = `${this.head + this.panels.length * this.row + AXIS}px`;
    const ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    this.back = document.createElement('canvas');
    this.back.width = this.canvas.width;
    this.back.height = this.canvas.height;
    const pen = this.back.getContext('2d');
    pen.scale(ratio, ratio);
    this.ratio = ratio;
    this.draw(pen);
  }

  x(t) {
    return GUTTER + ((t - this.motion.start) / (this.motion.end - this.motion.start || 1)) * (this.width - GUTTER - 12);
  }

  y(panel, row, value) {
    const span = panel.high - panel.low || 1;
    return this.head + row * this.row + 6 + (1 - (value - panel.low) / span) * (this.row - 12);
  }

  draw(pen) {
    pen.fillStyle = '#fff';
    pen.fillRect(0, 0, this.width, this.height);
    pen.font = '11px sans-serif';
    this.drawStages(pen);
    this.panels.forEach((panel, row) => this.drawPanel(pen, panel, row));
    pen.fillStyle = '#445';
    pen.textAlign = 'center';
    for (const t of ticks(this.motion.start, this.motion.end, Math.max(3, (this.width - GUTTER) / 110))) {
      const x = this.x(t);
      pen.fillText(`${t}`, x, this.height - 5);
      pen.fillStyle = '#e3e8ec';
      pen.fillRect(x, this.head, 1, this.panels.length * this.row);
      pen.fillStyle = '#445';
    }
    pen.textAlign = 'left';
    pen.fillText('time [s]', 10, this.height - 5);
  }

  // Names over the time line, as much of each as has room, and where each begins.
  drawStages(pen) {
    this.stages.forEach(([name, start, end], i) => {
      const [left, right] = [this.x(start), this.x(end)];
      pen.fillStyle = i % 2 ? '#e9eef2' : '#f6f8fa';
      pen.fillRect(left, 0, right - left, this.height - AXIS);
      pen.fillStyle = '#33475a';
      pen.textAlign = 'left';
      let text = name;
      while (text && pen.measureText(text).width > right - left - 6) text = text.slice(0, -1);
      if (text.length === name.length || text.length > 2) pen.fillText(text, left + 3, 12);
    });
    if (this.head) {
      pen.fillStyle = '#1d2b36';
      pen.fillText('stage', 10, 12);
    }
  }

  drawPanel(pen, panel, row) {
    const top = this.head + row * this.row;
    pen.fillStyle = '#c9d2d9';
    pen.fillRect(0, top + this.row - 1, this.width, 1);
    pen.fillStyle = '#8a97a3';
    pen.textAlign = 'right';
    pen.fillText(short(panel.high), GUTTER - 6, top + 12);
    pen.fillText(short(panel.low), GUTTER - 6, top + this.row - 4);
    pen.textAlign = 'left';
    panel.labels.forEach((label, line) => {
      pen.strokeStyle = COLOURS[line % COLOURS.length];
      pen.lineWidth = 1.2;
      pen.beginPath();
      const { frames } = panel.series;
      const each = Math.max(1, Math.floor(frames / (2 * this.width)));
      for (let i = 0; i < frames; i += each) {
        let [low, high] = [Infinity, -Infinity];
        for (let k = i; k < Math.min(i + each, frames); k++) {
          low = Math.min(low, panel.bounds.get(line, k));
          high = Math.max(high, panel.bounds.get(panel.labels.length + line, k));
        }
        const x = this.x(this.motion.start + i * this.motion.interval);
        pen.lineTo(x, this.y(panel, row, low));
        if (high > low) pen.lineTo(x, this.y(panel, row, high));
      }
      pen.stroke();
    });
  }

  show(t) {
    if (this.canvas.hidden) return;
    const pen = this.canvas.getContext('2d');
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(this.back, 0, 0);
    pen.scale(this.ratio, this.ratio);
    const place = this.motion.place(t);
    pen.fillStyle = '#c0392b';
    pen.fillRect(this.x(t) - 0.5, 0, 1.5, this.head + this.panels.length * this.row);
    this.panels.forEach((panel, row) => {
      pen.font = 'bold 11px sans-serif';
      pen.fillStyle = '#1d2b36';
      pen.fillText(`${panel.title} [${panel.unit}]`, 10, this.head + (row + 0.32) * this.row, GUTTER - 50);
      pen.font = '11px sans-serif';
      const values = panel.labels.map((_, line) => short(panel.series.linear(line, place)));
      let x = 10;
      panel.labels.forEach((label, line) => {
        pen.fillStyle = COLOURS[line % COLOURS.length];
        const text = label ? `${label} ${values[line]}` : values[line];
        if (x + pen.measureText(text).width < GUTTER - 40 || line === 0) pen.fillText(text, x, this.head + (row + 0.76) * this.row, GUTTER - 50);
        x += pen.measureText(text).width + 8;
      });
    });
  }
}

function short(value) {
  const size = Math.abs(value);
  return size >= 1000 || size === 0 ? value.toFixed(0) : size >= 100 ? value.toFixed(1) : size >= 0.01 ? value.toFixed(2) : value.toExponential(1);
}

function ticks(start, end, most) {
  const wanted = (end - start) / most || 1;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= wanted);
  const out = [];
  for (let i = Math.ceil(start / step); i * step <= end + 1e-9; i++) out.push(+(i * step).toPrecision(12));
  return out;
}
