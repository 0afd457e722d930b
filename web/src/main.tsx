import { effect, signal } from "@preact/signals";
import { render } from "preact";
import { Files } from "./connection/files";
import { placeOf, projectOf, sessionOf, socketAddress, tokenOf } from "./connection/link";
import type { Socket } from "./connection/connection";
import { App } from "./page/app";
import { keptPreferences } from "./store/preferences";
import { currentView } from "./shell/view_access";
import { Studio } from "./store/studio";
import "./styles/theme.css";
import "./styles/controls.css";
import "./styles/layout.css";
import "./styles/panels.css";
import "./styles/breeding.css";
import "./styles/breeding_side.css";

const address = window.location.href;
const token = tokenOf(address);
const dark = window.matchMedia("(prefers-color-scheme: dark)");
const systemDark = signal(dark.matches);
dark.addEventListener("change", () => (systemDark.value = dark.matches));

const studio = new Studio({
  openSocket: () => new WebSocket(socketAddress(address, token)) as Socket,
  files: new Files(address, token),
  preferences: keptPreferences(window.localStorage),
  parking: window.sessionStorage,
  systemDark,
  firstProject: projectOf(address),
  firstSession: sessionOf(address),
  onPlace: (project, session) => window.history.replaceState(null, "", placeOf(project, session)),
  later: (milliseconds, action) => {
    const timer = window.setTimeout(action, milliseconds);
    return () => window.clearTimeout(timer);
  },
  random: Math.random,
});

effect(() => {
  document.documentElement.dataset["theme"] = studio.dark.value ? "dark" : "light";
});
effect(() => {
  const name = studio.document.value?.project.name;
  document.title = name === undefined ? "Espalier studio" : `${name} – Espalier studio`;
});

studio.watch();
render(<App studio={studio} />, document.getElementById("studio")!);
studio.connection.connect();
// What is painted goes to the server when the tool is left; before that the browser asks whether to stay.
window.addEventListener("beforeunload", (event) => {
  if (currentView.value?.painting === true || studio.hasUnsaved) event.preventDefault();
});
// What was typed a moment ago is not lost with the page.
window.addEventListener("pagehide", () => studio.edits.flush());
