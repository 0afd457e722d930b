// Zip files, and scene folders in them as new projects.
#include "studio/scene_zip.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "studio/zip.h"
#include "studio/zip_reader.h"

namespace espalier::studio {
namespace {

using testing::HasSubstr;

std::string zip_of(const std::map<std::string, std::string>& files) {
  ZipWriter writer;
  for (const auto& [path, bytes] : files) writer.add(path, bytes);
  return writer.finish();
}

template <class Call>
std::string fault_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string zip_fault(const std::string& archive, const ZipLimits& limits = {}) {
  return fault_of([&] { read_zip(archive, limits); });
}

const std::map<std::string, std::string> kFiles = {
    {"a/long.txt", std::string(100'000, 'x')}, {"a/short.txt", "ab"}, {"empty", ""}, {"b\xc3\xa4ume/x", std::string("\0\1\2", 3)}};

TEST(ZipReader, ReadsWhatIsWritten) {
  EXPECT_EQ(read_zip(zip_of(kFiles)), kFiles);
  EXPECT_EQ(read_zip(zip_of({})).size(), 0u);
  std::string commented = zip_of(kFiles);
  commented[commented.size() - 2] = 3;
  EXPECT_EQ(read_zip(commented + "abc"), kFiles);
  EXPECT_EQ(read_zip(zip_of({{"folder/", ""}, {"folder/a", "1"}})).size(), 1u);
}

TEST(ZipReader, RefusesPathsThatLeadElsewhere) {
  for (const char* path : {"../a", "/a", "a/../../b", "a//b", "./a", "a\\b", "c:a", "a/..", "", "a\nb", "../"}) {
    EXPECT_THAT(zip_fault(zip_of({{path, "x"}})), HasSubstr("leads elsewhere")) << path;
  }
  EXPECT_THAT(zip_fault(zip_of({{std::string(400, 'a'), "x"}})), HasSubstr("leads elsewhere"));
}

TEST(ZipReader, RefusesWhatIsTooMuch) {
  EXPECT_THAT(zip_fault(zip_of(kFiles), {.files = 3}), HasSubstr("at most 3 files"));
  EXPECT_THAT(zip_fault(zip_of(kFiles), {.bytes = 99'999}), HasSubstr("at most 99999 bytes"));
  // A size that is a lie: more than deflate can make of so little.
  std::string archive = zip_of({{"a", std::string(1000, 'x')}});
  const std::size_t entry = archive.find("PK\x01\x02");
  archive.replace(entry + 24, 4, "\xff\xff\xff\x07");
  EXPECT_THAT(zip_fault(archive), HasSubstr("unknown way"));
  archive.replace(entry + 24, 4, std::string("\xe7\x03\0\0", 4));  // 999
  EXPECT_THAT(zip_fault(archive), HasSubstr("a in the zip file is damaged"));
}

TEST(ZipReader, RefusesTheSameTwiceAndEncryptedAndOtherPacking) {
  ZipWriter writer;
  writer.add("a", "1");
  writer.add("a", "2");
  EXPECT_THAT(zip_fault(writer.finish()), HasSubstr("a twice"));
  std::string archive = zip_of({{"a", "12"}});
  const std::size_t entry = archive.find("PK\x01\x02");
  archive[entry + 8] = 1;
  EXPECT_THAT(zip_fault(archive), HasSubstr("encrypted"));
  archive[entry + 8] = 0, archive[entry + 10] = 12;
  EXPECT_THAT(zip_fault(archive), HasSubstr("unknown way"));
  archive[entry + 10] = 0, archive[entry + 16] ^= 1;
  EXPECT_THAT(zip_fault(archive), HasSubstr("damaged"));
}

TEST(ZipReader, DamageAnywhereIsFoundAndNeverMore) {
  const std::string archive = zip_of(kFiles);
  for (std::size_t size = 0; size < archive.size(); ++size) EXPECT_NE(zip_fault(archive.substr(0, size)), "") << size;
  for (std::size_t at = 0; at < archive.size(); ++at) {
    std::string damaged = archive;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
    fault_of([&] {
      for (const auto& [path, bytes] : read_zip(damaged)) {
        const auto same = kFiles.find(path);
        if (same == kFiles.end()) continue;  // a letter of its path was damaged
        EXPECT_EQ(bytes, same->second) << at;
      }
    });
  }
}

constexpr const char* kGrammar = "grammar a 1\nmesh m = \"a.obj\"\nstart R\nrule R { emit m }\n";
constexpr const char* kBox = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr const char* kScene = "espalier = 1\ngrammar = \"inputs/a.esp\"\n[[volume.mesh]]\nfile = \"inputs/a.obj\"\n";

TEST(SceneZip, BringsSceneGrammarFilesAndModel) {
  const std::string archive = zip_of({{"my-tree/scene.toml", kScene}, {"my-tree/inputs/a.esp", kGrammar}, {"my-tree/inputs/a.obj", kBox},
                                      {"my-tree/best.derivation.json", "{}"}, {"my-tree/deep/scene.toml", "no"},
                                      {"__MACOSX/scene.toml", "no"}});
  EXPECT_TRUE(is_zip(archive));
  const WholeProject project = project_of_zip(archive);
  EXPECT_EQ(project.name, "my-tree");
  EXPECT_EQ(project.content.state.grammar, kGrammar);
  EXPECT_EQ(project.content.state.files.size(), 1u);
  EXPECT_EQ(nlohmann::json::parse(project.content.state.scene)["volume"]["mesh"][0]["file"], "a.obj");
  EXPECT_EQ(project.shown, "{}");
}

TEST(SceneZip, WithoutASceneTheModelSaysWhatItIsOf) {
  const nlohmann::json model = {{"espalier_derivation", 1}, {"provenance", {{"version", "0"}, {"made_by", "run"}, {"settings", "espalier = 1\ngrammar = \"inputs/a.esp\"\n"}}}};
  const WholeProject project = project_of_zip(zip_of({{"best.derivation.json", model.dump()}, {"inputs/a.esp", kGrammar}, {"inputs/a.obj", kBox}}));
  EXPECT_EQ(project.name, "Scene");
  EXPECT_EQ(project.content.state.grammar, kGrammar);
}

TEST(SceneZip, NothingOutsideIsReadAndFaultsNameTheirFiles) {
  const auto fault = [](const std::map<std::string, std::string>& files) { return fault_of([&] { project_of_zip(zip_of(files)); }); };
  EXPECT_THAT(fault({{"a", "b"}}), HasSubstr("has no scene.toml"));
  EXPECT_THAT(fault({{"scene.toml", "espalier = 1\ngrammar = \"/etc/passwd\"\n"}}), HasSubstr("the zip file has no /etc/passwd"));
  EXPECT_THAT(fault({{"t/scene.toml", "espalier = 1\ngrammar = \"../../a.esp\"\n"}}), HasSubstr("the zip file has no ../a.esp"));
  EXPECT_THAT(fault({{"scene.toml", kScene}, {"inputs/a.esp", kGrammar}}), HasSubstr("the zip file has no inputs/a.obj"));
  EXPECT_THAT(fault({{"best.derivation.json", "{}"}}), HasSubstr("does not say"));
  EXPECT_THAT(fault({{"best.derivation.json", std::string(200'000, '[')}}), HasSubstr("does not say"));
}

}  // namespace
}  // namespace espalier::studio
