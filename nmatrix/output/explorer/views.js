// The bodies as WebGL2 draws them, with the shaders that nmatrix prints. One hidden canvas serves
// every view; a view copies its picture from there.
const SETTERS = { mat4: "uniformMatrix4fv", mat3: "uniformMatrix3fv", vec3: "uniform3fv", vec2: "uniform2fv", float: "uniform1f" };
const flat = (A) => transpose(A).flat();
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
const HEAD = "#version 300 es\nprecision highp float;\n";
// Lines in ink, where the body ends for the eye and along its creases; nine copies make them thick.
const INK = {
  vertex: `${HEAD}uniform mat4 clip_from_object; uniform vec2 reach; uniform float nearer; in vec3 vertex_position;
void main() {
    gl_Position = clip_from_object * vec4(vertex_position, 1.0);
    gl_Position.xy += reach * vec2(gl_InstanceID % 3 - 1, gl_InstanceID / 3 - 1) * gl_Position.w;
    gl_Position.z -= nearer * gl_Position.w;  // lines lie on what they outline
}`,
  fragment: `${HEAD}uniform vec3 ink; out vec4 color; void main() { color = vec4(ink, 1.0); }`,
  uniforms: [["clip_from_object", "mat4"], ["reach", "vec2"], ["nearer", "float"], ["ink", "vec3"]],
};
// The map: an angle between two normals, or what two lights differ by, as a share of `whole`.
const MAP = {
  vertex: `${HEAD}uniform mat4 clip_from_object; uniform mat4 world_from_object; in vec3 vertex_position; in vec3 vertex_normal; out vec3 n; out vec3 p;
void main() { n = vertex_normal; p = (world_from_object * vec4(vertex_position, 1.0)).xyz; gl_Position = clip_from_object * vec4(vertex_position, 1.0); }`,
  fragment: `${HEAD}uniform mat3 wrong; uniform mat3 right; uniform float whole; uniform float two_sided; uniform float of_light; uniform float is_near;
uniform vec3 light; uniform vec3 stuck_light;
uniform vec3 heat_0; uniform vec3 heat_1; uniform vec3 heat_2; uniform vec3 heat_3; uniform vec3 heat_4; uniform vec3 heat_5;
in vec3 n; in vec3 p; out vec4 color;
float shade(vec3 l) { return max(0.0, dot(normalize(right * n), normalize(is_near > 0.5 ? l - p : -l))); }
void main() {
    vec3 a = wrong * n, b = right * n;
    float along = dot(a, b);
    if (two_sided > 0.5) along = abs(along);
    float off = atan(length(cross(a, b)), along) * 57.2957795;
    if (of_light > 0.5) off = abs(shade(light) - shade(stuck_light));
    float t = 5.0 * clamp(off / whole, 0.0, 1.0);
    vec3 c = mix(heat_0, heat_1, clamp(t, 0.0, 1.0));
    c = mix(c, heat_2, clamp(t - 1.0, 0.0, 1.0)); c = mix(c, heat_3, clamp(t - 2.0, 0.0, 1.0));
    c = mix(c, heat_4, clamp(t - 3.0, 0.0, 1.0)); c = mix(c, heat_5, clamp(t - 4.0, 0.0, 1.0));
    color = vec4(c, 1.0);
}`,
  uniforms: [["clip_from_object", "mat4"], ["world_from_object", "mat4"], ["wrong", "mat3"], ["right", "mat3"],
    ["whole", "float"], ["two_sided", "float"], ["of_light", "float"], ["is_near", "float"], ["light", "vec3"], ["stuck_light", "vec3"],
    ...[0, 1, 2, 3, 4, 5].map((i) => [`heat_${i}`, "vec3"])],
};

