// Image space by WebGL 2: a fragment shader that casts a ray through every pixel.

const STILL_MILLISECONDS = 250, TURNING_MILLISECONDS = 25; // that a picture may take
const UNIFORMS = ["surface", "paint", "eye", "right", "up", "ahead", "reach", "pixel", "samples", "angles"];

const VERTEX = `#version 300 es
in vec2 corner;
out vec2 at;
void main() { at = corner; gl_Position = vec4(corner, 0.0, 1.0); }`;

// Exact: every pixel's ray meets each quadric where a quadratic equation says.
const FRAGMENT = `#version 300 es
precision highp float;
in vec2 at;
out vec4 colour;
uniform mat4 surface[2];
uniform vec3 paint[2];
uniform vec3 eye, right, up, ahead;
uniform vec2 reach;   // half the picture's width and height, over the distance to it
uniform vec2 pixel;   // a pixel's share of at
uniform int samples;
uniform vec4 angles;  // of M: Z3 in the middle of the box and half its height, middle angle, step of lines

void meet(mat4 c, vec3 o, vec3 d, out float t1, out float t2) {
  vec4 o4 = vec4(o, 1.0), d4 = vec4(d, 0.0);
  vec4 cd = c * d4;
  float a = dot(d4, cd), b = dot(o4, cd), e = dot(o4, c * o4);
  float root = b * b - a * e;
  t1 = t2 = 1e9;
  if (root < 0.0) return;
  float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(root));
  if (abs(a) > 1e-9 * abs(q)) t1 = q / a;
  if (q != 0.0) t2 = e / q;
}

vec4 ray(vec2 xy) {
  vec3 d = normalize(ahead + xy.x * reach.x * right + xy.y * reach.y * up);
  vec3 near3 = (-1.0 - eye) / d, far3 = (1.0 - eye) / d;
  vec3 least = min(near3, far3), most = max(near3, far3);
  float enter = max(max(least.x, least.y), least.z), leave = min(min(most.x, most.y), most.z);
  if (enter >= leave) return vec4(0.0);
  float middle = (enter + leave) / 2.0;
  vec3 o = eye + middle * d;
  float reachable = (leave - enter) / 2.0;
  vec2 hit[4]; // how far, and which surface
  meet(surface[0], o, d, hit[0].x, hit[1].x);
  meet(surface[1], o, d, hit[2].x, hit[3].x);
  hit[0].y = hit[1].y = 0.0;
  hit[2].y = hit[3].y = 1.0;
  // Sorted, each pair first.
  for (int k = 0; k < 5; k++) {
    int i = k == 1 ? 2 : k == 3 ? 1 : k == 4 ? 1 : 0, j = k == 0 ? 1 : k == 1 ? 3 : k == 2 ? 2 : k == 3 ? 3 : 2;
    if (hit[i].x > hit[j].x) { vec2 other = hit[i]; hit[i] = hit[j]; hit[j] = other; }
  }
  vec3 light = vec3(0.0);
  float through = 1.0;
  for (int k = 0; k < 4; k++) {
    float t = hit[k].x;
    if (abs(t) > reachable) continue;
    bool first = hit[k].y < 0.5;
    vec3 p = o + t * d;
    vec3 n = normalize(((first ? surface[0] : surface[1]) * vec4(p, 1.0)).xyz);
    float facing = abs(dot(n, d));
    vec3 lamp = normalize(-ahead + 0.5 * up - 0.6 * right);
    float lit = 0.42 + 0.58 * abs(dot(n, lamp));
    float shine = pow(abs(dot(n, normalize(lamp - d))), 40.0);
    float width = (middle + t) * pixel.y * reach.y * sqrt(max(0.0, 1.0 - n.z * n.z)) / max(facing, 0.15) + 1e-4;
    float z = angles.x + angles.y * p.z;
    float turns = (2.0 * atan(z) + angles.z) / angles.w;
    float off = abs(fract(turns + 0.5) - 0.5) * angles.w * (1.0 + z * z) / (2.0 * angles.y);
    float line = 1.0 - smoothstep(0.5 * width, 1.6 * width, off);
    float alpha = mix(0.5, 0.92, pow(1.0 - facing, 2.0));
    vec3 own = (first ? paint[0] : paint[1]) * lit * (1.0 - 0.35 * line) + 0.22 * shine;
    light += through * alpha * own;
    through *= 1.0 - alpha;
  }
  return vec4(light, 1.0 - through);
}

void main() {
  if (samples == 1) { colour = ray(at); return; }
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; k++) {
    vec2 part = vec2(k % 2 == 0 ? -0.5 : 0.5, k < 2 ? -0.5 : 0.5);
    sum += ray(at + part * pixel);
  }
  colour = sum / 4.0;
}`;

