// Reports in a real browser. A page checks itself and says so in <html data-ready>: the model was drawn (or its picture
// stands in), the curve has its points, all pictures are there, and no script failed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/mesh_import.h"
#include "run/browser.h"
#include "run/drawing_fixtures.h"
#include "run/run.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::attribute;
using testing::document_of;
using testing::driven;
using testing::pile_scene;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

namespace fs = std::filesystem;

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::find_browser().empty()) GTEST_SKIP() << "no chromium here; script/setup test installs it";
    write_pile(folder_);
  }
  std::string report(const std::string& out = "out") {
    AssimpMeshSource source;
    EXPECT_TRUE(run_scene(load_scene(folder_ / "scene.toml"), {folder_ / out, nullptr, nullptr}, source));
    return folder_ / out + "/report.html";
  }
  TemporaryFolder folder_;
};

TEST_F(Browser, ThePageComesUpAndDrawsTheModel) {
  const std::string document = document_of(report());
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  ASSERT_NE(attribute(document, "<div id=\"viewer\"", "data-drawn"), "?");
  EXPECT_GT(std::stoi(attribute(document, "<div id=\"viewer\"", "data-drawn")), 5000);
  EXPECT_THAT(document, HasSubstr("<polyline class=\"best\""));
}

TEST_F(Browser, ShowsWhatIsHitAndMissedBesideTheTarget) {
  const testing::TemporaryFolder folder;
  testing::write_drawing(folder);
  write_text(folder / "scene.toml", testing::drawing_scene(std::string(testing::kTowerVolume) + testing::kParallel +
                                                           testing::kFloor));
  AssimpMeshSource source;
  ASSERT_TRUE(run_scene(load_scene(folder / "scene.toml"), {folder / "out", nullptr, nullptr}, source));
  const std::string document = document_of(driven(folder / "out/report.html", R"(
    const figures = [...document.querySelectorAll(".pictures figure")];
    seen.push(figures.length, ...figures.map((figure) => figure.querySelector("b").textContent));
    for (const legend of document.querySelectorAll(".legend")) {
      const items = [...legend.querySelectorAll("li")];
      const colours = new Set(items.map((item) => item.querySelector("i") ? getComputedStyle(item.querySelector("i"))
          .backgroundColor : item.textContent));
      seen.push(items[0].textContent.split(":")[0], colours.size === items.length);
    }
    seen.push(figures.every((figure) => figure.querySelector("img").naturalWidth > 0));
  )"));
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  EXPECT_EQ(attribute(document, "<html", "data-seen"),
            "9;Best;Hit and missed;Target volume;Target silhouette;As the target sees it;Hit and missed;"
            "Target silhouette;As the target sees it;Hit and missed;filled;true;hit;true;hit;true;true");
}

TEST_F(Browser, WithoutWebGlThePictureStandsThere) {
  const std::string document = document_of(report(), 6000, "--disable-gpu --disable-3d-apis");
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  EXPECT_THAT(attribute(document, "<div id=\"viewer\"", "data-fallback"), HasSubstr("WebGL"));
}

TEST_F(Browser, TellsOfItsOwnErrors) {
  const std::string page = report();
  std::string text = read_text(page);
  text.replace(text.find("iVBORw0"), 7, "AAAAAAA");
  write_text(page, text);
  EXPECT_THAT(attribute(document_of(page), "<html", "data-ready"), HasSubstr("1 of them cannot be shown"));
  const std::size_t model = text.find('>', text.find("id=\"model\"")) + 1;
  text.erase(model, 400);
  write_text(page, text);
  EXPECT_THAT(attribute(document_of(page), "<html", "data-ready"), Not("ok"));
}

TEST_F(Browser, NamesMayHoldAnything) {
  const std::string file = "a&b '<|script><script>alert(1)<!-- {{data}}.obj";
  write_text(folder_ / ("meshes/" + file), testing::box_obj(-1, 0, -0.5, 1, 4, 0.5));
  std::string scene = pile_scene();
  scene.replace(scene.find("tower.obj"), 9, file);
  write_text(folder_ / "scene.toml", scene);
  EXPECT_EQ(attribute(document_of(report()), "<html", "data-ready"), "ok");
}

TEST_F(Browser, DoesWhatAPersonAsks) {
  const std::string document = document_of(driven(report(), R"(
    const canvas = page.byId("view"), key = (target, name) =>
        target.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true, cancelable: true}));
    const camera = () => page.kept.camera;
    key(canvas, "ArrowRight"); seen.push("azimuth " + camera().azimuth);
    key(canvas, "+"); seen.push("zoomed " + (camera().zoom < 1));
    const pointer = (type, x, y) => canvas.dispatchEvent(
        new PointerEvent(type, {pointerId: 1, clientX: x, clientY: y, buttons: 1, bubbles: true}));
    canvas.setPointerCapture = () => {};
    pointer("pointerdown", 300, 500); pointer("pointermove", 200, 550); pointer("pointerup", 200, 550);
    seen.push("dragged to " + camera().azimuth + " " + camera().elevation);
    const zoom = camera().zoom;
    canvas.dispatchEvent(new WheelEvent("wheel", {deltaY: 100, cancelable: true}));
    seen.push("wheel " + (camera().zoom > zoom));
    page.byId("reset-view").click(); seen.push("home " + camera().azimuth + " " + camera().zoom);
    page.byId("show-targets").click(); seen.push("targets " + page.kept.targets);
    page.byId("by-evaluations").click();
    seen.push("pressed " + page.byId("by-evaluations").getAttribute("aria-pressed"));
    key(page.byId("plot"), "Home"); seen.push(page.byId("readout").textContent.replace(/after [0-9.]+ s/, "after s"));
    const box = page.byId("plot").getBoundingClientRect();
    page.byId("plot").dispatchEvent(new PointerEvent("pointermove", {clientX: box.right - 1, clientY: box.top + 50}));
    seen.push("marks " + document.querySelectorAll(".mark").length);
    document.querySelectorAll(".thumbnail")[1].click();
    const dialog = page.byId("large");
    seen.push("open " + dialog.open, dialog.querySelector("p").textContent.split("\n")[0].slice(0, 16));
    key(dialog, "ArrowRight"); seen.push(dialog.querySelector("p").textContent.slice(0, 13));
    seen.push(dialog.querySelector("a").getAttribute("href"));
  )"));
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  const std::string seen = attribute(document, "<html", "data-seen");
  EXPECT_THAT(seen, HasSubstr("azimuth 40;zoomed true;dragged to 80 42;wheel true;home 35 1;targets false;"
                              "pressed true;after s and 24 evaluations: best "));
  EXPECT_THAT(seen, HasSubstr(";marks 3;open true;Alternative 2 of;Alternative 1;alternatives/01.glb"));
}

