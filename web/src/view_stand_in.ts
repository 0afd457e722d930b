// Stands where the view will be: says what it was given. For work on the page alone.
import type { Camera } from "./api";
import type { StudioView, ViewHost } from "./view/host";

export function createView(element: HTMLElement, host: ViewHost): StudioView {
  const place = document.createElement("div");
  place.className = "stand-in";
  const canvas = document.createElement("canvas");
  place.append(canvas);
  element.tabIndex = 0;
  element.setAttribute("role", "application");
  element.setAttribute("aria-label", "Model");
  element.append(place);
  const camera: Camera = { eye: [4, 3, 8], at: [0, 2, 0], up: [0, 1, 0], fov_deg: 45 };
  let model: Float32Array = new Float32Array(0);
  let bones = 0;
  let dark = true;
  const draw = () => {
    const width = (canvas.width = Math.max(1, place.clientWidth));
    const height = (canvas.height = Math.max(1, place.clientHeight));
    const context = canvas.getContext("2d");
    if (context === null) return;
    context.fillStyle = dark ? "#2b2f34" : "#dfe3e7";
    context.fillRect(0, 0, width, height);
    context.strokeStyle = dark ? "#7f8b97" : "#56616c";
    context.lineCap = "round";
    for (let i = 0; i < bones; ++i) {
      const at = (k: number) => model[i * 8 + k]!;
      const x = (v: number) => width / 2 + v * 60;
      const y = (v: number) => height - 60 - v * 60;
      context.lineWidth = Math.max(1, 8 - 0.5 * i);
      context.beginPath();
      context.moveTo(x(at(0)), y(at(1)));
      context.lineTo(x(at(3)), y(at(4)));
      context.stroke();
    }
  };
  const sizes = new ResizeObserver(draw);
  sizes.observe(place);
  return {
    setMeshes: () => undefined,
    setModel: (message) => {
      const start = performance.now();
      const head = new DataView(message);
      const instances = head.getUint32(12, true);
      bones = head.getUint32(16, true);
      model = new Float32Array(message.slice(32 + instances * 64, 32 + instances * 64 + bones * 32));
      draw();
      host.drawn(head.getUint32(8, true), performance.now() - start);
    },
    setCloud: () => undefined,
    setRules: () => undefined,
    setScene: () => undefined,
    setSelection: () => undefined,
    setTool: (tool) => (place.dataset["tool"] = tool),
    setBrush: () => undefined,
    setLook: (look) => {
      dark = look.dark;
      draw();
    },
    setHighlight: (highlight) => (place.dataset["rule"] = highlight.rule ?? ""),
    snap: () => undefined,
    frame: () => undefined,
    camera: () => camera,
    dispose: () => {
      sizes.disconnect();
      place.remove();
    },
  };
}
