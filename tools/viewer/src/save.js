// Pictures and films of the stage, kept as files.
const FRAMES = 30; // a second of a film

function keep(blob, name) {
  const link = document.createElement('a');
  Object.assign(link, { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export function savePicture(canvas, name) {
  canvas.toBlob((blob) => keep(blob, `${name}.png`));
}

// Returns what ends the film, and keeps it.
export function startFilm(canvas, name) {
  const recorder = new MediaRecorder(canvas.captureStream(FRAMES), { mimeType: 'video/webm' });
  const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  recorder.onstop = () => keep(new Blob(parts, { type: 'video/webm' }), `${name}.webm`);
  recorder.start();
  return () => recorder.stop();
}
