// The numbers of the page: see seacrane/pictures/pose_curves.py.

export async function gunzip(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

export class Series {
  // Rows of whole numbers of a step over the frames, from second differences in planes of bytes.
  constructor(buffer, { at, shape, step }) {
    const [rows, frames] = shape;
    const size = rows * frames;
    const bytes = new Uint8Array(buffer, at, 4 * size);
    this.step = step;
    this.frames = frames;
    this.rows = rows;
    this.counts = new Int32Array(size);
    for (let row = 0; row < rows; row++) {
      let rate = 0;
      let value = 0;
      for (let i = row * frames; i < (row + 1) * frames; i++) {
        const folded = bytes[i] | (bytes[i + size] << 8) | (bytes[i + 2 * size] << 16) | (bytes[i + 3 * size] << 24);
        rate = (rate + ((folded >>> 1) ^ -(folded & 1))) | 0;
        value = (value + rate) | 0;
        this.counts[i] = value;
      }
    }
  }

  get(row, frame) {
    return this.counts[row * this.frames + frame] * this.step;
  }

  linear(row, { frame, u }) {
    const next = Math.min(frame + 1, this.frames - 1);
    return (1 - u) * this.get(row, frame) + u * this.get(row, next);
  }
}

export function floats(buffer, { at, shape }) {
  const size = shape.reduce((a, b) => a * b, 1);
  return new Float32Array(buffer.slice(at, at + 4 * size));
}

export function whole(buffer, { at, shape }) {
  const size = shape.reduce((a, b) => a * b, 1);
  return new Uint32Array(buffer.slice(at, at + 4 * size));
}
