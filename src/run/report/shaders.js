// Shaders, and the shadow that the model throws on the ground: its height seen from below, made soft.
"use strict";
const shaders = {};

shaders.model = [`#version 300 es
uniform mat4 clip_from_model;
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec4 surface;
out vec3 place, side;
out vec4 paint, look;
void main() {
  place = position; side = normal.xyz; paint = vec4(color.rgb * color.rgb, color.a); look = surface;
  gl_Position = clip_from_model * vec4(position, 1.0);
}`, `#version 300 es
precision highp float;
uniform vec3 eye, key;
uniform bool ghost;
in vec3 place, side;
in vec4 paint, look;
out vec4 pixel;
vec3 sky(float up) { return mix(vec3(0.27, 0.265, 0.26), vec3(0.50, 0.54, 0.60), smoothstep(-0.6, 1.0, up)); }
void main() {
  vec3 v = normalize(eye - place), n = normalize(side);
  if (dot(n, v) < 0.0) n = -n;
  if (ghost) {
    float grazing = 1.0 - abs(dot(n, v));
    float alpha = 0.10 + 0.5 * grazing * grazing * grazing;
    pixel = vec4(vec3(0.30, 0.56, 0.95) * (0.95 + 0.15 * n.y) * alpha, alpha);
    return;
  }
  float lit = max(dot(n, key), 0.0), rough = max(look.x, 0.08), metal = look.y;
  vec3 half_way = normalize(key + v);
  float power = 2.0 / (rough * rough * rough * rough) - 1.0;
  float shine = pow(max(dot(n, half_way), 0.0), power) * (power + 2.0) / 8.0 * lit;
  vec3 mirrored = mix(vec3(0.04), paint.rgb, metal);
  vec3 fresnel = mirrored + (1.0 - rough) * (1.0 - mirrored) * pow(1.0 - max(dot(n, v), 0.0), 5.0);
  vec3 light = paint.rgb * (1.0 - metal) * (1.1 * sky(n.y) + vec3(0.94, 0.89, 0.82) * lit);
  light += fresnel * (1.2 * sky(reflect(-v, n).y) + vec3(0.94, 0.89, 0.82) * min(shine, 4.0));
  light += paint.rgb * look.z * 4.0;
  vec3 shown = mix(12.92 * light, 1.055 * pow(max(light, vec3(1e-5)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
  pixel = vec4(clamp(shown, 0.0, 1.0) * paint.a, paint.a);
}`];

// Height above the ground, from straight below: 1 touches it, 0 is at the top.
shaders.height = [`#version 300 es
uniform vec3 frame;  // of the ground: half width, height of the ground, height of the top
layout(location = 0) in vec3 position;
out float near;
void main() {
  float up = (position.y - frame.y) / max(frame.z - frame.y, 1e-4);
  near = 1.0 - up;
  gl_Position = vec4(position.x / frame.x, position.z / frame.x, 2.0 * up - 1.0, 1.0);
}`, `#version 300 es
precision highp float;
in float near;
out vec4 pixel;
void main() { pixel = vec4(vec3(0.0), 0.25 + 0.75 * near * near); }`];

shaders.blur = [`#version 300 es
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  at = corner;
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}`, `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec2 stride;
in vec2 at;
out vec4 pixel;
void main() {
  float sum = 0.0, weights = 0.0;
  for (int i = -12; i <= 12; ++i) {
    float w = exp(-float(i * i) / 60.0);
    sum += w * texture(image, at + float(i) * stride).a;
    weights += w;
  }
  pixel = vec4(0.0, 0.0, 0.0, sum / weights);
}`];

shaders.ground = [`#version 300 es
uniform mat4 clip_from_model;
uniform vec3 frame;
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  at = corner;
  vec2 xz = (2.0 * corner - 1.0) * frame.x;
  gl_Position = clip_from_model * vec4(xz.x, frame.y - 0.002, xz.y, 1.0);
}`, `#version 300 es
precision highp float;
uniform sampler2D image;
in vec2 at;
out vec4 pixel;
void main() { pixel = vec4(0.0, 0.0, 0.0, 0.62 * texture(image, at).a); }`];

shaders.build = (gl, [vertex, fragment]) => {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error("a shader does not build: " + gl.getProgramInfoLog(program));
  }
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const name = gl.getActiveUniform(program, i).name;
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return {program, uniforms};
};

// A texture of the shadow; `draw` draws the model with the program in use.
shaders.shadow = (gl, frame, draw) => {
  const kSize = 512;
  const targets = [0, 1].map(() => {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, kSize, kSize, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
                                 [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, name, value);
    const buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return {texture, buffer};
  });
  gl.viewport(0, 0, kSize, kSize);
  gl.bindFramebuffer(gl.FRAMEBUFFER, targets[0].buffer);
  const depth = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT16, kSize, kSize);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.disable(gl.BLEND);
  gl.enable(gl.DEPTH_TEST);
  const height = shaders.build(gl, shaders.height), blur = shaders.build(gl, shaders.blur);
  gl.useProgram(height.program);
  gl.uniform3fv(height.uniforms.frame, frame);
  draw();
  gl.disable(gl.DEPTH_TEST);
  gl.useProgram(blur.program);
  for (const [from, to, stride] of [[0, 1, [1, 0]], [1, 0, [0, 1]], [0, 1, [2, 0]], [1, 0, [0, 2]]]) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets[to].buffer);
    gl.bindTexture(gl.TEXTURE_2D, targets[from].texture);
    gl.uniform2f(blur.uniforms.stride, stride[0] / kSize, stride[1] / kSize);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return targets[0].texture;
};
