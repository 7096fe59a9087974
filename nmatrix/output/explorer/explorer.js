"use strict";
// Everything is double precision and mirrors nmatrix: column vectors, M = T·R·S·H with
// R = Rx·Ry·Rz, matrices as arrays of rows.
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

// --- Small matrices -------------------------------------------------------------------------
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const transpose = (A) => A[0].map((_, j) => A.map((row) => row[j]));
const times = (A, B) => { const columns = transpose(B); return A.map((row) => columns.map((c) => dot(row, c))); };
const apply = (A, v) => A.map((row) => dot(row, v));
const linear = (M) => M.slice(0, 3).map((row) => row.slice(0, 3));
const affine = (A, t) => [...A.map((row, i) => [...row, t[i]]), [0, 0, 0, 1]];
const cofactor = (A) => [cross(A[1], A[2]), cross(A[2], A[0]), cross(A[0], A[1])];
const determinant = (A) => dot(A[0], cross(A[1], A[2]));
const scaled = (A, s) => A.map((row) => row.map((x) => x * s));
const inverse3 = (A) => scaled(transpose(cofactor(A)), 1 / determinant(A));
const inverse4 = (M) => { const A = inverse3(linear(M)); return affine(A, apply(A, M.slice(0, 3).map((row) => -row[3]))); };
const unit = (v) => { const long = Math.hypot(...v); return long ? v.map((x) => x / long) : v; };
const identity4 = affine([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0]);

