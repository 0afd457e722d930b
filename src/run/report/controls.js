// How a person moves the view: mouse, touch and keys.
"use strict";
const viewerControls = (canvas, camera, move, home, heightInView) => {
  const fingers = new Map();
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return {apart: Math.hypot(a.x - b.x, a.y - b.y) || 1, x: (a.x + b.x) / 2, y: (a.y + b.y) / 2};
  };
  const pan = (dx, dy) => {
    const size = heightInView() / canvas.clientHeight;
    move({aside: camera.aside - dx * size, up: camera.up + dy * size});
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({preventScroll: true});
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    page.busy = true;
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    const before = fingers.size === 2 ? spread() : null;
    fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (before) {
      const now = spread();
      move({zoom: camera.zoom * before.apart / now.apart});
      pan(now.x - before.x, now.y - before.y);
    } else if (event.shiftKey || event.buttons & 6) {
      pan(dx, dy);
    } else {
      move({azimuth: (camera.azimuth - 0.4 * dx) % 360, elevation: camera.elevation + 0.4 * dy});
    }
  });
  const end = (event) => {
    fingers.delete(event.pointerId);
    page.busy = fingers.size > 0;
  };
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) canvas.addEventListener(name, end);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => move(home));
  // The wheel scrolls the page until a person has chosen the view.
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : 1);
    move({zoom: camera.zoom * Math.exp(Math.min(Math.max(pixels, -200), 200) * 0.0015)});
  }, {passive: false});
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 15 : 5;
    const moves = {
      ArrowLeft: {azimuth: camera.azimuth - step}, ArrowRight: {azimuth: camera.azimuth + step},
      ArrowUp: {elevation: camera.elevation + step}, ArrowDown: {elevation: camera.elevation - step},
      "+": {zoom: camera.zoom / 1.15}, "=": {zoom: camera.zoom / 1.15}, "-": {zoom: camera.zoom * 1.15},
      "0": home, Home: home,
    };
    if (!moves[event.key]) return;
    event.preventDefault();
    move(moves[event.key]);
  });
};
