import { render } from "preact";

render(<main>Espalier</main>, document.getElementById("studio")!);
