// Two or three parents mixed: a point on a triangle says how much of each.
import { useRef } from "preact/hooks";
import { Icon } from "../controls/icons";
import { IconButton } from "../controls/fields";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { corners, pointOf, weightsAt } from "./barycentric";

export function BlendPanel() {
  const { room } = useStudio();
  const { parents, weights } = room.state.blend.value;
  return (
    <section class="blend room-pad" aria-label="Blend">
      <p class="hint">{parents.length === 0
        ? "Pick two or three models in the grid: select one and press X, or use Blend in its actions."
        : parents.length === 1 ? "Pick one or two more." : "Drag the point: the blend stands beside the grid. It is kept with the button below it."}</p>
      <ul class="blend-parents">
        {parents.map((id, i) => (
          <li key={id}>
            <span class="cell-corner" data-text={"ABC"[i]} />
            <button type="button" class="text-button" onClick={() => room.lookAtAncestor(id)}>Model {id}</button>
            <span class="cell-space" />
            <span class="dim">{Math.round(100 * weights[i]!)} %</span>
            <IconButton label={`Not of ${id}`} kind="small" onClick={() => room.toggleParent(id)}><Icon name="close" /></IconButton>
          </li>
        ))}
      </ul>
      {parents.length >= 2 && (
        <>
          <Triangle weights={weights} />
          {parents.map((id, i) => (
            <Slider key={id} label={`${"ABC"[i]}: ${id}`} value={weights[i]!} min={0} max={1} step={0.01} words={`${Math.round(100 * weights[i]!)} %`} onChange={(value) => room.nudge(i, value - weights[i]!)} />
          ))}
          <button type="button" class="button primary" disabled={room.state.waiting.value !== null} onClick={() => void room.keepBlend()}><Icon name="plus" />Keep the blend</button>
        </>
      )}
    </section>
  );
}

const kSide = 240, kRound = 9;

/** Arrow keys move the point as well; the sliders below say the same in numbers. */
function Triangle({ weights }: { weights: readonly number[] }) {
  const { room } = useStudio();
  const element = useRef<SVGSVGElement>(null);
  const held = useRef(false);
  const at = corners(weights.length);
  const high = weights.length === 2 ? 70 : 216;
  const scaled = (p: { x: number; y: number }) => ({ x: p.x * kSide, y: weights.length === 2 ? high / 2 : p.y * kSide });
  const point = scaled(pointOf(weights, at));
  const move = (event: PointerEvent) => {
    const box = element.current!.getBoundingClientRect();
    room.weigh(weightsAt({ x: (event.clientX - box.left) / box.width, y: weights.length === 2 ? 0.5 : (event.clientY - box.top) / box.width }, at));
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const step = steps[event.key];
    if (step === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const p = pointOf(weights, at), much = event.shiftKey ? 0.1 : 0.02;
    room.weigh(weightsAt({ x: p.x + much * step[0], y: p.y + much * step[1] }, at));
  };
  const names = weights.map((weight, i) => `${"ABC"[i]} ${Math.round(100 * weight)} %`).join(", ");
  return (
    <div
      class="blend-triangle" role="slider" tabIndex={0} aria-label="How much of each parent" aria-valuenow={Math.round(100 * weights[0]!)} aria-valuemin={0} aria-valuemax={100}
      aria-valuetext={names} onKeyDown={onKeyDown}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        held.current = true;
        move(event);
      }}
      onPointerMove={(event) => held.current && move(event)}
      onPointerUp={() => (held.current = false)}
      onPointerCancel={() => (held.current = false)}
    >
      <svg ref={element} viewBox={`0 0 ${kSide} ${high}`} aria-hidden="true">
        <polygon class="blend-face" points={at.map(scaled).map((p) => `${p.x},${p.y}`).join(" ")} />
        {at.map(scaled).map((p, i) => <line key={i} class="blend-pull" x1={p.x} y1={p.y} x2={point.x} y2={point.y} style={{ strokeWidth: `${0.5 + 3 * weights[i]!}px` }} />)}
        {at.map(scaled).map((p, i) => (
          <g key={i}>
            <circle class="blend-corner" cx={p.x} cy={p.y} r={kRound} />
            <text x={p.x} y={p.y + 4}>{"ABC"[i]}</text>
          </g>
        ))}
        <circle class="blend-point" cx={point.x} cy={point.y} r={8} />
      </svg>
    </div>
  );
}
