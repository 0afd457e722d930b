// The canvas behind the cells, and what it shows as a function of the store.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { useStudio } from "../shell/studio_context";
import { addLog } from "../store/state";
import type { StageLayout } from "./grid_layout";
import { RoomStage, type StagePlace } from "./room_stage";

/** `large` and `small`: individuals for the places of the layout. */
export function StageView({ layout, large, small, width, height }: {
  layout: StageLayout; large: readonly number[]; small: readonly number[]; width: number; height: number;
}) {
  const studio = useStudio();
  const element = useRef<HTMLDivElement>(null);
  const stage = useRef<RoomStage | null>(null);
  const placed = useRef("");
  useEffect(() => {
    const made = RoomStage.open((text) => addLog(studio.state, "error", `A model cannot be shown: ${text}.`));
    if (made === null) return studio.tell("This browser has no WebGL 2: models cannot be shown.", true);
    stage.current = made;
    studio.room.portrait = (id) => made.portrait(id);
    made.element.setAttribute("aria-hidden", "true");
    element.current!.append(made.element);
    const stops = [
      effect(() => {
        const { meshes, models } = studio.room.state;
        if (meshes.value !== null) made.setMeshes(meshes.value);
        made.setModels(models.value);
      }),
      effect(() => {
        const { oneScale, turning } = studio.preferences.value;
        made.setLook({ dark: studio.dark.value, oneScale, turning: turning && !studio.room.still.value });
      }),
    ];
    return () => {
      stops.forEach((stop) => stop());
      studio.room.portrait = null;
      made.dispose();
      stage.current = null;
    };
  }, [studio]);
  useEffect(() => {
    if (width < 2 || height < 2) return;
    const places: StagePlace[] = [
      ...layout.large.flatMap((rect, i) => (large[i] === undefined ? [] : [{ individual: large[i], rect, large: true }])),
      ...layout.grid.cells.map((rect, i) => ({ individual: small[i]!, rect, large: false })),
    ];
    stage.current?.resize(width, height);
    const text = JSON.stringify(places);
    if (text === placed.current) return;
    placed.current = text;
    stage.current?.setPlaces(places);
  });
  const drag = useRef<{ x: number; y: number } | null>(null);
  return (
    <>
      <div class="room-canvas" ref={element} />
      {layout.large.map((rect, i) => (
        <div
          key={i} class="room-large-hand" style={{ left: `${rect.x}px`, top: `${rect.y}px`, width: `${rect.width}px`, height: `${rect.height}px` }}
          onPointerDown={(event) => {
            event.currentTarget.setPointerCapture(event.pointerId);
            drag.current = { x: event.clientX, y: event.clientY };
          }}
          onPointerMove={(event) => {
            if (drag.current === null) return;
            stage.current?.turnBy((drag.current.x - event.clientX) * 0.008, (event.clientY - drag.current.y) * 0.005);
            drag.current = { x: event.clientX, y: event.clientY };
          }}
          onPointerUp={() => (drag.current = null)}
          onPointerCancel={() => (drag.current = null)}
        />
      ))}
    </>
  );
}
