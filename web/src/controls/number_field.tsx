import { useId, useRef, useState } from "preact/hooks";
import { useGesture } from "./gesture";
import { clampTo, readNumber, showNumber, stepFor, tidy } from "./number";
import { resetKey } from "./reset_key";

export interface NumberBoxProps {
  label: string;
  value: number;
  min?: number | undefined;
  max?: number | undefined;
  step?: number | undefined;
  whole?: boolean | undefined;
  /** What is shown is the default. */
  standard?: boolean | undefined;
  id?: string | undefined;
  disabled?: boolean | undefined;
  onChange(value: number, gesture: string): void;
}

/** A number that is typed, stepped with the arrow keys (Shift: ten steps, Alt: a tenth), or scrubbed by dragging sideways. */
export function NumberBox({ label, value, min, max, step, whole, standard, id, disabled, onChange }: NumberBoxProps) {
  const [draft, setDraft] = useState<string | null>(null);
  const gesture = useGesture(label);
  const drag = useRef<{ x: number; value: number; unit: number; moved: boolean } | null>(null);
  const unit = step ?? (whole ? 1 : stepFor(value));
  const limited = (next: number, by: number) => clampTo(whole ? Math.round(next) : tidy(next, by), min, max);
  const change = (next: number, by = unit) => {
    const good = limited(next, by);
    if (good !== value) onChange(good, gesture.current());
  };
  const commit = () => {
    const typed = draft === null ? null : readNumber(draft);
    setDraft(null);
    gesture.next();
    if (typed !== null) change(whole ? Math.round(typed) : typed);
    gesture.next();
  };
  const endDrag = () => {
    drag.current = null;
    gesture.next();
  };
  return (
    <input
      class={`number${standard ? " standard" : ""}`}
      type="text"
      inputMode="decimal"
      role="spinbutton"
      id={id}
      disabled={disabled}
      aria-label={label}
      aria-valuenow={value}
      aria-valuemin={plain(min)}
      aria-valuemax={plain(max)}
      autocomplete="off"
      value={draft ?? showNumber(value)}
      onInput={(event) => setDraft(event.currentTarget.value)}
      onBlur={commit}
      onKeyDown={(event) => {
        if (event.key === "Enter") {
          commit();
          event.currentTarget.select();
        } else if (event.key === "Escape" && draft !== null) {
          setDraft(null);
          event.stopPropagation();
        } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
          event.preventDefault();
          const size = unit * (event.shiftKey ? 10 : event.altKey && !whole ? 0.1 : 1);
          setDraft(null);
          change((readNumber(draft ?? "") ?? value) + (event.key === "ArrowUp" ? size : -size));
        }
      }}
      onPointerDown={(event) => {
        if (event.button !== 0 || document.activeElement === event.currentTarget) return;
        // The step stays what it was when the value grows by a digit.
        drag.current = { x: event.clientX, value, unit, moved: false };
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        const from = drag.current;
        if (from === null) return;
        if ((event.buttons & 1) === 0) return endDrag();
        const distance = event.clientX - from.x;
        if (!from.moved && Math.abs(distance) < 4) return;
        if (!from.moved) {
          from.moved = true;
          event.currentTarget.blur();
        }
        change(from.value + Math.round(distance / 3) * from.unit * (event.shiftKey ? 10 : 1), from.unit);
      }}
      onPointerUp={endDrag}
      onPointerCancel={endDrag}
    />
  );
}

/** For attributes that know no exponents. */
function plain(limit: number | undefined): number | undefined {
  return limit !== undefined && /^-?\d+(\.\d+)?$/.test(String(limit)) ? limit : undefined;
}

/** A row: its name, and the number. A double click on the name takes the default, Alt+Backspace too. */
export function NumberField(props: NumberBoxProps & { unit?: string; title?: string; onReset?: () => void }) {
  const id = useId();
  return (
    <div class="row" title={props.title} onKeyDown={resetKey(props.onReset)}>
      <label for={id} onDblClick={props.onReset}>{props.label}</label>
      <span class="row-end">
        <NumberBox {...props} id={id} />
        {props.unit !== undefined && <span class="unit">{props.unit}</span>}
      </span>
    </div>
  );
}

/** A row of numbers that belong together. */
export function VectorField({ label, names, value, onChange, min, max, step, standard, onReset, title }: {
  label: string;
  names: readonly string[];
  value: readonly number[];
  min?: number;
  max?: number;
  step?: number;
  standard?: boolean;
  title?: string;
  onChange(value: number[], gesture: string): void;
  onReset?: () => void;
}) {
  return (
    <div class="row" role="group" aria-label={label} title={title} onKeyDown={resetKey(onReset)}>
      <span class="row-name" onDblClick={onReset}>{label}</span>
      <span class="row-end row-vector">
        {value.map((number, i) => (
          <NumberBox
            key={i}
            label={`${label} ${names[i]}`}
            value={number}
            min={min}
            max={max}
            step={step}
            standard={standard}
            onChange={(next, gesture) => onChange(value.map((old, k) => (k === i ? next : old)), gesture)}
          />
        ))}
      </span>
    </div>
  );
}
