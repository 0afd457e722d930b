import { useRef } from "preact/hooks";

export interface SplitterProps {
  label: string;
  /** Of the line itself. */
  orientation: "vertical" | "horizontal";
  /** Size of the pane before or after it, pixels. */
  size: number;
  min: number;
  max: number;
  /** +1 where the pane grows to the right or downward. */
  direction: 1 | -1;
  /** What a double click brings back. */
  standard: number;
  onSize(size: number): void;
}

/** A line between panes: dragged, or moved with the arrow keys (Shift: further); Home and End go to its limits. */
export function Splitter({ label, orientation, size, min, max, direction, standard, onSize }: SplitterProps) {
  const from = useRef<{ at: number; size: number } | null>(null);
  const limited = (next: number) => Math.round(Math.max(min, Math.min(max, next)));
  const place = (event: PointerEvent) => (orientation === "vertical" ? event.clientX : event.clientY);
  return (
    <div
      class={`splitter ${orientation}`} role="separator" tabIndex={0} aria-label={label} aria-orientation={orientation}
      aria-valuenow={Math.round(size)} aria-valuemin={min} aria-valuemax={Math.round(max)}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        from.current = { at: place(event), size };
      }}
      onPointerMove={(event) => {
        if (from.current !== null) onSize(limited(from.current.size + direction * (place(event) - from.current.at)));
      }}
      onPointerUp={() => (from.current = null)}
      onPointerCancel={() => (from.current = null)}
      onDblClick={() => onSize(limited(standard))}
      onKeyDown={(event) => {
        const forward = orientation === "vertical" ? "ArrowRight" : "ArrowDown";
        const back = orientation === "vertical" ? "ArrowLeft" : "ArrowUp";
        const step = (event.shiftKey ? 64 : 16) * direction;
        if (event.key === forward) onSize(limited(size + step));
        else if (event.key === back) onSize(limited(size - step));
        else if (event.key === "Home") onSize(limited(min));
        else if (event.key === "End") onSize(limited(max));
        else return;
        event.preventDefault();
      }}
    />
  );
}
