// Names beside what they name, as text, never as markup; those that would cover others give way.
export class Labels {
  constructor(host) {
    this.host = host;
    this.labels = [];
  }

  add(text, rank, place, kind) {
    const element = document.createElement('span');
    element.className = `label ${kind}`;
    element.textContent = text;
    this.host.append(element);
    this.labels.push({ element, rank, place });
    this.labels.sort((a, b) => a.rank - b.rank);
    return element;
  }

  show(camera, width, height, most) {
    const taken = [];
    for (const label of this.labels) {
      const place = label.rank <= most ? label.place() : null;
      const at = place && place.clone().project(camera);
      let seen = Boolean(at) && at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1;
      if (seen) {
        const [x, y] = [(0.5 + 0.5 * at.x) * width, (0.5 - 0.5 * at.y) * height];
        const box = { left: x - 4, right: x + 7 * label.element.textContent.length + 10, top: y - 20, bottom: y + 2 };
        seen = !taken.some((b) => b.left < box.right && box.left < b.right && b.top < box.bottom && box.top < b.bottom);
        if (seen) {
          taken.push(box);
          label.element.style.transform = `translate(${Math.round(x)}px, ${Math.round(y - 18)}px)`;
        }
      }
      label.element.hidden = !seen;
    }
  }
}
