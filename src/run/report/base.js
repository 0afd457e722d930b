// What all pages share: their data, errors, whether everything came up, and copying.
"use strict";
const page = {
  errors: [],
  parts: {},  // name of a part of the page -> null while it is being made, "" when it is well, else what is wrong
  byId: (id) => document.getElementById(id),
  data: null,
};

addEventListener("error", (event) => {
  page.errors.push(event.message || "an error");
  page.report();
});

// Tells, for tests and for the curious, whether everything came up: <html data-ready="ok" or what went wrong>.
page.report = () => {
  const parts = Object.entries(page.parts);
  if (!page.errors.length && parts.some(([, problem]) => problem === null)) return;
  const problems = parts.filter(([, problem]) => problem).map(([name, problem]) => name + ": " + problem);
  document.documentElement.dataset.ready = problems.concat(page.errors).join("; ") || "ok";
};
page.done = (part, problem = "") => {
  page.parts[part] = problem;
  page.report();
};

page.data = JSON.parse(page.byId("data").textContent);

// Copying.
for (const button of document.querySelectorAll("button.copy")) {
  button.addEventListener("click", async () => {
    const source = page.byId(button.dataset.copy);
    let copied = false;
    try {
      await navigator.clipboard.writeText(source.textContent);
      copied = true;
    } catch {
      const range = document.createRange();
      range.selectNodeContents(source);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      copied = document.execCommand("copy");
    }
    button.textContent = copied ? "copied" : "selected: press Ctrl-C";
    setTimeout(() => { button.textContent = "copy"; }, 2000);
  });
}