// Exact at quarter turns, where a sine of floats would leave 6e-17.
function turn(degrees) {
  const d = ((degrees % 360) + 360) % 360;
  if (d % 90 === 0) return [[0, 1, 0, -1][d / 90], [1, 0, -1, 0][d / 90]];
  return [Math.sin((d * Math.PI) / 180), Math.cos((d * Math.PI) / 180)];
}
function rotation(x, y, z) {
  const [sx, cx] = turn(x), [sy, cy] = turn(y), [sz, cz] = turn(z);
  return times(times([[1, 0, 0], [0, cx, -sx], [0, sx, cx]], [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]),
    [[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]);
}
function worldMatrix(s) {
  const scale = ["x", "y", "z"].map((axis) => s["s" + axis] * (s["m" + axis] ? -1 : 1));
  const D = [[scale[0], 0, 0], [0, scale[1], 0], [0, 0, scale[2]]];
  const H = [[1, s.hxy, s.hxz], [0, 1, s.hyz], [0, 0, 1]];
  return affine(times(times(rotation(s.rx, s.ry, s.rz), D), H), data.translate);
}
function lookingAlong(eye, forward) {
  let right = cross(forward, data.up);
  if (!right.some((x) => x)) {
    const axis = Math.abs(forward[2]) <= Math.abs(forward[1]) ? 2 : 1;
    right = cross(forward, [0, 1, 2].map((i) => Number(i === axis)));
    if (right.find((x) => x) < 0) right = right.map((x) => -x);
  }
  const rows = [right, cross(right, forward), forward.map((x) => -x)].map(unit);
  return affine(rows, rows.map((row) => -dot(row, eye)));
}

// --- The meshes, by the formulas of nmatrix's own shapes ---------------------------------------
function grid(rings, sectors, at) {
  const positions = [], normals = [], triangles = [];
  for (let i = 0; i <= rings; i++) for (let j = 0; j <= sectors; j++) {
    const [p, n] = at(i / rings, ((j % sectors) / sectors) * 2 * Math.PI);
    positions.push(...p); normals.push(...n);
  }
  for (let i = 0; i < rings; i++) for (let j = 0; j < sectors; j++) {
    const a = i * (sectors + 1) + j, b = a + sectors + 1;
    triangles.push(a, a + 1, b, b, a + 1, b + 1);
  }
  return { positions, normals, triangles };
}
const MESHES = {
  sphere: () => grid(data.tessellation[0], data.tessellation[1], (u, around) => {
    const out = u === 1 ? 0 : Math.sin(u * Math.PI);
    const p = [out * Math.cos(around), Math.cos(u * Math.PI), out * Math.sin(around)];
    return [p, p];
  }),
  torus: () => grid(data.tessellation[0], data.tessellation[1], (u, around) => {
    const [s, c] = u === 1 ? [0, 1] : [Math.sin(u * 2 * Math.PI), Math.cos(u * 2 * Math.PI)];
    const out = [Math.cos(around), 0, Math.sin(around)];
    const n = [s * out[0], c, s * out[2]].map((x, k) => (k === 1 ? c : x));
    return [[out[0] + 0.4 * n[0], 0.4 * n[1], out[2] + 0.4 * n[2]], n];
  }),
};

// --- State: in the controls and in the address ------------------------------------------------
const NUMBERS = Object.keys(data.start).filter((key) => typeof data.start[key] === "number");
const CHOICES = { space: Object.keys(data.shaders), rule: Object.keys(data.rules), shape: Object.keys(MESHES) };
let state = { ...data.start };
function readHash() {
  state = { ...data.start };
  for (const part of location.hash.slice(1).split("&")) {
    const [key, value = ""] = part.split("=");
    if (NUMBERS.includes(key) && value !== "" && Number.isFinite(Number(value)) && Math.abs(Number(value)) < 1e6) state[key] = Number(value);
    if (CHOICES[key] && CHOICES[key].includes(value)) state[key] = value;
  }
}
function writeHash() {
  const changed = Object.keys(state).filter((key) => state[key] !== data.start[key]);
  history.replaceState(null, "", "#" + changed.map((key) => `${key}=${state[key]}`).join("&"));
}

// --- What the state means ----------------------------------------------------------------------
function ruleMatrix(rule, B) {
  const det = determinant(B);
  if (rule === "none") return B;
  if (rule === "cofactor") return cofactor(B);
  if (rule === "not-inverted") return transpose(B);
  if (rule === "not-transposed") return det === 0 ? null : inverse3(B);
  return det === 0 ? cofactor(B) : scaled(cofactor(B), 1 / det);
}
function spaceFromWorld(space, M, light) {
  if (space === "camera") return data.camera_from_world;
  if (space === "object") return determinant(linear(M)) === 0 ? null : inverse4(M);
  if (space === "light") return lookingAlong(data.light_position || [0, 0, 0], light);
  return identity4;
}
function meaning() {
  const M = worldMatrix(state), A = linear(M), light = [state.lx, state.ly, state.lz];
  return { M, A, light, det: determinant(A), C: cofactor(A), N: determinant(A) === 0 ? null : ruleMatrix("exact", A), S: spaceFromWorld(state.space, M, light) };
}
function angles(mesh, A, W) {
  let largest = 0, sum = 0, count = 0;
  const sign = determinant(A) < 0 ? -1 : 1, right = scaled(cofactor(A), sign);
  for (let i = 0; i < mesh.normals.length; i += 3) {
    const n = mesh.normals.slice(i, i + 3), a = apply(W, n), b = apply(right, n);
    if (!b.some((x) => x) || !a.some((x) => x)) continue;
    const angle = (Math.atan2(Math.hypot(...cross(a, b)), dot(a, b)) * 180) / Math.PI;
    largest = Math.max(largest, angle); sum += angle; count += 1;
  }
  return { largest, mean: count ? sum / count : 0 };
}

// --- Drawing, with the shaders as nmatrix prints them ----------------------------------------
const SETTERS = { mat4: "uniformMatrix4fv", mat3: "uniformMatrix3fv", vec3: "uniform3fv", float: "uniform1f" };
const flat = (A) => transpose(A).flat();
class View {
  constructor(canvas) {
    this.gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
    this.programs = {}; this.buffers = {}; this.errors = [];
  }
  program(space) {
    if (!this.programs[space]) {
      const gl = this.gl, program = gl.createProgram(), pair = data.shaders[space];
      for (const [kind, text] of [[gl.VERTEX_SHADER, pair.vertex], [gl.FRAGMENT_SHADER, pair.fragment]]) {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, text); gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) this.errors.push(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
      }
      gl.bindAttribLocation(program, 0, "vertex_position"); gl.bindAttribLocation(program, 1, "vertex_normal");
      gl.linkProgram(program);
      if (!gl.getProgramParameter(program, gl.LINK_STATUS)) this.errors.push(gl.getProgramInfoLog(program));
      this.programs[space] = program;
    }
    return this.programs[space];
  }
  upload(name, values, kind) {
    const gl = this.gl;
    this.buffers[name] ??= gl.createBuffer();
    gl.bindBuffer(kind, this.buffers[name]); gl.bufferData(kind, values, gl.DYNAMIC_DRAW);
  }
  // What is flattened has both sides in one place: only those that are turned to the eye are drawn.
  draw(mesh, uniforms, space, isFlattened) {
    const gl = this.gl, program = this.program(space);
    gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
    gl.clearColor(...data.background, 1); gl.enable(gl.DEPTH_TEST);
    (isFlattened ? gl.enable : gl.disable).call(gl, gl.CULL_FACE);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!uniforms) return;
    gl.useProgram(program);
    for (const [place, name] of [[0, "positions"], [1, "normals"]]) {
      this.upload(name, new Float32Array(mesh[name]), gl.ARRAY_BUFFER);
      gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    }
    this.upload("triangles", new Uint16Array(mesh.triangles), gl.ELEMENT_ARRAY_BUFFER);
    for (const [name, kind] of data.shaders[space].uniforms) {
      const at = gl.getUniformLocation(program, name), value = uniforms[name];
      if (kind.startsWith("mat")) gl[SETTERS[kind]](at, false, flat(value));
      else gl[SETTERS[kind]](at, value);
    }
    gl.drawElements(gl.TRIANGLES, mesh.triangles.length, gl.UNSIGNED_SHORT, 0);
    const error = gl.getError();
    if (error) this.errors.push("GL error " + error);
  }
}
function uniformsFor(found, normalMatrix) {
  const S = found.S, B = linear(S), VP = times(data.clip_from_camera, data.camera_from_world);
  return {
    ...data.constants,
    clip_from_object: state.space === "static" ? VP : times(VP, found.M),
    space_from_object: times(S, found.M),
    normal_matrix: normalMatrix,
    light_direction: apply(B, unit(found.light)),
    light_position: data.light_position && apply(S, [...data.light_position, 1]).slice(0, 3),
    eye: state.space === "camera" ? [0, 0, 0] : apply(S, [...data.eye, 1]).slice(0, 3),
    vector_world_from_space: state.space === "object" ? found.A : inverse3(B),
    normal_world_from_space: transpose(B),
  };
}
function baked(mesh, M, W) {
  const move = (values, to) => { const out = []; for (let i = 0; i < values.length; i += 3) out.push(...to(values.slice(i, i + 3))); return out; };
  return { ...mesh, positions: move(mesh.positions, (p) => apply(M, [...p, 1]).slice(0, 3)), normals: move(mesh.normals, (n) => unit(apply(W, n))) };
}

