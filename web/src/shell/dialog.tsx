import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { IconButton } from "../controls/fields";
import { Icon } from "../controls/icons";

/** The browser's own dialog: it keeps the focus and goes with Escape. */
export function Dialog({ title, kind, onClose, children }: { title: string; kind: string; onClose(): void; children: ComponentChildren }) {
  const dialog = useRef<HTMLDialogElement>(null);
  /** Text that is selected may end outside: only what was pressed there too closes it. */
  const pressedOutside = useRef(false);
  useEffect(() => {
    dialog.current!.showModal();
  }, []);
  return (
    <dialog
      ref={dialog} class={`dialog ${kind}`} aria-labelledby="dialog-title" onClose={onClose}
      onPointerDown={(event) => {
        pressedOutside.current = event.target === dialog.current;
      }}
      onClick={(event) => {
        if (event.target === dialog.current && pressedOutside.current) dialog.current?.close();
      }}
    >
      <div class="dialog-inside">
        <header>
          <h2 id="dialog-title">{title}</h2>
          <IconButton label="Close" onClick={() => dialog.current?.close()}><Icon name="close" /></IconButton>
        </header>
        {children}
      </div>
    </dialog>
  );
}
