// What the parts of a report share: what is kept while it loads itself anew, alternatives.
for (const part of ["view", "plot", "pictures"]) page.parts[part] = null;

page.readable = (value) => {
  const digits = Math.abs(value) >= 1000 ? 0 : Math.abs(value) >= 10 ? 1 : 3;
  return value.toLocaleString("en", {maximumFractionDigits: digits});
};

// Where a person stood before the page loaded itself anew.
page.kept = {};
try {
  page.kept = JSON.parse(sessionStorage.getItem("espalier-report") || "{}");
} catch { /* private windows and old files: begin anew */ }
page.keep = (name, value) => {
  page.kept[name] = value;
  try {
    sessionStorage.setItem("espalier-report", JSON.stringify(page.kept));
  } catch { /* then it is not kept */ }
};

// A run that goes on: as long as its picture lies beside this page, load anew; once it does not, the folder has taken
// its final name.
page.busy = false;  // a person is dragging
(() => {
  const live = page.data.live;
  if (!live) return;
  const status = page.byId("status");
  const wait = Math.max(1000, 1000 * live.refresh);
  const age = (Date.now() - Date.parse(document.lastModified)) / 1000;
  if (age > Math.max(60, 20 * live.refresh)) {
    status.classList.add("stale");
    status.textContent = "No news for " + Math.round(age / 60) + " minutes: the search may have been killed.";
  }
  const exists = (url, yes, no) => {
    const probe = new Image();
    probe.onload = yes;
    probe.onerror = no;
    probe.src = url + "?" + Date.now();
  };
  let missed = 0;
  const look = () => {
    setTimeout(look, wait);
    if (page.busy) return;
    exists("best.png", () => location.reload(), () => {
      exists(live.final + "best.png", () => location.replace(live.final + "report.html"), () => {
        if (++missed < 3) return;
        status.classList.add("stale");
        status.textContent = "The search has ended and its folder is gone; this is the last that was seen of it.";
      });
    });
  };
  setTimeout(look, wait);
})();

// Alternatives: a click shows one large; arrows go on.
(() => {
  const buttons = [...document.querySelectorAll(".thumbnail")];
  const dialog = page.byId("large");
  const picture = dialog.querySelector("img"), words = dialog.querySelector("p");
  let at = 0;
  const show = (index) => {
    at = (index + buttons.length) % buttons.length;
    const {name, score, genes, files, hash} = buttons[at].dataset;
    picture.src = buttons[at].querySelector("img").src;
    picture.alt = "Alternative " + name;
    words.textContent = "Alternative " + name + " of " + buttons.length + ": score " + score + "\n" + genes +
        "\nderivation " + hash + "  ";
    for (const ending of [".glb", ".derivation.json", ".png"]) {
      const link = document.createElement("a");
      link.href = files + ending;
      link.textContent = files + ending;
      words.append("\n", link);
    }
    if (!dialog.open) dialog.showModal();
  };
  buttons.forEach((button, index) => button.addEventListener("click", () => show(index)));
  page.byId("previous").addEventListener("click", () => show(at - 1));
  page.byId("next").addEventListener("click", () => show(at + 1));
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "ArrowLeft") show(at - 1);
    if (event.key === "ArrowRight") show(at + 1);
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
})();

// Are all pictures there?
addEventListener("load", () => {
  const pictures = [...document.querySelectorAll("figure img, .thumbnail img")];
  const broken = pictures.filter((one) => one.naturalWidth === 0).length;
  page.done("pictures", !pictures.length ? "there are none" : broken ? broken + " of them cannot be shown" : "");
});
