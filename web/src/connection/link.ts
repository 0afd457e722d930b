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

/** Number of the project in the address (`#project=3`), so that a reload opens it again. */
export function projectOf(address: string): number | null {
  const text = new URLSearchParams(new URL(address).hash.slice(1)).get("project");
  return text !== null && /^\d{1,15}$/.test(text) ? Number(text) : null;
}
