import { useId } from "preact/hooks";
import { useGesture } from "./gesture";
import { fromLog, toLog } from "./number";
import { NumberBox } from "./number_field";
import { resetKey } from "./reset_key";

export interface SliderProps {
  label: string;
  value: number;
  min: number;
  max: number;
  step?: number | undefined;
  whole?: boolean | undefined;
  logarithmic?: boolean;
  unit?: string | undefined;
  title?: string | undefined;
  standard?: boolean | undefined;
  disabled?: boolean | undefined;
  /** Instead of a field for the number. */
  words?: string | undefined;
  onChange(value: number, gesture: string): void;
  onReset?: (() => void) | undefined;
}

/** A row of name, slider and number. A double click on the name or the slider takes the default. */
export function Slider(props: SliderProps) {
  const { label, value, min, max, step, logarithmic, unit, words, onChange, onReset } = props;
  const id = useId();
  const gesture = useGesture(label);
  const place = logarithmic ? toLog(Math.min(max, Math.max(min, value)), min, max) : value;
  return (
    <div class={`row row-slider${props.standard ? " standard" : ""}`} title={props.title} onKeyDown={resetKey(onReset)}>
      <label for={id} onDblClick={onReset}>{label}</label>
      <input
        type="range"
        id={id}
        min={logarithmic ? 0 : min}
        max={logarithmic ? 1 : max}
        step={logarithmic ? 0.01 : (step ?? (props.whole ? 1 : "any"))}
        value={place}
        disabled={props.disabled}
        aria-valuetext={words ?? `${value}${unit ? ` ${unit}` : ""}`}
        onInput={(event) => {
          const next = Number(event.currentTarget.value);
          onChange(logarithmic ? fromLog(next, min, max) : next, gesture.current());
        }}
        onPointerDown={() => gesture.next()}
        onPointerUp={() => gesture.next()}
        onBlur={() => gesture.next()}
        onDblClick={onReset}
      />
      <span class="slider-end">
        {words === undefined ? (
          <NumberBox label={`${label}, number`} value={value} min={min} max={max} step={step} whole={props.whole} disabled={props.disabled} onChange={onChange} />
        ) : (
          <span class="slider-words">{words}</span>
        )}
        {unit !== undefined && <span class="unit">{unit}</span>}
      </span>
    </div>
  );
}