class Painter {
  constructor(onChange) {
    this.canvas = document.createElement("canvas");
    this.gl = this.canvas.getContext("webgl2", { antialias: false, alpha: true });
    this.programs = new Map(); this.meshes = new Map(); this.errors = [];
    const kept = this.gl;
    // A browser that takes the context away, for want of memory, may give it back empty.
    for (const [kind, gl] of [["webglcontextlost", null], ["webglcontextrestored", kept]]) this.canvas.addEventListener(kind, (event) => {
      event.preventDefault(); this.programs.clear(); this.meshes.clear(); this.gl = gl; onChange();
    });
  }
  leave() { this.canvas.width = this.canvas.height = 1; }
  program(pair) {
    if (this.programs.has(pair)) return this.programs.get(pair);
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, pair.vertex], [gl.FRAGMENT_SHADER, pair.fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text); gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) this.errors.push(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "vertex_position"); gl.bindAttribLocation(program, 1, "vertex_normal");
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) this.errors.push(gl.getProgramInfoLog(program));
    const found = { program, places: pair.uniforms.map(([name, kind]) => [name, kind, gl.getUniformLocation(program, name)]) };
    this.programs.set(pair, found);
    return found;
  }
  // A mesh is sent once; one that is baked into the world is sent again when the world changes.
  send(mesh, key = mesh.shape) {
    const gl = this.gl, old = this.meshes.get(key);
    if (old && old.mesh === mesh) return old;
    const sent = old || { buffers: [0, 1, 2, 3].map(() => gl.createBuffer()) };  // the last holds lines
    sent.mesh = mesh;
    [[gl.ARRAY_BUFFER, Float32Array, mesh.positions], [gl.ARRAY_BUFFER, Float32Array, mesh.normals], [gl.ELEMENT_ARRAY_BUFFER, Uint16Array, mesh.triangles]]
      .forEach(([kind, type, values], i) => { gl.bindBuffer(kind, sent.buffers[i]); gl.bufferData(kind, new type(values), gl.DYNAMIC_DRAW); });
    this.meshes.set(key, sent);
    return sent;
  }
  use(pair, uniforms) {
    const gl = this.gl, { program, places } = this.program(pair);
    gl.useProgram(program);
    for (const [name, kind, at] of places) {
      if (kind.startsWith("mat")) gl[SETTERS[kind]](at, false, flat(uniforms[name]));
      else gl[SETTERS[kind]](at, uniforms[name]);
    }
  }
  // A body in its shaders. One that is a flat sheet has both its sides in one place: only those that are turned to the eye are drawn, with
  // nothing behind to hide.
  picture({ size, samples = 1, ink, mesh, key, pair, uniforms, isFlat, outline = 0, nearer = 0.01, viewed = uniforms.clip_from_object }) {
    const gl = this.gl, side = size * samples;
    if (this.canvas.width < side) this.canvas.width = this.canvas.height = side;
    gl.viewport(0, 0, side, side); gl.enable(gl.SCISSOR_TEST); gl.scissor(0, 0, side, side);
    gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { buffers } = this.send(mesh, key), reach = Math.max(0, outline - 1) / side;
    for (const place of [0, 1]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[place]);
      gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    }
    (isFlat ? gl.enable : gl.disable).call(gl, gl.CULL_FACE);
    (isFlat ? gl.disable : gl.enable).call(gl, gl.DEPTH_TEST);
    this.use(pair, uniforms);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[2]);
    gl.drawElements(gl.TRIANGLES, mesh.triangles.length, gl.UNSIGNED_SHORT, 0);
    if (outline) {
      const lines = new Uint16Array([...mesh.creases, ...silhouette(mesh, viewed)]);
      this.use(INK, { clip_from_object: uniforms.clip_from_object, reach: [reach, reach], nearer, ink });
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[3]); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, lines, gl.STREAM_DRAW);
      gl.drawElementsInstanced(gl.LINES, lines.length, gl.UNSIGNED_SHORT, 0, 9);
    }
    const error = gl.getError();
    if (error) this.errors.push("GL error " + error);
  }
  // The pixels go by way of memory: a drawing that takes them from WebGL itself is slow ever after.
  // Edges are smooth where a pixel is drawn as several, and their mean is taken here.
  copyTo(context, size, samples = 1) {
    const gl = this.gl, side = size * samples, read = (this.read ??= document.createElement("canvas"));
    if (read.width !== side) {
      read.width = read.height = side;
      this.pixels = new ImageData(side, side); this.reader = read.getContext("2d", { willReadFrequently: true });
    }
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(this.pixels.data.buffer));
    this.reader.putImageData(this.pixels, 0, 0);
    context.save(); context.scale(1, -1);  // WebGL counts rows from below
    context.imageSmoothingQuality = "high"; context.drawImage(read, 0, -size, size, size); context.restore();
  }
}

