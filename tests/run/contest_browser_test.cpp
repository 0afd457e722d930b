// Pages of contests in a real browser: they check themselves, and do what a person asks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/browser.h"
#include "run/contest_fixtures.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::attribute;
using testing::document_of;
using testing::driven;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

class ContestBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::find_browser().empty()) GTEST_SKIP() << "no chromium here; script/setup test installs it";
    write_pile(folder_);
  }
  std::string comparison() {
    std::vector<VariantWords> variants = parse_engines("ga,rjmcmc");
    variants.push_back(parse_variant("small: search.population=12"));
    CompareRequest request = testing::pile_comparison(folder_, "out", variants, 400);
    request.command = "espalier compare '</pre><script>alert(1)</script>'";
    EXPECT_TRUE(compare_variants(request, source_));
    return folder_ / "out/compare.html";
  }
  TemporaryFolder folder_;
  AssimpMeshSource source_;
};

TEST_F(ContestBrowser, TheComparisonComesUpAndDoesWhatAPersonAsks) {
  const std::string document = document_of(driven(comparison(), R"(
    const all = (what) => document.querySelectorAll(what);
    const lines = () => all(".plot .line").length + "/" + all(".plot .band").length + "/" + all(".plot .thin").length;
    const plot = all(".plot")[1], readout = all(".readout")[1];
    const key = (name) => plot.dispatchEvent(new KeyboardEvent("keydown", {key: name, cancelable: true}));
    seen.push(lines());
    all(".series button")[1].click();
    seen.push(lines(), all(".series button")[1].getAttribute("aria-pressed"));
    all(".series button")[1].click();
    page.byId("show-seeds").click(); seen.push(lines());
    key("End"); seen.push(readout.textContent.split(":")[0], readout.querySelectorAll(".swatch").length);
    key("Home"); seen.push(readout.textContent.split(":")[0]);
    const end = () => plot.querySelector(".line").points.getItem(0).x;  // by evaluations: the clock of tiny runs is fickle
    const log = end(); page.byId("scale-linear").click();
    seen.push(end() !== log, page.byId("scale-linear").getAttribute("aria-pressed"));
    key("End"); const mean = readout.textContent;
    page.byId("band-median").click(); seen.push(readout.textContent !== mean && readout.textContent.includes(" to "));
    const box = plot.getBoundingClientRect();
    plot.dispatchEvent(new PointerEvent("pointermove", {clientX: box.left + 60, clientY: box.top + 50}));
    seen.push(readout.textContent.split(" ")[0], all(".bests img").length, all("details").length);
    seen.push(page.byId("command").textContent);
  )"));
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  EXPECT_EQ(attribute(document, "<html", "data-seen"),
            "6/6/0;4/4/0;false;6/6/12;after 400 evaluations;3;after 4 evaluations;true;true;true;after;3;3;"
            "espalier compare '&lt;/pre&gt;&lt;script&gt;alert(1)&lt;/script&gt;'");
}

TEST_F(ContestBrowser, TheComparisonTellsOfItsOwnErrors) {
  const std::string page = comparison();
  std::string text = read_text(page);
  text.replace(text.find("iVBORw0"), 7, "AAAAAAA");
  write_text(page, text);
  EXPECT_THAT(attribute(document_of(page), "<html", "data-ready"), HasSubstr("1 of them cannot be shown"));
  text.erase(text.find("\"names\":"), 20);
  write_text(page, text);
  EXPECT_THAT(attribute(document_of(page), "<html", "data-ready"), Not("ok"));
}

TEST_F(ContestBrowser, TheSweepComesUp) {
  const SweepRequest request = testing::pile_sweep(
      folder_, "sweep", {"search.population=8,9,10,40", "search.first=roulette,\"tournament\",random"},
      testing::pile_words(folder_, 200));
  ASSERT_TRUE(sweep_settings(request, source_));
  const std::string document = document_of(driven(folder_ / "sweep/sweep.html", R"(
    const all = (what) => document.querySelectorAll(what);
    seen.push(all(".plot .line").length, all(".series button").length, all(".effects tbody tr").length);
    seen.push(all("section.wide .numbers tbody tr").length, all("td.spread .middle").length);
  )"));
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  EXPECT_EQ(attribute(document, "<html", "data-seen"), "16;8;9;12;19");
}

TEST_F(ContestBrowser, PagesFitANarrowPhone) {
  const std::string document = document_of(driven(comparison(), R"(
    Object.assign(document.body.style, {width: "360px", margin: 0});
    const wide = [...document.querySelectorAll("header, section, figure")].filter((box) =>
        box.scrollWidth > box.clientWidth + 1 || box.getBoundingClientRect().right > 360);
    seen.push(innerWidth < 560, ...wide.map((box) => box.outerHTML.slice(0, 60)));
  )"), 6000, "--hide-scrollbars --window-size=500,800");
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  EXPECT_EQ(attribute(document, "<html", "data-seen"), "true");
}

}  // namespace
}  // namespace espalier
