// Scene files and grammars as new projects.
#include "studio/scene_project.h"

#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace espalier::studio {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kBox = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A disk of a few files.
class Disk {
 public:
  std::string& operator[](const std::string& path) { return files_[path]; }
  ReadPath reader() const {
    return [this](const std::string& path) {
      const auto found = files_.find(path);
      if (found == files_.end()) throw Error(path + ": cannot be read");
      return found->second;
    };
  }

 private:
  std::map<std::string, std::string> files_;
};

std::vector<std::string> paths(const NewProject& project) {
  std::vector<std::string> all;
  for (const StoredFile& file : project.state.files) all.push_back(file.path);
  return all;
}

std::string fault_of(const std::string& path, const Disk& disk) {
  try {
    path.ends_with(".toml") ? project_of_scene(path, disk.reader()) : project_of_grammar(path, disk.reader());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneProject, AGrammarBringsTheFilesThatItNames) {
  Disk disk;
  disk["art/g/tree.esp"] = "grammar a 1\n# \"not/there.obj\" is a comment\nimport \"parts/leaf.esp\"\nmesh a = \"meshes/a.obj\"\n"
                           "mesh b = \"../b.obj\"\nmesh c = \"../other/a.obj\"\nconst red = \"#ff0000\"\nstart R\nrule R { bone (0,0,0) -> (0,1,0) }\n";
  disk["art/g/parts/leaf.esp"] = "grammar leaf 1\nimport \"vein.esp\"\nmesh d = \"../b.obj\"\n";
  disk["art/g/parts/vein.esp"] = "grammar vein 1\n";
  for (const char* mesh : {"art/g/meshes/a.obj", "art/b.obj", "art/other/a.obj"}) disk[mesh] = kBox;
  const NewProject project = project_of_grammar("art/g/tree.esp", disk.reader());
  EXPECT_THAT(paths(project), ElementsAre("a.obj", "b.obj", "meshes/a.obj", "parts/leaf.esp", "parts/vein.esp"));
  EXPECT_THAT(project.state.grammar, HasSubstr("\"not/there.obj\""));
  EXPECT_THAT(project.state.grammar, HasSubstr("mesh a = \"meshes/a.obj\"\nmesh b = \"b.obj\"\nmesh c = \"a.obj\""));
  EXPECT_THAT(project.state.scene, HasSubstr("guided"));
  for (const StoredFile& file : project.state.files) {
    EXPECT_EQ(project.blobs.count(file.hash), 1u) << file.path;
    if (file.path == "parts/leaf.esp") {
      EXPECT_EQ(project.blobs.at(file.hash), "grammar leaf 1\nimport \"vein.esp\"\nmesh d = \"b.obj\"\n");
    }
  }
}

TEST(SceneProject, ImportsThatComeAlongStayWhereTheyAre) {
  Disk disk;
  disk["city.esp"] = "grammar a 1\nimport \"city-building.esp\"\nstart R\nrule R { emit box }\n";
  disk["city-building.esp"] = *find_shipped("grammars/city-building.esp");
  EXPECT_THAT(paths(project_of_grammar("city.esp", disk.reader())), ElementsAre());
  disk["city-building.esp"] += "# changed\n";
  EXPECT_THAT(paths(project_of_grammar("city.esp", disk.reader())), ElementsAre("city-building.esp"));
}

TEST(SceneProject, ASceneBringsItsTargets) {
  Disk disk;
  disk["/s/one.toml"] = "espalier = 1\ngrammar = \"../g/a.esp\"\nbudget.seconds = 1\n[[volume.mesh]]\nfile = \"big t\xc3\xb6wn.obj\"\n"
                        "[[volume.mesh]]\nfile = \"x/a.obj\"\n";
  disk["/g/a.esp"] = "grammar a 1\nmesh m = \"a.obj\"\nstart R\nrule R { emit m }\n";
  for (const char* mesh : {"/g/a.obj", "/s/big t\xc3\xb6wn.obj", "/s/x/a.obj"}) disk[mesh] = kBox;
  const NewProject project = project_of_scene("/s/one.toml", disk.reader());
  EXPECT_THAT(paths(project), ElementsAre("a-2.obj", "a.obj", "big t--wn.obj"));
  const auto scene = nlohmann::json::parse(project.state.scene);
  EXPECT_EQ(scene["volume"]["mesh"][0]["file"], "big t--wn.obj");
  EXPECT_EQ(scene["volume"]["mesh"][1]["file"], "a-2.obj");
  EXPECT_FALSE(scene.contains("grammar"));
}

TEST(SceneProject, FaultsNameTheirFiles) {
  Disk disk;
  EXPECT_THAT(fault_of("no.esp", disk), HasSubstr("no.esp: cannot be read"));
  disk["a.esp"] = "grammar a 1\nmesh m = \"lost.obj\"\n";
  EXPECT_THAT(fault_of("a.esp", disk), HasSubstr("lost.obj: cannot be read"));
  disk["s.toml"] = "espalier = 1\n";
  EXPECT_THAT(fault_of("s.toml", disk), HasSubstr("s.toml: grammar must be"));
  disk["s.toml"] = "espalier = = 1\n";
  EXPECT_THAT(fault_of("s.toml", disk), HasSubstr("s.toml"));
  disk["lost.obj"] = "no mesh";
  EXPECT_THAT(fault_of("a.esp", disk), HasSubstr("lost.obj"));
  disk["a.esp"] = "grammar a 1\n# \xff\n";
  EXPECT_THAT(fault_of("a.esp", disk), HasSubstr("a.esp: must be UTF-8"));
  disk["a.esp"] = std::string(1'000'001, ' ');
  EXPECT_THAT(fault_of("a.esp", disk), HasSubstr("at most"));
}

}  // namespace
}  // namespace espalier::studio
