// What pages of contests share: copying, numbers as people read them.
for (const part of ["charts", "pictures"]) page.parts[part] = null;

page.readable = (value) => {
  const size = Math.abs(value), digits = size >= 1000 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 4;
  return value.toLocaleString("en", {maximumFractionDigits: digits});
};
page.percent = (value) => {
  const share = 100 * value / page.data.optimum;
  return (share >= 99.995 ? 100 : share).toFixed(Math.abs(share) < 99.95 ? 1 : 2) + "\u2009%";
};
// A score, in per cent of the optimum where that means something.
page.score = (value) => page.data.optimum > 0 ? page.percent(value) : page.readable(value);

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

addEventListener("load", () => {
  const pictures = [...document.querySelectorAll("figure img")];
  const broken = pictures.filter((one) => one.naturalWidth === 0).length;
  page.done("pictures", broken ? broken + " of them cannot be shown" : "");
});
