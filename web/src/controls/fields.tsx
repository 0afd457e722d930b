import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { resetKey } from "./reset_key";

export function CheckField({ label, value, title, standard, onChange, onReset }: {
  label: string; value: boolean; title?: string | undefined; standard?: boolean; onChange(value: boolean): void; onReset?: () => void;
}) {
  const id = useId();
  return (
    <div class={`row${standard ? " standard" : ""}`} title={title} onKeyDown={resetKey(onReset)}>
      <label for={id} onDblClick={onReset}>{label}</label>
      <span class="row-end row-left">
        <input type="checkbox" id={id} checked={value} onChange={(event) => onChange(event.currentTarget.checked)} />
      </span>
    </div>
  );
}

export function ChoiceField<T extends string>({ label, value, choices, names, title, standard, onChange, onReset }: {
  label: string; value: T; choices: readonly T[]; names?: Partial<Record<T, string>>; title?: string | undefined; standard?: boolean;
  onChange(value: T): void; onReset?: () => void;
}) {
  const id = useId();
  return (
    <div class={`row${standard ? " standard" : ""}`} title={title} onKeyDown={resetKey(onReset)}>
      <label for={id} onDblClick={onReset}>{label}</label>
      <span class="row-end">
        <select id={id} value={value} onChange={(event) => onChange(event.currentTarget.value as T)}>
          {choices.map((choice) => <option key={choice} value={choice}>{names?.[choice] ?? choice}</option>)}
        </select>
      </span>
    </div>
  );
}

export function IconButton({ label, keys, pressed, disabled, onClick, children, kind, expanded }: {
  label: string; keys?: string; pressed?: boolean; disabled?: boolean; expanded?: boolean; onClick(event: MouseEvent): void;
  children: ComponentChildren; kind?: string;
}) {
  return (
    <button
      type="button"
      class={`icon-button${kind ? ` ${kind}` : ""}`}
      aria-label={label}
      aria-pressed={pressed}
      aria-expanded={expanded}
      disabled={disabled}
      title={keys === undefined ? label : `${label} (${keys})`}
      onClick={onClick}
    >
      {children}
    </button>
  );
}
