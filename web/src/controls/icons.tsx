// Icons of 16 x 16, drawn with lines of one width.
const paths = {
  undo: "M6 3 2.5 6.5 6 10M3 6.5h6.5a4 4 0 0 1 0 8H7",
  redo: "M10 3l3.5 3.5L10 10M13 6.5H6.5a4 4 0 0 0 0 8H9",
  select: "M4 2l8.5 6.5-4.2.6 2.2 4.4-1.8.9-2.2-4.5L4 13z",
  curve: "M2.5 13C4 4 10.5 12.5 13.5 3M2.5 13h.01M13.5 3h.01",
  box: "M8 2l5.5 3v6L8 14l-5.5-3V5zM2.5 5 8 8l5.5-3M8 8v6",
  sphere: "M8 2a6 6 0 1 0 0 12A6 6 0 0 0 8 2zM2 8c0 3.2 12 3.2 12 0",
  cylinder: "M3 4c0-2.7 10-2.7 10 0v8c0 2.7-10 2.7-10 0zM3 4c0 2.7 10 2.7 10 0",
  paint: "M13.5 2.5 8 8.500M8 8.500c-2-1.3-4 0-4 2.2 0 1.5-.8 2.3-1.8 2.6 2.5 1 6.8.3 6.8-2.8 0-.8-.4-1.5-1-2z",
  eye: "M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8zM8 6a2 2 0 1 0 0 4 2 2 0 0 0 0-4z",
  eyeOff: "M2.5 10C4 11.5 5.8 12.5 8 12.5s4-1 5.5-2.500M3.5 13l1.3-1.800M8 15v-2.500M12.5 13l-1.3-1.8",
  copy: "M5.5 5.500v-3h8v8h-3M2.5 5.500h8v8h-8z",
  trash: "M3 4.500h10M6 4.500v-2h4v2M4.5 4.500l.5 9h6l.5-9M7 7v4M9 7v4",
  lock: "M4 7.500h8v6H4zM5.5 7.500V5a2.5 2.5 0 0 1 5 0v2.5",
  unlock: "M4 7.500h8v6H4zM5.5 7.500V5a2.5 2.5 0 0 1 4.8-1",
  star: "M8 2l1.8 3.9 4.2.5-3.1 2.9.8 4.200L8 11.400l-3.7 2.1.8-4.200L2 6.400l4.2-.5z",
  play: "M5 3l8 5-8 5z",
  stop: "M4 4h8v8H4z",
  onward: "M3 3l6 5-6 5zM12 3v10",
  close: "M4 4l8 8M12 4l-8 8",
  plus: "M8 3v10M3 8h10",
  down: "M4 6l4 4 4-4",
  frame: "M2.5 5.500v-3h3M10.5 2.500h3v3M13.5 10.500v3h-3M5.5 13.5h-3v-3M6 6h4v4H6z",
  parts: "M2.5 6 6 4l3.5 2v4L6 12l-3.5-2zM9.5 6.500l4-2v5l-4 2",
  bones: "M4 12 8 5l4.5 3M4 12h.01M8 5h.01M12.5 8h.01",
  field: "M2 5c2-2 4 2 6 0s4 2 6 0M2 10c2-2 4 2 6 0s4 2 6 0",
  targets: "M8 2v3M8 11v3M2 8h3M11 8h3M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  ground: "M1.5 11.500h13M4 8.500h8M6 5.500h4",
  reach: "M8 13V8M3 3h.01M8 2h.01M13 3h.01M4.5 6h.01M11.5 6h.01M2.5 8h.01M13.5 8h.01M8 5h.01",
  sun: "M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM8 1v1.500M8 13.5V15M1 8h1.500M13.5 8H15M3 3l1 1M12 12l1 1M3 13l1-1M12 4l1-1",
  moon: "M13 9.500A5.5 5.5 0 0 1 6.5 3 5.5 5.5 0 1 0 13 9.500z",
  system: "M2 3h12v8H2zM6 14h4M8 11v3",
  export: "M8 10V2M5 5l3-3 3 3M3 9v4.500h10V9",
  folder: "M1.5 12.5v-9h4l1.5 2h7.500v7z",
  help: "M6 6a2 2 0 1 1 3 1.700c-.7.4-1 .8-1 1.600M8 12h.01",
  rule: "M6 2C4 2 5 7 3 8c2 1 1 6 3 6M10 2c2 0 1 5 3 6-2 1-1 6-3 6",
} as const;

export type IconName = keyof typeof paths;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true" focusable="false">
      <path d={paths[name]} />
    </svg>
  );
}