TEST_F(Browser, AReportOfARunThatGoesOnLoadsItselfAnew) {
  const std::string page = report();
  std::string text = read_text(page);
  const std::string live = "\"live\": null";
  text.replace(text.find(live), live.size(), "\"live\": {\"refresh\": 1, \"final\": \"../a%20b/\"}");
  const std::string header = "<h1>";
  text.replace(text.find(header), header.size(), "<p id=\"status\"></p><h1>");
  write_text(folder_ / "a b.partial-1/report.html", text);
  fs::copy(folder_ / "out/best.png", folder_ / "a b.partial-1/best.png");
  const std::string count = "sessionStorage.loads = Number(sessionStorage.loads || 0) + 1; seen.push("
                            "sessionStorage.loads > 2 ? 'many' : 'few');"
                            "page.busy = sessionStorage.loads > 2;";  // or it would go on for ever
  const std::string driven_page = driven(folder_ / "a b.partial-1/report.html", count);
  EXPECT_EQ(attribute(document_of(driven_page), "<html", "data-seen"), "many");
  // Its folder has taken its final name.
  fs::rename(folder_ / "out", folder_ / "a b");
  fs::remove(folder_ / "a b.partial-1/best.png");
  write_text(folder_ / "a b/report.html", "<!DOCTYPE html><html data-final=\"yes\"><title>final</title></html>");
  EXPECT_EQ(attribute(document_of(driven_page), "<html", "data-final"), "yes");
}

TEST_F(Browser, FitsANarrowPhone) {
  const std::string document = document_of(
      driven(report(), R"(
    Object.assign(document.body.style, {width: "360px", margin: 0});
    // No window is that narrow; the layout for phones begins at 560 pixels.
    const wide = [...document.querySelectorAll("header, section, figure")].filter((box) =>
        box.scrollWidth > box.clientWidth + 1 || box.getBoundingClientRect().right > 360);
    seen.push(innerWidth < 560, page.byId("plot").clientWidth > 200, ...wide.map((box) => box.outerHTML.slice(0, 60)));
  )"),
      6000,
      "--hide-scrollbars --window-size=500,800 --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader");
  EXPECT_EQ(attribute(document, "<html", "data-ready"), "ok");
  EXPECT_EQ(attribute(document, "<html", "data-seen"), "true;true");
}

}  // namespace
}  // namespace espalier
