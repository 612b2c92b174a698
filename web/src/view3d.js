// One interface in space, turned with the mouse, a finger or the arrow keys. Drawn only when something
// has changed.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, FrontSide, LineBasicMaterial,
  LineSegments, LinearFilter, Mesh, OrthographicCamera, RGBAFormat, Scene, ShaderMaterial, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { viridis } from "./colors.js";
import { drawAxes, FIRST_VIEW, LIGHT, longestRoundLength, SHADING } from "./interface.js";
import { numFaces, refined } from "./surface.js";
import { make, readable, variable } from "./text.js";

const MOST_TRIANGLES = 20000; // of the pieces of curved faces
const MOST_PARTS = 4; // of their edges
const NO_VALUE = -1e30; // GLSL has no portable test for NaN

const VERTEX_SHADER = `
attribute float value;
varying float vValue;
varying vec3 vNormal;
void main() {
  vValue = value;
  vNormal = normalMatrix * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const number = (value) => value.toFixed(4); // as GLSL writes it
const FRAGMENT_SHADER = `
uniform sampler2D scale;
uniform float low, high, opacity;
varying float vValue;
varying vec3 vNormal;
void main() {
  vec3 n = normalize(vNormal);
  if (!gl_FrontFacing) n = -n;
  float share = max(0.0, dot(n, normalize(vec3(${LIGHT.map(number).join(",")}))));
  float s = clamp((vValue - low) / (high - low), 0.0, 1.0);
  vec3 color = vValue < -1e29 ? vec3(0.6, 0.65, 0.7) : texture2D(scale, vec2((s * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  color = color * (${number(SHADING.dark)} + ${number(SHADING.lit)} * share);
  color += (1.0 - color) * ${number(SHADING.white)} * share * share;
  gl_FragColor = vec4(color, opacity);
}`;

function scaleTexture() {
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) bytes.set([...viridis(i / 255), 255], 4 * i);
  const texture = new DataTexture(bytes, 256, 1, RGBAFormat);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Each edge of a closed surface once: that of the face which runs along it upwards. */
function edgesOf(index) {
  const edges = new index.constructor(index.length);
  let n = 0;
  for (let f = 0; f < index.length; f += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = index[f + k];
      const b = index[f + ((k + 1) % 3)];
      if (a < b) {
        edges[n++] = a;
        edges[n++] = b;
      }
    }
  }
  return edges.slice(0, n);
}

/** Flat triangles of a frame, curved faces in so many pieces as the view can turn. */
function drawnFaces(frame) {
  if (!frame.middles) return frame;
  const parts = Math.floor(Math.sqrt(MOST_TRIANGLES / numFaces(frame)));
  return refined(frame, Math.max(1, Math.min(MOST_PARTS, parts)));
}

export class View3D {
  /** `box`: what shall fit, {low, high}; `onTurn` hears when the reader has turned the view. */
  constructor(box, label, onTurn) {
    this.box = box;
    this.onTurn = onTurn;
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${label} in 3-D; arrow keys turn it, + and − zoom`);
    this.overlay = make("div", { class: "overlay", "aria-hidden": "true" });
    this.element = make("div", { class: "stage" }, this.canvas, this.overlay);
    this.scene = new Scene();
    this.camera = new OrthographicCamera();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => {
      this.draw();
      this.onTurn?.(this);
    });
    this.canvas.addEventListener("keydown", (event) => this.onKey(event));
    this.makeSurface();
    this.drawn = new Promise((resolve) => (this.noteDrawn = resolve)); // for the first time
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  makeSurface() {
    this.material = new ShaderMaterial({
      vertexShader: VERTEX_SHADER,
      fragmentShader: FRAGMENT_SHADER,
      side: FrontSide,
      polygonOffset: true, // the edges lie on the faces
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      uniforms: {
        scale: { value: scaleTexture() },
        low: { value: 0 },
        high: { value: 1 },
        opacity: { value: 1 },
      },
    });
    this.lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.35 });
    this.surface = new Mesh(new BufferGeometry(), this.material);
    this.lines = new LineSegments(new BufferGeometry(), this.lineMaterial);
    this.lines.visible = false;
    this.surface.frustumCulled = this.lines.frustumCulled = false;
    this.scene.add(this.surface, this.lines);
  }

  /** Shows a frame in the colours of a field. */
  show(frame, field) {
    this.frame = frame;
    this.field = field;
    if (!frame.geometry) {
      frame.drawn = drawnFaces(frame);
      frame.geometry = new BufferGeometry();
      frame.geometry.setAttribute("position", new BufferAttribute(frame.drawn.position, 3));
      frame.geometry.setIndex(new BufferAttribute(frame.drawn.index, 1));
      frame.geometry.computeVertexNormals();
    }
    const geometry = new BufferGeometry();
    for (const name of ["position", "normal"]) geometry.setAttribute(name, frame.geometry.getAttribute(name));
    geometry.setIndex(frame.geometry.index);
    const values = frame.drawn.values[field];
    const drawn = new Float32Array(frame.drawn.position.length / 3).fill(NO_VALUE);
    values?.forEach((value, v) => {
      if (Number.isFinite(value)) drawn[v] = value;
    });
    geometry.setAttribute("value", new BufferAttribute(drawn, 1));
    this.surface.geometry.dispose();
    this.surface.geometry = geometry;
    this.updateLines();
    if (this.isFollowing) this.centerOn(frame);
    this.draw();
  }

  updateLines() {
    if (!this.lines.visible || !this.frame) return;
    this.frame.edges ??= this.frame.drawn.edges ?? edgesOf(this.frame.index);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.frame.geometry.getAttribute("position"));
    geometry.setIndex(new BufferAttribute(this.frame.edges, 1));
    this.lines.geometry.dispose();
    this.lines.geometry = geometry;
  }

  setRange(low, high) {
    this.material.uniforms.low.value = low;
    this.material.uniforms.high.value = high > low ? high : low + 1e-12;
    this.draw();
  }

  setWireframe(isOn) {
    this.lines.visible = isOn;
    this.updateLines();
    this.draw();
  }

  setOpacity(opacity) {
    this.material.uniforms.opacity.value = opacity;
    this.material.transparent = opacity < 1;
    this.material.side = opacity < 1 ? DoubleSide : FrontSide; // the far side shows through
    this.material.depthWrite = opacity === 1;
    this.material.needsUpdate = true;
    this.draw();
  }

  setFollowing(isOn) {
    this.isFollowing = isOn;
    if (isOn && this.frame) this.centerOn(this.frame);
    this.draw();
  }

  centerOn({ low, high }) {
    this.moveTarget(new Vector3(...low).add(new Vector3(...high)).multiplyScalar(0.5));
  }

  moveTarget(target) {
    const shift = target.clone().sub(this.controls.target);
    this.controls.target.copy(target);
    this.camera.position.add(shift);
    this.controls.update();
  }

  /** Looks along `toward` (at the eye), everything in view. */
  lookFrom(toward = new Vector3(...FIRST_VIEW)) {
    const low = new Vector3(...this.box.low);
    const high = new Vector3(...this.box.high);
    const center = low.clone().add(high).multiplyScalar(0.5);
    this.reach = Math.max(high.distanceTo(low), 1e-6);
    this.controls.target.copy(center);
    this.camera.up.set(0, Math.abs(toward.y) > 0.99 ? 0 : 1, Math.abs(toward.y) > 0.99 ? -1 : 0);
    this.camera.position.copy(center).addScaledVector(toward, 10 * this.reach);
    this.camera.lookAt(center);
    this.camera.updateMatrixWorld();
    this.fit(low, high);
    this.controls.update();
    if (this.isFollowing && this.frame) this.centerOn(this.frame);
    this.draw();
  }

  /** Zooms so that the box fills the stage; what is in it rarely reaches its corners. */
  fit(low, high) {
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    const half = (axis) => {
      const size = high.clone().sub(low);
      return 0.5 * (Math.abs(axis.x) * size.x + Math.abs(axis.y) * size.y + Math.abs(axis.z) * size.z);
    };
    this.half = { right: half(right), up: half(up) };
    this.camera.zoom = 1;
    this.project();
  }

  project() {
    if (!this.half) return;
    const { width, height } = this.size();
    this.halfHeight = Math.max(this.half.up, (this.half.right * height) / width, 1e-9);
    const halfWidth = (this.halfHeight * width) / height;
    Object.assign(this.camera, {
      left: -halfWidth, right: halfWidth, top: this.halfHeight, bottom: -this.halfHeight,
      near: 0.01 * this.reach, far: 40 * this.reach,
    });
    this.camera.updateProjectionMatrix();
  }

  size() {
    return { width: Math.max(1, this.element.clientWidth), height: Math.max(1, this.element.clientHeight) };
  }

  resize() {
    const { width, height } = this.size();
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
    if (this.half) this.project();
    else this.lookFrom();
    this.draw();
  }

  /** Takes over the point of view of another. */
  copyView(other) {
    this.camera.position.copy(other.camera.position);
    this.camera.quaternion.copy(other.camera.quaternion);
    this.camera.up.copy(other.camera.up);
    this.camera.zoom = other.camera.zoom;
    this.controls.target.copy(other.controls.target);
    this.half = other.half;
    this.reach = other.reach;
    this.project();
    this.draw();
  }

  onKey(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const zooms = { "+": 1.15, "=": 1.15, "-": 1 / 1.15 };
    if (turns[event.key]) this.turn(...turns[event.key]);
    else if (zooms[event.key]) this.camera.zoom *= zooms[event.key];
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
    this.onTurn?.(this);
  }

  turn(right, up) {
    const angle = Math.PI / 24;
    const arm = this.camera.position.clone().sub(this.controls.target);
    arm.applyAxisAngle(this.camera.up, right * angle);
    const side = new Vector3().crossVectors(this.camera.up, arm).normalize();
    const tilted = arm.clone().applyAxisAngle(side, -up * angle);
    if (tilted.angleTo(this.camera.up) > 0.1 && tilted.angleTo(this.camera.up) < Math.PI - 0.1) arm.copy(tilted);
    this.camera.position.copy(this.controls.target).add(arm);
    this.camera.lookAt(this.controls.target);
  }

  draw() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.drawNow();
    });
  }

  drawNow() {
    if (!this.half) return; // not on the page yet
    this.lineMaterial.color = new Color(variable("--edge"));
    this.renderer.render(this.scene, this.camera);
    this.drawOverlay();
    if (this.frame) this.noteDrawn();
    this.onDrawn?.();
  }

  /** The axes of space and the length R0. */
  drawOverlay() {
    const { height } = this.size();
    const px = (height / (2 * this.halfHeight)) * this.camera.zoom; // of R0
    const length = longestRoundLength(120 / px);
    const [right, up] = [0, 1].map((k) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, k).toArray());
    const text =
      `<svg class="axes" width="72" height="72">${drawAxes({ right, up }, 36, 36, 24)}</svg>` +
      `<span class="length" style="width:${(length * px).toFixed(1)}px">${readable(length, 2)} R₀</span>`;
    if (text !== this.overlayText) this.overlay.innerHTML = this.overlayText = text;
  }
}