// --- The page -------------------------------------------------------------------------------
const views = {};
let meshes = {};
const shown = (x) => (Object.is(x, -0) ? 0 : x).toPrecision(5).replace(/\.?0+$/, "").replace(/\.?0+e/, "e").replace("-", "−");
function matrixTable(name, A) {
  if (!A) return `<div class="matrix"><span>${name} does not exist</span></div>`;
  const rows = A.map((row) => `<tr>${row.map((x) => `<td>${shown(x)}</td>`).join("")}</tr>`).join("");
  return `<div class="matrix"><span>${name} =</span><table aria-label="${name}">${rows}</table></div>`;
}
function verdict(found, size, W) {
  if (state.space === "object") return "In object space normals stay as they are: there is no normal matrix to get wrong. Light and eye move instead.";
  if (!W) return "A is singular, so this rule has no answer. The cofactors still know the plane's normal, with two sides.";
  if (size.largest < 1e-9) return "Both are the same here: with this A nobody can tell the rules apart.";
  const flip = found.det < 0 ? " A mirrors: det A is negative." : found.det === 0 ? " A flattens: the plane's two sides are alike." : "";
  return `The wrong normals are up to ${size.largest.toFixed(2)}° off, ${size.mean.toFixed(2)}° on average.${flip}`;
}
function command(found) {
  const scale = ["x", "y", "z"].map((axis) => state["s" + axis] * (state["m" + axis] ? -1 : 1));
  const words = [`nmatrix space ${state.space}`, `--scale ${scale.join(" ")}`, `--rotate ${state.rx} ${state.ry} ${state.rz}`,
    `--shear ${state.hxy} ${state.hxz} ${state.hyz}`];
  if (data.translate.some((x) => x)) words.push(`--translate ${data.translate.join(" ")}`);
  if (data.has_direction) words.push(`--light-direction ${found.light.join(" ")}`);
  return words.concat(data.options).join(" ");
}
function update() {
  const found = meaning(), mesh = (meshes[state.shape] ??= MESHES[state.shape]());
  const W = ruleMatrix(state.rule, found.A), size = W ? angles(mesh, found.A, W) : { largest: 0, mean: 0 };
  byId("verdict").textContent = verdict(found, size, W);
  byId("wrong-name").textContent = data.rules[state.rule];
  byId("right-name").textContent = found.N ? "the inverse transpose" : "the cofactors, since A⁻ᵀ does not exist";
  byId("shader").textContent = glsl();
  byId("numbers").innerHTML = matrixTable("A", found.A) + matrixTable("A⁻ᵀ", found.N) + matrixTable("cofactors", found.C) + `<div class="matrix">det A = ${shown(found.det)}</div>`;
  byId("command").textContent = command(found);
  for (const side of ["wrong", "right"]) {
    const canvas = byId(side), view = views[side];
    canvas.setAttribute("aria-label", side === "wrong" ? `The mesh lit by normals carried by ${data.rules[state.rule]}: ${byId("verdict").textContent}` : "The mesh lit by the right normals.");
    if (!view || !view.gl) continue;
    const rule = side === "wrong" ? state.rule : "exact";
    let uniforms = null, drawn = mesh;
    if (found.S) {
      const B = linear(times(found.S, found.M)), N = ruleMatrix(rule, B);
      if (N) {
        // A mirror's cofactors over a negative determinant point outwards; alone they do not.
        uniforms = uniformsFor(found, N);
        if (state.space === "static") drawn = baked(mesh, found.M, ruleMatrix(rule, found.A));
      }
    }
    view.draw(drawn, uniforms, state.space, found.det === 0);
  }
  byId("state").textContent = JSON.stringify({ A: found.A, N: found.N, C: found.C, det: found.det, ...size, errors: Object.values(views).flatMap((view) => view.errors) });
}
function control(key, label, range) {
  const row = document.createElement("div");
  row.className = "row";
  row.innerHTML = `<label for="${key}">${label}</label><input type="range" id="${key}" min="${range[0]}" max="${range[1]}" step="${range[2]}"><input type="number" id="${key}-n" step="any" aria-label="${label} as a number">`;
  const [slider, number] = row.querySelectorAll("input");
  for (const input of [slider, number]) input.addEventListener("input", () => {
    const value = Number(input.value);
    if (input.value !== "" && Number.isFinite(value)) { state[key] = value; changed(input); }
  });
  return row;
}
function choice(key, label, options) {
  const row = document.createElement("div");
  row.className = "choice";
  row.innerHTML = `<label for="${key}">${label}</label><select id="${key}">${Object.entries(options).map(([value, text]) => `<option value="${value}">${text}</option>`).join("")}</select>`;
  row.querySelector("select").addEventListener("change", (event) => { state[key] = event.target.value; changed(event.target); });
  return row;
}
function build() {
  const form = byId("controls");
  const spaces = Object.fromEntries(CHOICES.space.map((space) => [space, space + " space"]));
  form.append(choice("rule", "Wrong rule", data.rules), choice("space", "Shading in", spaces), choice("shape", "Mesh", { torus: "torus", sphere: "sphere" }));
  const groups = [["Scale", "s", ["x", "y", "z"], [0, 4, 0.05]], ["Rotation (°)", "r", ["x", "y", "z"], [-180, 180, 1]], ["Shear", "h", ["xy", "xz", "yz"], [-2, 2, 0.05]]];
  if (data.has_direction) groups.push(["Light travels along", "l", ["x", "y", "z"], [-3, 3, 0.05]]);
  for (const [title, letter, names, range] of groups) {
    const group = document.createElement("fieldset");
    group.innerHTML = `<legend>${title}</legend>`;
    for (const name of names) group.append(control(letter + name, name, range));
    form.append(group);
    if (letter !== "s") continue;
    const checks = document.createElement("fieldset");
    checks.className = "checks";
    checks.innerHTML = "<legend>Mirror</legend>" + ["x", "y", "z"].map((axis) => `<label><input type="checkbox" id="m${axis}"> ${axis}</label>`).join("");
    checks.addEventListener("change", (event) => { state[event.target.id] = Number(event.target.checked); changed(event.target); });
    form.append(checks);
  }
}
function fill(except) {
  for (const [key, value] of Object.entries(state)) {
    for (const input of [byId(key), byId(key + "-n")]) {
      if (!input || input === except) continue;
      if (input.type === "checkbox") input.checked = Boolean(value); else input.value = value;
    }
  }
}
function changed(input) { fill(input); writeHash(); update(); }
async function copy(text, what) {
  try { await navigator.clipboard.writeText(text); byId("said").textContent = `${what} copied.`; }
  catch { byId("said").textContent = `This browser does not let a page copy; the ${what} is in the page's source.`; }
}
function glsl() { const pair = data.shaders[state.space]; return `${pair.vertex}// ---- fragment shader ----\n${pair.fragment}`; }

build(); readHash();
for (const side of ["wrong", "right"]) views[side] = new View(byId(side));
byId("no-gl").hidden = Boolean(views.right.gl);
if (!views.right.gl) for (const figure of document.querySelectorAll("figure canvas")) figure.hidden = true;
byId("copy-glsl").addEventListener("click", () => copy(glsl(), "GLSL"));
byId("copy-command").addEventListener("click", () => copy(byId("command").textContent, "command"));
byId("reset").addEventListener("click", () => { state = { ...data.start }; changed(null); });
byId("print").addEventListener("click", () => window.print());
window.addEventListener("hashchange", () => { readHash(); fill(null); update(); });
window.addEventListener("beforeprint", () => {
  for (const side of ["wrong", "right"]) {
    const canvas = byId(side), image = canvas.parentElement.querySelector("img") || new Image();
    image.className = "drawn"; image.alt = canvas.getAttribute("aria-label"); image.src = canvas.toDataURL();
    canvas.after(image);
  }
  byId("pictures").classList.add("printed");
});
window.addEventListener("afterprint", () => byId("pictures").classList.remove("printed"));
fill(null); update();
