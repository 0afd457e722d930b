/** One of a few, all in sight. Buttons, not radio buttons: arrow keys stay with what they choose for. */
export function Choice<T extends string>({ label, value, choices, onChange }: {
  label: string; value: T; choices: readonly { value: T; name: string; words?: string }[]; onChange(value: T): void;
}) {
  return (
    <span class="choice" role="group" aria-label={label}>
      {choices.map((choice) => (
        <button key={choice.value} type="button" aria-pressed={choice.value === value} data-name={choice.name} title={choice.words} onClick={() => onChange(choice.value)}>{choice.name}</button>
      ))}
    </span>
  );
}