// --- What the shaders are given -----------------------------------------------------------------------
const shadersOf = (space, found) => data.shaders[space][found.isRigid ? "rigid" : "stretched"];
function uniformsFor(s, space, side, found, viewed) {
  const S = found.S, B = linear(S), isStuck = side === "wrong" && s.rule === STUCK;
  const light = isStuck ? found.stuckLight : found.light, lamp = isStuck ? found.stuckLamp : found.lamp;
  const rule = side === "wrong" && s.rule !== STUCK ? s.rule : "exact";
  return {
    ...constants(),
    clip_from_object: space === "static" ? viewed : times(viewed, found.M),
    space_from_object: times(S, found.M),
    normal_matrix: ruleMatrix(rule, wholeTimes(whole(B), found.whole), found.isFlat),
    light_direction: light && apply(B, unit(light)),
    light_position: lamp && point(S, lamp),
    eye: space === "camera" ? [0, 0, 0] : point(S, found.eye),
    vector_world_from_space: space === "object" ? found.A : inverse3(B),
    normal_world_from_space: transpose(B),
  };
}
// The depth, on the screen, between the body's middle and a point that is nearer by an 80th.
function creaseDepth(found) {
  const depth = (p) => { const [, , z, w] = apply(times(data.webgl_from_clip, found.clip_from_world), [...p, 1]); return z / w; };
  const middle = point(found.M, [0, 0, 0]), gap = Math.abs(depth(middle) - depth(plus(middle, minus(found.eye, middle), 0.012)));
  return Number.isFinite(gap) ? gap : 0;
}
// On grey paper the surface keeps its lightness and gives up its colour.
function constants() {
  if (themeNow() !== "print") return data.constants;
  const grey = ([r, g, b]) => Array(3).fill(0.2126 * r + 0.7152 * g + 0.0722 * b);
  return { ...data.constants, ambient_color: grey(data.constants.ambient_color), diffuse_color: grey(data.constants.diffuse_color) };
}
function baked(mesh, M, W) {
  const positions = mesh.points.flatMap((p) => point(M, p)), normals = mesh.directions.flatMap((n) => unit(apply(W, n)));
  return { ...mesh, positions, normals };
}
// The body of one side, lit in the space of shading; null where that space or rule has no answer.
function bodyOf(s, side, found) {
  if (!found.S || (side === "wrong" && !found.wrong) || (side === "wrong" && s.rule === STUCK && !(found.stuckLight || found.stuckLamp))) return null;
  const viewed = times(data.webgl_from_clip, found.clip_from_world), isBaked = s.space === "static";
  return {
    mesh: isBaked ? baked(found.mesh, found.M, side === "wrong" ? found.wrong : found.right) : found.mesh,
    key: isBaked ? "baked" : undefined, pair: shadersOf(s.space, found), uniforms: uniformsFor(s, s.space, side, found, viewed),
    isFlat: found.isFlat, nearer: creaseDepth(found), viewed: found.viewed,
  };
}
function mapOf(s, side, found) {
  const W = side === "wrong" ? found.wrong : found.right, isStuck = s.rule === STUCK;
  if (!W) return null;
  const whole = (isStuck ? found.brightness : found.largest) || 1, near = data.has_direction ? 0 : 1;
  const heat = Object.fromEntries(data.palettes[themeNow()].heat.map((hex, i) => [`heat_${i}`, rgb(hex)]));
  const [light, stuck] = near ? [found.lamp, found.stuckLamp] : [found.light, found.stuckLight];
  const uniforms = {
    ...heat, clip_from_object: found.viewed, world_from_object: found.M,
    wrong: scaled(W, 1 / (norm(W) || 1)), right: scaled(found.right, 1 / (norm(found.right) || 1)), whole, two_sided: Number(found.isFlat),
    of_light: Number(isStuck), is_near: near, light, stuck_light: (isStuck && side === "wrong" && stuck) || light,
  };
  return { mesh: found.mesh, pair: MAP, uniforms, isFlat: found.isFlat, nearer: creaseDepth(found) };
}
