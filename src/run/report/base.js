// What all pages share: their data, errors, and whether everything came up.
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

