// The link that the server prints: http://127.0.0.1:PORT/?token=T.

/** The token of the page's own address; empty where there is none. */
export function tokenOf(address: string): string {
  return new URL(address).searchParams.get("token") ?? "";
}

export function socketAddress(address: string, token: string): string {
  const url = new URL("socket", address);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  url.search = new URLSearchParams({ token }).toString();
  url.hash = "";
  return url.href;
}

/** Number of the project in the address: `#project=3` of the one that was open, so that a reload opens it again, else the
 *  one of the link, `&project=3`. */
export function projectOf(address: string): number | null {
  return numberOf(address, "project");
}

/** The same of a breeding session, `#project=3&session=7`, of a page that showed the breeding room. */
export function sessionOf(address: string): number | null {
  return numberOf(address, "session");
}

/** The address's end for a page that shows a project, and a breeding session of it. */
export function placeOf(project: number, session: number | null): string {
  return `#project=${project}${session === null ? "" : `&session=${session}`}`;
}

function numberOf(address: string, name: string): number | null {
  const url = new URL(address);
  const text = new URLSearchParams(url.hash.slice(1)).get(name) ?? url.searchParams.get(name);
  return text !== null && /^\d{1,15}$/.test(text) ? Number(text) : null;
}
