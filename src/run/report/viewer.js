// The model to turn: drawn anew only when something changes. Without WebGL its picture stands there instead.
"use strict";
(() => {
  const kTan = 0.24, kMargin = 0.07;  // of the angle of view and the free border: those of best.png
  const [azimuth, elevation] = page.data.side;  // as in best.png
  const kHome = {azimuth, elevation: Math.max(-30, Math.min(89, elevation)), zoom: 1, aside: 0, up: 0};
  const holder = page.byId("viewer"), canvas = page.byId("view"), hint = page.byId("view-hint");

  const fallback = (reason) => {
    const picture = document.createElement("img");
    picture.src = document.querySelector("figure img").src;
    picture.alt = "Picture of the best model";
    holder.replaceChildren(picture);
    holder.dataset.fallback = reason;
    hint.textContent = reason + " This is its picture.";
    page.done("view");
  };

  const note = page.data.model.note;
  if (note) hint.append(document.createElement("br"), note);
  const scene = geometry.load();
  if (!scene) return fallback("There is nothing to turn: the model is empty.");
  const gl = canvas.getContext("webgl2", {antialias: true, alpha: true, preserveDrawingBuffer: true});
  if (!gl) return fallback("This browser shows no 3D here (WebGL 2 is off or missing).");

  const upload = (mesh) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const attribute = (index, data, size, type, normalized) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, size, type, normalized, 0, 0);
    };
    attribute(0, mesh.positions, 3, gl.FLOAT, false);
    attribute(1, mesh.normals, 4, gl.SHORT, true);
    attribute(2, mesh.colors, 4, gl.UNSIGNED_BYTE, true);
    attribute(3, mesh.surfaces, 4, gl.UNSIGNED_BYTE, true);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.triangles, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    return {array, count: mesh.triangles.length};
  };
  const draw = ({array, count}) => {
    if (!count) return;
    gl.bindVertexArray(array);
    gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  };

  const frame = [1.5, scene.ground, scene.top];
  let solid, clear, ghosts, paint, floor, shadow;
  const prepare = () => {
    [solid, clear, ghosts] = [upload(scene.solid), upload(scene.clear), upload(scene.ghosts)];
    paint = shaders.build(gl, shaders.model);
    floor = shaders.build(gl, shaders.ground);
    shadow = shaders.shadow(gl, frame, () => { draw(solid); draw(clear); });
  };

  const camera = Object.assign({}, kHome, page.kept.camera);
  let showTargets = page.kept.targets !== false;

  // As render/camera.cpp: as near as everything fits, for the home view.
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const axes = ({azimuth, elevation}) => {
    const a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180;
    const back = [Math.cos(e) * Math.sin(a), Math.sin(e), Math.cos(e) * Math.cos(a)];
    const right = [Math.cos(a), 0, -Math.sin(a)];
    return {back, right, up: cross(back, right)};
  };
  const tangents = () => {
    const aspect = canvas.width / canvas.height;
    return aspect >= 1 ? [kTan, kTan / aspect] : [kTan * aspect, kTan];
  };
  const fit = () => {
    const {back, right, up} = axes(kHome), inside = 1 - 2 * kMargin;
    const span = (axis, tangent) => {
      let low = Infinity, high = -Infinity;
      for (const {positions: p} of [scene.solid, scene.clear, scene.ghosts]) {
        for (let i = 0; i < p.length; i += 3) {
          const v = [p[i], p[i + 1], p[i + 2]], across = dot(axis, v), ahead = -dot(back, v);
          low = Math.min(low, across + tangent * ahead);
          high = Math.max(high, across - tangent * ahead);
        }
      }
      return [(high - low) / (2 * tangent), (high + low) / 2];
    };
    const [tx, ty] = tangents(), x = span(right, tx * inside), y = span(up, ty * inside);
    return {distance: Math.max(x[0], y[0], 0.1), target: right.map((r, k) => x[1] * r + y[1] * up[k])};
  };
  let home = null, homeAspect = 0;

  const matrix = (eye, {back, right, up}, distance) => {
    const [tx, ty] = tangents(), near = Math.max(distance - 3, distance / 100), far = distance + 6;
    const row = (axis, t) => [axis[0] / t, axis[1] / t, axis[2] / t, -dot(axis, eye) / t];
    const w = [-back[0], -back[1], -back[2], dot(back, eye)];
    const a = (far + near) / (far - near), b = -2 * far * near / (far - near);
    const z = w.map((x, k) => a * x + (k === 3 ? b : 0));
    const [x, y] = [row(right, tx), row(up, ty)];
    return [0, 1, 2, 3].flatMap((k) => [x[k], y[k], z[k], w[k]]);
  };

  const render = () => {
    const box = canvas.getBoundingClientRect(), ratio = Math.min(devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(box.width * ratio));
    canvas.height = Math.max(1, Math.round(box.height * ratio));
    if (homeAspect !== canvas.width / canvas.height) [home, homeAspect] = [fit(), canvas.width / canvas.height];
    const view = axes(camera), distance = home.distance * camera.zoom;
    const target = home.target.map((t, k) => t + camera.aside * view.right[k] + camera.up * view.up[k]);
    const eye = target.map((t, k) => t + distance * view.back[k]);
    const clip = matrix(eye, view, distance);
    const key = view.back.map((b, k) => 0.55 * (k === 1 ? 0 : b) - 0.62 * view.right[k] + (k === 1 ? 1 : 0));
    const length = Math.hypot(...key);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.useProgram(paint.program);
    gl.uniformMatrix4fv(paint.uniforms.clip_from_model, false, clip);
    gl.uniform3fv(paint.uniforms.eye, eye);
    gl.uniform3fv(paint.uniforms.key, key.map((x) => x / length));
    gl.uniform1i(paint.uniforms.ghost, 0);
    draw(solid);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    gl.useProgram(floor.program);
    gl.uniformMatrix4fv(floor.uniforms.clip_from_model, false, clip);
    gl.uniform3fv(floor.uniforms.frame, frame);
    gl.bindTexture(gl.TEXTURE_2D, shadow);
    if (camera.elevation > 0) gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.useProgram(paint.program);
    draw(clear);
    if (showTargets) {  // a little further back, so that faces that coincide with the model's do not flicker
      gl.uniform1i(paint.uniforms.ghost, 1);
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(2, 8);
      draw(ghosts);
      gl.disable(gl.POLYGON_OFFSET_FILL);
    }
    gl.depthMask(true);
  };

  let asked = false;
  const redraw = () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      if (!gl.isContextLost()) render();
    });
  };
  const move = (change) => {
    Object.assign(camera, change);
    camera.elevation = Math.min(89, Math.max(-30, camera.elevation));
    camera.zoom = Math.min(4, Math.max(0.05, camera.zoom));
    page.keep("camera", camera);
    redraw();
  };
  viewerControls(canvas, camera, move, kHome, () => home.distance * camera.zoom * 2 * tangents()[1]);

  const targets = page.byId("show-targets");
  targets.checked = showTargets;
  targets.closest("label").hidden = !scene.ghosts.triangles.length;
  targets.addEventListener("change", () => {
    showTargets = targets.checked;
    page.keep("targets", showTargets);
    redraw();
  });
  page.byId("reset-view").addEventListener("click", () => move(kHome));
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { prepare(); redraw(); });
  new ResizeObserver(redraw).observe(canvas);

  prepare();
  render();
  // Is anything there? Only what is solid covers its pixels wholly.
  const pixels = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let drawn = 0;
  for (let i = 3; i < pixels.length; i += 4) drawn += pixels[i] > 0;
  holder.dataset.drawn = drawn;
  page.done("view", drawn > 100 && !gl.getError() ? "" : "nothing was drawn");
})();
