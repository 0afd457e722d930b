#include "io/mesh_import.h"

#include <gtest/gtest.h>

#include "base/hash.h"
#include "base/random.h"
#include "io/file.h"
#include "model/primitives.h"
#include "test_models.h"

namespace espalier {
namespace {

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class MeshImport : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    write_file(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string error(const std::string& name, const std::string& bytes) {
    const std::string path = write(name, bytes);
    return error_of([&] { source_.load(path); });
  }

  TemporaryFolder folder_;
  AssimpMeshSource source_;
};

TEST_F(MeshImport, ReadsAPlainObj) {
  const Mesh mesh = source_.load(write("tetra.obj", kTetrahedron));
  EXPECT_EQ(mesh.name, "tetra");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(open_edges(mesh), 0u);
  EXPECT_NEAR(volume(mesh), 1.0 / 6, 1e-7);
  EXPECT_EQ(mesh.source_hash, content_hash(kTetrahedron));
}

TEST_F(MeshImport, FlattensGroupsPolygonsAndNormals) {
  const Mesh mesh =
      source_.load(write("a.obj",
                         "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 1 1 2\n"
                         "vn 0 0 1\ng a\nusemtl red\nf 1//1 2//1 3//1 4//1\ng b\nf 5 6 7\nl 1 2\np 1\n"));
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.positions.size(), 7u);
  ASSERT_EQ(mesh.normals.size(), 7u);
  for (const Vec3& n : mesh.normals) EXPECT_EQ(n, Vec3(0, 0, 1));
}

TEST_F(MeshImport, WeldsWhatIsEqual) {
  // Six loose triangles' worth of corners in an STL become the positions of a box with one normal per side.
  Model model;
  model.instances = {part(MeshKind::box, Vec3(0))};
  export_model(folder_ / "box.stl", model, primitive_table(), {}, {});
  const Mesh mesh = source_.load(folder_ / "box.stl");
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(open_edges(mesh), 0u);
}

TEST_F(MeshImport, AppliesNodesAndTurnsMirroredOnesRightSideOut) {
  Model model;
  model.instances = {part(MeshKind::wedge, Vec3(3, 0, 0)), part(MeshKind::wedge, Vec3(-3, 0, 0), scaling(-1, 2, 1))};
  export_model(folder_ / "a.glb", model, primitive_table(), {}, {});
  const Mesh mesh = source_.load(folder_ / "a.glb");
  EXPECT_NEAR(volume(mesh), 1.5, 1e-6);
  EXPECT_EQ(bounds(mesh).min, Vec3(-3.5f, -1, -0.5f));
  EXPECT_EQ(bounds(mesh).max, Vec3(3.5f, 1, 0.5f));
  EXPECT_EQ(open_edges(mesh), 0u);
}

TEST_F(MeshImport, NamesWhatIsWrong) {
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n").find("a coordinate is not finite (nan)"),
            std::string::npos);
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n").find("a coordinate is not finite (inf)"),
            std::string::npos);
  EXPECT_NE(error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1e20 0\nf 1 2 3\n").find("coordinate 1e+20 is beyond"),
            std::string::npos);
  EXPECT_NE(error("a.obj", "").find("the file is empty"), std::string::npos);
  EXPECT_NE(error("a.txt", kTetrahedron).find("the ending \".txt\" is unknown"), std::string::npos);
  EXPECT_NE(error("a", kTetrahedron).find("the ending \"\" is unknown"), std::string::npos);
  for (const char* text : {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "hello", "v 0 0 0\nv 1 0 0\nl 1 2\n",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999\n",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -7\n"}) {
    EXPECT_NE(error("a.obj", text).find("a.obj: "), std::string::npos) << text;
  }
}

TEST_F(MeshImport, MissingFilesAndFolders) {
  EXPECT_EQ(error_of([&] { source_.load(folder_ / "no.obj"); }),
            (folder_ / "no.obj") + ": cannot read: No such file or directory");
  std::filesystem::create_directory(folder_ / "folder.obj");
  EXPECT_EQ(error_of([&] { source_.load(folder_ / "folder.obj"); }),
            (folder_ / "folder.obj") + ": cannot read: it is a folder");
}

TEST_F(MeshImport, HoldsItsLimits) {
  const std::string path = write("a.obj", kTetrahedron);
  AssimpMeshSource few({.most_bytes = 1000, .most_triangles = 3}), small({.most_bytes = 10, .most_triangles = 100});
  EXPECT_EQ(error_of([&] { few.load(path); }), path + ": more than 3 triangles");
  EXPECT_EQ(error_of([&] { small.load(path); }), path + ": cannot read: it is larger than 10 bytes");
}

/// Whatever the file, loading gives a sound mesh or an Error.
void expect_sound(AssimpMeshSource& source, const std::string& path, const std::string& what) {
  try {
    const Mesh mesh = source.load(path);
    ASSERT_FALSE(mesh.triangles.empty()) << what;
    ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()) << what;
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t corner : t) ASSERT_LT(corner, mesh.positions.size()) << what;
    }
    for (const Vec3& p : mesh.positions)
      ASSERT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1e9f) << what;
  } catch (const Error& e) {
    ASSERT_NE(std::string(e.what()).find(path), std::string::npos) << what << ": " << e.what();
  }
}

class DamagedFiles : public testing::TestWithParam<const char*> {};

TEST_P(DamagedFiles, NeverCrash) {
  const TemporaryFolder folder;
  AssimpMeshSource source;
  const std::string path = folder / GetParam(), damaged = folder / (std::string("b") + GetParam());
  export_model(path, mixed_model(), primitive_table(), two_materials(), {});
  const std::string whole = read_file(path);
  for (int tenth = 0; tenth < 10; ++tenth) {
    write_file(damaged, whole.substr(0, whole.size() * static_cast<std::size_t>(tenth) / 10));
    expect_sound(source, damaged, "cut at tenth " + std::to_string(tenth));
  }
  RandomStream random({3, Purpose::test});
  for (int round = 0; round < 60; ++round) {
    std::string bytes = whole;
    // Half of the damage goes to the head, where the structure is.
    for (int k = 0; k < 4; ++k) {
      const auto range =
          static_cast<std::uint32_t>(round % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 2000));
      bytes[random.below(range)] = static_cast<char>(random.next_u32());
    }
    write_file(damaged, bytes);
    expect_sound(source, damaged, "round " + std::to_string(round));
  }
}

TEST_P(DamagedFiles, NorDoesNoise) {
  const TemporaryFolder folder;
  AssimpMeshSource source;
  RandomStream random({4, Purpose::test});
  for (const std::size_t size : {1u, 10u, 100u, 1000u, 100'000u}) {
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random.next_u32());
    write_file(folder / GetParam(), bytes);
    expect_sound(source, folder / GetParam(), std::to_string(size) + " bytes of noise");
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFiles, testing::Values("a.glb", "a.obj", "a.ply", "a.stl"),
                         [](const auto& format) { return std::string(format.param).substr(2); });

}  // namespace
}  // namespace espalier
