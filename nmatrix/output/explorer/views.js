// The bodies as WebGL2 draws them, with the shaders that nmatrix prints. One hidden canvas serves
// every view; a view copies its picture from there.
const SETTERS = { mat4: "uniformMatrix4fv", mat3: "uniformMatrix3fv", vec3: "uniform3fv", vec2: "uniform2fv", float: "uniform1f" };
const flat = (A) => transpose(A).flat();
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
const HEAD = "#version 300 es\nprecision highp float;\n";
// An outline is the body's own silhouette, drawn in ink around it in eight directions.
const INK = {
  vertex: `${HEAD}uniform mat4 clip_from_object; uniform vec2 reach; in vec3 vertex_position;
void main() {
    gl_Position = clip_from_object * vec4(vertex_position, 1.0);
    float a = 0.785398163 * float(gl_InstanceID);
    gl_Position.xy += reach * vec2(cos(a), sin(a)) * gl_Position.w;
}`,
  fragment: `${HEAD}uniform vec3 ink; out vec4 color; void main() { color = vec4(ink, 1.0); }`,
  uniforms: [["clip_from_object", "mat4"], ["reach", "vec2"], ["ink", "vec3"]],
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
  uniforms: [["clip_from_object", "mat4"], ["world_from_object", "mat4"], ["wrong", "mat3"], ["right", "mat3"], ["whole", "float"], ["two_sided", "float"], ["of_light", "float"], ["is_near", "float"], ["light", "vec3"], ["stuck_light", "vec3"],
    ...[0, 1, 2, 3, 4, 5].map((i) => [`heat_${i}`, "vec3"])],
};

class Painter {
  constructor(antialias) {
    this.canvas = document.createElement("canvas");
    this.gl = this.canvas.getContext("webgl2", { antialias, alpha: true, preserveDrawingBuffer: true });
    this.programs = new Map(); this.meshes = new Map(); this.errors = [];
  }
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
    const sent = old || { buffers: [0, 1, 2, 3].map(() => gl.createBuffer()) };
    sent.mesh = mesh;
    [[gl.ARRAY_BUFFER, Float32Array, mesh.positions], [gl.ARRAY_BUFFER, Float32Array, mesh.normals], [gl.ELEMENT_ARRAY_BUFFER, Uint16Array, mesh.triangles], [gl.ELEMENT_ARRAY_BUFFER, Uint16Array, mesh.creases]]
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
  // A size in pixels, the colours' theme, the body's shaders, and whether it is one flat sheet. Such
  // a sheet has both its sides in one place: only those that are turned to the eye are drawn, with
  // nothing behind to hide.
  picture({ size, ink, mesh, key, pair, uniforms, isFlat, outline }) {
    const gl = this.gl;
    if (this.canvas.width < size || this.canvas.height < size) { this.canvas.width = this.canvas.height = size; }
    gl.viewport(0, 0, size, size); gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { buffers } = this.send(mesh, key), reach = outline ? (2 * outline) / size : 0;
    for (const place of [0, 1]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[place]);
      gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    }
    const drawInk = (kind, buffer, count, reached, copies) => {
      this.use(INK, { clip_from_object: uniforms.clip_from_object, reach: [reached, reached], ink });
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[buffer]);
      gl.drawElementsInstanced(kind, count, gl.UNSIGNED_SHORT, 0, copies);
    };
    gl.disable(gl.CULL_FACE); gl.disable(gl.DEPTH_TEST); gl.disable(gl.POLYGON_OFFSET_FILL);
    if (outline) drawInk(gl.TRIANGLES, 2, mesh.triangles.length, reach, 8);
    (isFlat ? gl.enable : gl.disable).call(gl, gl.CULL_FACE);
    (isFlat ? gl.disable : gl.enable).call(gl, gl.DEPTH_TEST);
    if (mesh.creases.length) { gl.enable(gl.POLYGON_OFFSET_FILL); gl.polygonOffset(1, 2); }
    this.use(pair, uniforms);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[2]);
    gl.drawElements(gl.TRIANGLES, mesh.triangles.length, gl.UNSIGNED_SHORT, 0);
    if (outline && mesh.creases.length) drawInk(gl.LINES, 3, mesh.creases.length, 0, 1);
    const error = gl.getError();
    if (error) this.errors.push("GL error " + error);
  }
  copyTo(context, size) { context.drawImage(this.canvas, 0, this.canvas.height - size, size, size, 0, 0, size, size); }
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
    normal_matrix: ruleMatrix(rule, times(B, found.A), found.isFlat),
    light_direction: light && apply(B, unit(light)),
    light_position: lamp && point(S, lamp),
    eye: space === "camera" ? [0, 0, 0] : point(S, found.eye),
    vector_world_from_space: space === "object" ? found.A : inverse3(B),
    normal_world_from_space: transpose(B),
  };
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
  const uniforms = uniformsFor(s, s.space, side, found, times(data.webgl_from_clip, found.clip_from_world));
  const isBaked = s.space === "static";
  return { mesh: isBaked ? baked(found.mesh, found.M, side === "wrong" ? found.wrong : found.right) : found.mesh, key: isBaked ? "baked" : undefined, pair: shadersOf(s.space, found), uniforms, isFlat: found.isFlat };
}
function mapOf(s, side, found) {
  const W = side === "wrong" ? found.wrong : found.right, isStuck = s.rule === STUCK;
  if (!W) return null;
  const whole = (isStuck ? found.brightness : found.largest) || 1, near = data.has_direction ? 0 : 1;
  const heat = Object.fromEntries(data.palettes[themeNow()].heat.map((hex, i) => [`heat_${i}`, rgb(hex)]));
  const [light, stuck] = near ? [found.lamp, found.stuckLamp] : [found.light, found.stuckLight];
  const uniforms = {
    ...heat, clip_from_object: times(times(data.webgl_from_clip, found.clip_from_world), found.M), world_from_object: found.M,
    wrong: scaled(W, 1 / (norm(W) || 1)), right: scaled(found.right, 1 / (norm(found.right) || 1)), whole, two_sided: Number(found.isFlat),
    of_light: Number(isStuck), is_near: near, light, stuck_light: (isStuck && side === "wrong" && stuck) || light,
  };
  return { mesh: found.mesh, pair: MAP, uniforms, isFlat: found.isFlat };
}
