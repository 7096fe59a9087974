([size, times, background, bodies]) => {
  const [width, height] = size.map((side) => side * times);
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const gl = canvas.getContext("webgl2", { antialias: false, depth: true, alpha: false });
  const said = [];
  const floats = (text) => new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  function linked(body) {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, body.vertex_shader], [gl.FRAGMENT_SHADER, body.fragment_shader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) said.push(gl.getShaderInfoLog(shader));
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) said.push(gl.getProgramInfoLog(program));
    return program;
  }
  const SETTERS = {
    [gl.FLOAT]: (at, v) => gl.uniform1f(at, v), [gl.FLOAT_VEC2]: (at, v) => gl.uniform2fv(at, v),
    [gl.FLOAT_VEC3]: (at, v) => gl.uniform3fv(at, v), [gl.FLOAT_VEC4]: (at, v) => gl.uniform4fv(at, v),
    [gl.FLOAT_MAT3]: (at, v) => gl.uniformMatrix3fv(at, true, v.flat()),
    [gl.FLOAT_MAT4]: (at, v) => gl.uniformMatrix4fv(at, true, v.flat()),
  };
  function bind(unit, kind, image) {
    gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(kind, gl.createTexture());
    if (image.layers) gl.texImage3D(kind, 0, gl.R32F, ...image.size, image.layers, 0, gl.RED, gl.FLOAT, floats(image.floats));
    else gl.texImage2D(kind, 0, gl[image.format], ...image.size, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes(image.bytes));
    const filter = image.filter === "linear" ? gl.LINEAR : gl.NEAREST;
    gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, filter); gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, filter);
    const [s, t] = image.wrap || ["CLAMP_TO_EDGE", "CLAMP_TO_EDGE"];
    gl.texParameteri(kind, gl.TEXTURE_WRAP_S, gl[s]); gl.texParameteri(kind, gl.TEXTURE_WRAP_T, gl[t]);
  }
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  for (const [place, format] of [[gl.COLOR_ATTACHMENT0, gl[bodies[0].target]], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24]]) {
    const buffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer); gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
  }
  gl.viewport(0, 0, width, height);
  gl.clearColor(...background, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST); gl.disable(gl.DITHER);
  for (const body of bodies) {
    const program = linked(body);
    if (said.length) break;
    gl.useProgram(program);
    (body.cull_face ? gl.enable : gl.disable).call(gl, gl.CULL_FACE);
    if (body.cull_face) gl.cullFace(gl[body.cull_face.toUpperCase()]);
    gl.frontFace(body.front_face === "cw" ? gl.CW : gl.CCW);
    (body.is_clear ? gl.enable : gl.disable).call(gl, gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    let unit = 0;
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name, type, size } = gl.getActiveUniform(program, i), at = gl.getUniformLocation(program, name);
      const kind = { [gl.SAMPLER_2D]: gl.TEXTURE_2D, [gl.SAMPLER_2D_ARRAY]: gl.TEXTURE_2D_ARRAY }[type];
      if (kind) { bind(unit, kind, body.images[name]); gl.uniform1i(at, unit++); continue; }
      for (let k = 0; k < size; k++) {  // the name of an array is that of its first element
        const element = name.replace("[0]", `[${k}]`);
        if (body.uniforms[element] === undefined) said.push("no value of " + element);
        else SETTERS[type](gl.getUniformLocation(program, element), body.uniforms[element]);
      }
    }
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES); i++) {
      const { name } = gl.getActiveAttrib(program, i), at = gl.getAttribLocation(program, name);
      if (!body.attributes[name]) { said.push("no attribute " + name); continue; }
      const [width, values] = body.attributes[name];
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, floats(values), gl.STATIC_DRAW);
      gl.enableVertexAttribArray(at); gl.vertexAttribPointer(at, width, gl.FLOAT, false, 0, 0);
    }
    gl.drawArrays(gl.TRIANGLES, 0, body.corners);
    for (let i = 0; i < 16; i++) gl.disableVertexAttribArray(i);
  }
  // The middle pixel of each block stands where the one pixel of a smaller picture does.
  const all = new Uint8Array(width * height * 4), pixels = new Uint8Array(size[0] * size[1] * 4);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
  const middle = (times - 1) / 2;
  for (let y = 0, at = 0; y < size[1]; y++) for (let x = 0; x < size[0]; x++, at += 4) {
    const from = ((y * times + middle) * width + x * times + middle) * 4;
    pixels.set(all.subarray(from, from + 4), at);
  }
  const error = gl.getError();
  if (error) said.push("GL error " + error);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  let text = "";
  for (let i = 0; i < pixels.length; i += 32768) text += String.fromCharCode(...pixels.subarray(i, i + 32768));
  return { said, pixels: btoa(text) };
}