/** Whether WebGL 2 is drawn by hardware; where it is not, `drawStill` is faster. */
function hasGraphics() {
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
  return Boolean(gl) && !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/** A canvas with WebGL 2 that draws scenes, as `sceneOf` in image_space.mjs describes them. */
export class Shader {
  /** @type {any} */ pace;

  /** The shader on a canvas, null where it cannot be; `lost` is called when it ceases to be. */
  static on(canvas, lost) {
    if (!hasGraphics()) return null;
    const gl = canvas.getContext("webgl2", { antialias: false, premultipliedAlpha: true, preserveDrawingBuffer: true });
    if (!gl) return null;
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      lost();
      return null;
    }
    canvas.addEventListener("webglcontextlost", lost, { once: true });
    return new Shader(canvas, gl, program);
  }

  constructor(canvas, gl, program) {
    this.canvas = canvas;
    this.gl = gl;
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
    const corner = gl.getAttribLocation(program, "corner");
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 2, gl.FLOAT, false, 0, 0);
    this.places = Object.fromEntries(UNIFORMS.map((name) => [name, gl.getUniformLocation(program, name)]));
  }

  draw(scene, size, turning) {
    const { gl, places } = this;
    gl.clearColor(0, 0, 0, 0);
    if (!scene.quadrics.length) {
      gl.clear(gl.COLOR_BUFFER_BIT);
      return;
    }
    gl.uniformMatrix4fv(places.surface, false, new Float32Array(scene.quadrics.flat()));
    gl.uniform3fv(places.paint, new Float32Array(scene.paint.flat()));
    for (const name of ["eye", "right", "up", "ahead"]) gl.uniform3fv(places[name], scene[name]);
    gl.uniform2fv(places.reach, scene.reach);
    gl.uniform4fv(places.angles, scene.angles);
    this.pace ??= this.measure(size);
    const full = Math.min(2, window.devicePixelRatio || 1), most = turning ? TURNING_MILLISECONDS : STILL_MILLISECONDS;
    const ways = turning ? [[1, 1], [0.7, 1], [0.45, 1]] : [[full, 4], [1, 4], [full, 1], [1, 1], [0.7, 1]];
    const fits = ways.find(([dense, samples]) => dense * dense * samples * this.pace * size.width * size.height < most);
    this.once(size, ...(fits ?? ways[ways.length - 1]));
  }

  /** Milliseconds a ray takes: where graphics are slow, the picture gets fewer of them. */
  measure(size) {
    const { gl } = this;
    this.once(size, 0.12, 1); // the first one is compiled, too
    gl.finish();
    const start = performance.now();
    this.once(size, 0.3, 1);
    gl.finish();
    return (performance.now() - start) / (0.09 * size.width * size.height);
  }

  /** One picture: pixels of the canvas per pixel of the page along a side, rays per pixel. */
  once(size, dense, samples) {
    const { gl, canvas, places } = this;
    const width = Math.round(size.width * dense), height = Math.round(size.height * dense);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.uniform2f(places.pixel, 1 / width, 1 / height);
    gl.uniform1i(places.samples, samples);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
