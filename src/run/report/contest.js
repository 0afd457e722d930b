// What pages of contests share: numbers as people read them, pictures that are there.
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

addEventListener("load", () => {
  const pictures = [...document.querySelectorAll("figure img")];
  const broken = pictures.filter((one) => one.naturalWidth === 0).length;
  page.done("pictures", broken ? broken + " of them cannot be shown" : "");
});
