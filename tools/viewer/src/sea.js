// The surface: the sum of the wave components, in the vertex shader. Phases at the time shown are computed in
// double precision here, so that hours of waves stay exact.
import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, Mesh, RGBAFormat, ShaderMaterial, Color, Vector2,
  Vector3,
} from 'three';

const MOST_IN_SOFTWARE = 60;

export class Sea {
  constructor(components, { software, radius, centre, sky, grid }) {
    this.all = [];
    for (let i = 0; i + 4 < components.length; i += 5) this.all.push(components.slice(i, i + 5));
    this.drawn = this.all.slice(0, software ? MOST_IN_SOFTWARE : 1000);
    const count = Math.max(1, this.drawn.length);
    this.texels = new Float32Array(4 * count);
    this.texture = new DataTexture(this.texels, count, 1, RGBAFormat, FloatType);
    const height = this.drawn.reduce((sum, [a]) => sum + a * a, 0) ** 0.5 || 0.5;
    this.mesh = new Mesh(disc(radius, software ? 96 : 180), new ShaderMaterial({
      transparent: true,
      side: DoubleSide,
      uniforms: {
        waves: { value: this.texture },
        centre: { value: new Vector2(centre.x, centre.y) },
        radius: { value: radius },
        height: { value: height },
        grid: { value: grid },
        sky: { value: new Color(sky) },
        eye: { value: new Vector3() },
      },
      vertexShader: `
        uniform sampler2D waves; uniform vec2 centre; uniform float radius;
        varying vec3 slope; varying vec3 place; varying float far;
        void main() {
          vec2 at = position.xy + centre; float z = 0.0; vec2 g = vec2(0.0);
          for (int i = 0; i < ${this.drawn.length}; i++) {
            vec4 w = texelFetch(waves, ivec2(i, 0), 0);
            float f = w.y - dot(w.zw, at);
            z += w.x * cos(f); g += w.x * sin(f) * w.zw;
          }
          far = length(position.xy) / radius;
          slope = vec3(-g * (1.0 - 0.8 * smoothstep(0.15, 0.8, far)), 1.0);
          place = vec3(at, z);
          gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
        }`,
      fragmentShader: `
        uniform float height; uniform float grid; uniform vec3 sky; uniform vec3 eye;
        varying vec3 slope; varying vec3 place; varying float far;
        void main() {
          vec3 n = normalize(slope), v = normalize(eye - place), sun = normalize(vec3(0.35, -0.45, 0.75));
          if (dot(n, v) < 0.0) n = -n;
          vec3 steep = normalize(vec3(2.2 * slope.xy, 1.0));  // shaded steeper than it is, to be read
          float light = clamp(0.6 + 1.5 * (dot(steep, sun) - 0.77), 0.0, 1.3);
          float crest = clamp(0.45 + 0.3 * place.z / height, 0.0, 1.0);
          vec3 water = mix(vec3(0.015, 0.13, 0.22), vec3(0.16, 0.46, 0.55), crest) * (0.35 + 0.9 * light);
          float mirror = 0.05 + 0.6 * pow(1.0 - max(dot(n, v), 0.0), 4.0);
          water = mix(water, sky, 0.8 * mirror);
          water += 0.5 * pow(max(dot(reflect(-sun, n), v), 0.0), 60.0);
          vec2 lines = abs(fract(place.xy / grid - 0.5) - 0.5) / fwidth(place.xy / grid);
          float line = (1.0 - min(min(lines.x, lines.y), 1.0)) * (1.0 - smoothstep(0.05, 0.45, far));
          water = mix(water, vec3(1.0), 0.20 * line);
          gl_FragColor = vec4(mix(water, sky, smoothstep(0.3, 0.95, far)), 0.8);
          #include <colorspace_fragment>
        }`,
    }));
    this.mesh.frustumCulled = false;
  }

  show(t, eye) {
    this.drawn.forEach(([a, w, phase, kx, ky], i) => {
      this.texels.set([a, (w * t + phase) % (2 * Math.PI), kx, ky], 4 * i);
    });
    this.texture.needsUpdate = true;
    this.mesh.material.uniforms.eye.value.copy(eye);
  }

  elevation(x, y, t) {
    return this.all.reduce((sum, [a, w, phase, kx, ky]) => sum + a * Math.cos(w * t + phase - kx * x - ky * y), 0);
  }
}

// A round sheet, finer towards its middle.
function disc(radius, rings) {
  const spokes = 2 * rings;
  const points = [0, 0, 0];
  for (let i = 1; i <= rings; i++) {
    const u = i / rings;
    const r = radius * (0.22 * u + 0.78 * u ** 4);
    for (let j = 0; j < spokes; j++) {
      const angle = (2 * Math.PI * (j + 0.5 * (i % 2))) / spokes;
      points.push(r * Math.cos(angle), r * Math.sin(angle), 0);
    }
  }
  const at = (i, j) => (i === 0 ? 0 : 1 + (i - 1) * spokes + (j % spokes));
  const faces = [];
  for (let j = 0; j < spokes; j++) faces.push(0, at(1, j), at(1, j + 1));
  for (let i = 1; i < rings; i++) {
    for (let j = 0; j < spokes; j++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      faces.push(a, b, c, a, c, d);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  geometry.setIndex(faces);
  return geometry;
}
