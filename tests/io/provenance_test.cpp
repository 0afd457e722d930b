#include "io/provenance.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "io/image.h"
#include "test_models.h"

namespace espalier {
namespace {

TEST(Provenance, SurvivesJson) {
  EXPECT_EQ(parse_provenance(to_json(test_provenance())), test_provenance());
  EXPECT_EQ(parse_provenance(to_json(Provenance{})), Provenance{});
}

TEST(Provenance, IsOneAsciiLineWithSortedKeys) {
  const std::string text = to_json(test_provenance());
  for (const char c : text) EXPECT_TRUE(c >= ' ' && c < 127) << static_cast<int>(c);
  EXPECT_LT(text.find("\"derivation\""), text.find("\"engine\""));
  EXPECT_LT(text.find("\"seed\""), text.find("\"version\""));
}

TEST(Provenance, SaysWhatIsWrongWithJson) {
  const auto error = [](const char* text) { return error_of([&] { parse_provenance(text); }); };
  EXPECT_EQ(error(""), "provenance: not JSON");
  EXPECT_EQ(error("{\"version\":"), "provenance: not JSON");
  EXPECT_EQ(error("[]"), "provenance: must be an object, got array");
  EXPECT_EQ(error("{}"), "provenance: \"version\" is missing");
  EXPECT_EQ(error("{\"version\":\"1\",\"made_by\":2}"), "provenance: \"made_by\" must be a string, got number");
  EXPECT_EQ(error("{\"version\":\"1\",\"made_by\":\"run\",\"seed\":-1}"),
            "provenance: \"seed\" must be a whole number >= 0, got -1");
  EXPECT_EQ(error("{\"version\":\"1\",\"made_by\":\"run\",\"steps\":1.5}"),
            "provenance: \"steps\" must be a whole number >= 0, got 1.5");
  EXPECT_EQ(error("{\"version\":\"1\",\"made_by\":\"run\",\"inputs\":{\"a\":1}}"),
            "provenance: the hash of \"a\" must be a string, got number");
}

TEST(Provenance, RefusesTextThatIsNotUtf8) {
  Provenance p = test_provenance();
  p.settings = "\xff";
  EXPECT_NE(error_of([&] { to_json(p); }).find("not UTF-8"), std::string::npos);
}

TEST(ReadProvenance, FindsItInEveryModelFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"a.glb", "a.obj", "a.ply"}) {
    for (const Model& model : {mixed_model(), Model{}}) {
      export_model(folder / name, model, primitive_table(), two_materials(), test_provenance());
      EXPECT_EQ(read_provenance(folder / name), test_provenance()) << name;
    }
  }
  EXPECT_EQ(read_provenance(folder / "a.mtl"), test_provenance());
}

TEST(ReadProvenance, FindsItInPicturesAndDocuments) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", 2, 1, std::vector<std::uint8_t>(6), test_provenance());
  EXPECT_EQ(read_provenance(folder / "a.png"), test_provenance());
  const nlohmann::json document = {{"genes", 3}, {"provenance", nlohmann::json::parse(to_json(test_provenance()))}};
  write_file(folder / "a.json", " \n" + document.dump(2));
  EXPECT_EQ(read_provenance(folder / "a.json"), test_provenance());
}

TEST(ReadProvenance, StlHoldsVersionAndHash) {
  const TemporaryFolder folder;
  export_model(folder / "a.stl", mixed_model(), primitive_table(), two_materials(), test_provenance());
  Provenance expected;
  expected.version = "0.1.0";
  expected.made_by = "export";
  expected.derivation = test_provenance().derivation;
  EXPECT_EQ(read_provenance(folder / "a.stl"), expected);
}

TEST(ReadProvenance, TakesNoOtherTextForAnStl) {
  const TemporaryFolder folder;
  const std::string path = folder / "notes.txt";
  write_file(path, "espalier = 1  # begins like the header of an STL of ours, and is long enough to hold one too\n");
  EXPECT_THROW(read_provenance(path), Error);
}

TEST(ReadProvenance, SurvivesWindowsLineEnds) {
  const TemporaryFolder folder;
  write_file(folder / "a.obj", "# hello\r\n# espalier: " + to_json(test_provenance()) + "\r\nv 0 0 0\r\n");
  EXPECT_EQ(read_provenance(folder / "a.obj"), test_provenance());
}

TEST(ReadProvenance, NamesFilesWithoutOne) {
  const TemporaryFolder folder;
  const std::vector<std::string> contents = {
      "", "glTF", "{}", "{\"provenance\"", "ply\nend_header\ncomment espalier: {}\n", "\x89PNG\r\n\x1a\n", "solid x\n",
      "# nothing here\nv 0 0 0\n", "espalier 0.1.0", std::string(200, '\0'), "glTF" + std::string(40, '\xff')};
  for (const std::string& content : contents) {
    write_file(folder / "a", content);
    const std::string error = error_of([&] { read_provenance(folder / "a"); });
    EXPECT_TRUE(error.starts_with(folder / "a")) << content << ": " << error;
  }
  EXPECT_TRUE(error_of([&] { read_provenance(folder / "b"); }).starts_with(folder / "b"));
}

TEST(ReadProvenance, NoticesDamage) {
  const TemporaryFolder folder;
  export_model(folder / "a.glb", mixed_model(), primitive_table(), two_materials(), test_provenance());
  write_png(folder / "a.png", 2, 1, std::vector<std::uint8_t>(6), test_provenance());
  for (const char* name : {"a.glb", "a.png"}) {
    const std::string bytes = read_file(folder / name);
    for (std::size_t size = 0; size + 8 < 500; size += 7) {
      write_file(folder / "b", bytes.substr(0, size));
      EXPECT_FALSE(error_of([&] { read_provenance(folder / "b"); }).empty()) << name << " cut at " << size;
    }
  }
}

}  // namespace
}  // namespace espalier
