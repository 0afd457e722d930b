// Textures, cut-outs and made materials in files: read back with assimp and stb, and through the glTF validator.

#include <cmath>
#include <cstdio>
#include <fstream>

#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stb_image.h>

#include "derivation/sample.h"
#include "grammar/compiler.h"
#include "io/file.h"
#include "io/glb_container.h"
#include "io/image_import.h"
#include "io/png.h"
#include "model/expand.h"
#include "test_models.h"

namespace espalier {
namespace {

constexpr const char* kGrammar = R"(grammar textured 1
material bark = surface("#ff8080", texture: bark_texture(), tiles: 2, tiles_up: 3, two_sided: true)
material leaf_green = surface("#ffffff", cutout: 0.25, texture: leaf_texture())
material bare = surface("#ffffff", texture: leaf_texture())
material picture = surface("#ffffff", texture: image_texture("pictures/tiny.png"), glow: 3)
start S
rule S {
  wet ~ uniform(0, 1)
  paint bark  emit cylinder  move x 2  emit box
  paint leaf_green  move x 2  emit quad
  paint bare  move x 2  emit quad
  paint picture  move x 2  emit sphere
  paint surface("#ffffff", wet, texture: noise_texture(cells: 8 * wet))  move x 2  emit wedge
  paint surface("#404040")  move x 2  emit cylinder
}
)";

struct Scene {
  std::shared_ptr<const GeneratorGraph> graph;
  Model model;
  TextureTable textures;
  MeshTable meshes;
  std::string picture;

  Scene() {
    graph = compile_grammar({"t.esp", kGrammar, {}}).graph;
    RandomStream random({1, Purpose::test, 0, 0});
    Expander(*graph).expand(sample(*graph, random, 100).derivation, ExpandTo::full, model);
    ImageFile file{{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}}, "", "png"};
    picture = file.bytes = encode_png_with_alpha(2, 2, file.image.rgba);
    textures.add_file("pictures/tiny.png", file);
    AssimpMeshSource source;
    meshes = MeshTable(*graph, "", source);
  }
  void write(const std::string& path) {
    export_model(path, model, meshes, Surfaces(*graph, model, textures), test_provenance());
  }
};

nlohmann::json glb_json(const std::string& path) { return nlohmann::json::parse(*find_glb_json(read_file(path))); }

const nlohmann::json& named(const nlohmann::json& list, const std::string& name) {
  for (const auto& item : list)
    if (item["name"].get<std::string>().starts_with(name)) return item;
  throw Error("there is no " + name);
}

TEST(TextureExport, GlbHoldsWhatIsUsed) {
  const TemporaryFolder folder;
  Scene scene;
  scene.write(folder / "m.glb");
  const nlohmann::json json = glb_json(folder / "m.glb");
  EXPECT_EQ(json["images"].size(), 4u) << "bark, a leaf for two materials, the picture, noise";
  EXPECT_EQ(json["materials"].size(), 6u);
  EXPECT_EQ(named(json["materials"], "leaf_green")["alphaMode"], "MASK");
  EXPECT_EQ(named(json["materials"], "leaf_green")["alphaCutoff"], 0.25);
  EXPECT_EQ(named(json["materials"], "bare")["alphaMode"], "BLEND");
  EXPECT_EQ(named(json["materials"], "bark")["doubleSided"], true);
  EXPECT_FALSE(named(json["materials"], "bark").contains("alphaMode"));
  EXPECT_TRUE(named(json["materials"], "picture").contains("emissiveTexture"));
  EXPECT_NE(read_file(folder / "m.glb").find(scene.picture), std::string::npos) << "the file's own bytes";
  std::size_t plain = 0;
  for (const auto& mesh : json["meshes"]) plain += !mesh["primitives"][0]["attributes"].contains("TEXCOORD_0");
  EXPECT_EQ(plain, 1u) << "texture coordinates only where there is a texture";
}

TEST(TextureExport, ModelsWithoutTexturesHaveNoneOfIt) {
  const TemporaryFolder folder;
  export_model(folder / "m.glb", mixed_model(), primitive_table(), two_materials(), test_provenance());
  const std::string bytes = read_file(folder / "m.glb");
  for (const char* word : {"TEXCOORD", "images", "samplers", "textures", "MASK"})
    EXPECT_EQ(std::string(*find_glb_json(bytes)).find(word), std::string::npos) << word;
  export_model(folder / "m.obj", mixed_model(), primitive_table(), two_materials(), test_provenance());
  EXPECT_EQ(read_file(folder / "m.obj").find("\nvt "), std::string::npos);
  EXPECT_EQ(folder.file_count(), 3u);
}

TEST(TextureExport, GlbPassesTheValidator) {
  const TemporaryFolder folder;
  Scene scene;
  scene.write(folder / "m.glb");
  const std::string path = folder / "m.glb";
  const std::string command = "node '" ESPALIER_SOURCE_DIR "/tests/io/validate_gltf.mjs' '" + path + "' 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, pipe)) output.append(block, n);
  ASSERT_EQ(::pclose(pipe), 0) << output;
  const nlohmann::json report = nlohmann::json::parse(output);
  EXPECT_EQ(report["numErrors"], 0) << output;
  EXPECT_EQ(report["numWarnings"], 0) << output;
  EXPECT_EQ(report["numHints"], 0) << output;
}

/// Largest texture coordinates of the parts called `material`; both formats must agree.
void expect_repeats(const aiScene& scene, const std::string& material, float across, float up) {
  float u = 0, v = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    aiString name;
    scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
    if (material != name.C_Str()) continue;
    ASSERT_TRUE(mesh.HasTextureCoords(0));
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      u = std::max(u, mesh.mTextureCoords[0][k].x);
      v = std::max(v, mesh.mTextureCoords[0][k].y);
      EXPECT_GE(mesh.mTextureCoords[0][k].x, -1e-5f);
    }
  }
  EXPECT_NEAR(u, across, 1e-4f);
  EXPECT_NEAR(v, up, 1e-4f);
}

TEST(TextureExport, AssimpReadsGlbAndObjAlike) {
  const TemporaryFolder folder;
  Scene scene;
  for (const char* name : {"m.glb", "m.obj"}) {
    scene.write(folder / name);
    Assimp::Importer importer;
    const aiScene* read = importer.ReadFile(folder / name, 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    expect_repeats(*read, "bark", 2, 3);
    expect_repeats(*read, "leaf_green", 1, 1);
    unsigned textured = 0;
    for (unsigned i = 0; i < read->mNumMaterials; ++i) {
      aiString file;
      if (read->mMaterials[i]->GetTexture(aiTextureType_DIFFUSE, 0, &file) != aiReturn_SUCCESS) continue;
      ++textured;
      if (name == std::string("m.obj")) {
        int w = 0, h = 0, channels = 0;
        stbi_uc* pixels = stbi_load((folder / file.C_Str()).c_str(), &w, &h, &channels, 4);
        EXPECT_NE(pixels, nullptr) << file.C_Str();
        stbi_image_free(pixels);
      } else {
        EXPECT_NE(read->GetEmbeddedTexture(file.C_Str()), nullptr);
      }
    }
    EXPECT_EQ(textured, 5u) << name;
  }
  const std::string mtl = read_file(folder / "m.mtl");
  EXPECT_NE(mtl.find("map_Kd m-texture-1.png"), std::string::npos);
  EXPECT_NE(mtl.find("map_d m-texture-2.png"), std::string::npos) << "the leaf is transparent";
  EXPECT_EQ(mtl.find("map_d m-texture-1.png"), std::string::npos);
  EXPECT_EQ(read_provenance(folder / "m-texture-1.png"), test_provenance());
}

TEST(TextureExport, TheSameBytesEachTime) {
  const TemporaryFolder folder;
  for (const char* name : {"a.glb", "b.glb"}) Scene().write(folder / name);
  EXPECT_EQ(read_file(folder / "a.glb"), read_file(folder / "b.glb"));
}

TEST(TextureExport, PlyTakesTheMeanColour) {
  Scene scene;
  const Surfaces surfaces(*scene.graph, scene.model, scene.textures);
  for (std::uint16_t i = 0; i < surfaces.size(); ++i) {
    const TexturePicture* const picture = surfaces.texture(i);
    if (!picture || picture->name != "tiny") continue;
    EXPECT_NEAR(picture->mean.x, 0.5f, 1e-5f) << "two of four pixels are red or white";
  }
}

TEST(ImageImport, ReadsWhatWeWrite) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 4 * 7 * 5; ++i) pixels.push_back(static_cast<std::uint8_t>(37 * i));
  for (const bool opaque : {false, true}) {
    for (std::size_t i = 3; opaque && i < pixels.size(); i += 4) pixels[i] = 255;
    write_file(folder / "a.png", encode_png_with_alpha(7, 5, pixels));
    const ImageFile file = FileImageSource().load(folder / "a.png");
    EXPECT_EQ(file.image.width, 7u);
    EXPECT_EQ(file.image.height, 5u);
    EXPECT_EQ(file.image.rgba, pixels);
    EXPECT_EQ(file.ending, "png");
    EXPECT_EQ(file.bytes, read_file(folder / "a.png"));
  }
}

TEST(ImageImport, DamagedFilesAreErrorsThatNameThem) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> pixels(4 * 64 * 64);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * i >> 3);
  const std::string good = encode_png_with_alpha(64, 64, pixels);
  const auto message = [&](const std::string& bytes) {
    write_file(folder / "x.png", bytes);
    return error_of([&] { FileImageSource().load(folder / "x.png"); });
  };
  EXPECT_EQ(message(good), "");
  for (const std::string& bytes : {std::string(), std::string("hello"), good.substr(0, 20),
                                   good.substr(0, good.size() / 2), good.substr(0, 8) + std::string(500, 'x'),
                                   std::string("\xff\xd8\xff\xe0junk")})
    EXPECT_NE(message(bytes).find("x.png: cannot be used as a texture"), std::string::npos) << message(bytes);
  std::string huge = good;
  huge[16] = 0, huge[17] = 1;  // 65536 + 64 pixels wide
  EXPECT_NE(message(huge).find("pixels"), std::string::npos) << message(huge);
  EXPECT_NE(error_of([&] { FileImageSource().load(folder / "none.png"); }).find("none.png"), std::string::npos);
  for (std::size_t at = 8; at < good.size(); at += 97) {  // any byte may be wrong: an error or a picture, never a crash
    std::string bad = good;
    bad[at] = static_cast<char>(~bad[at]);
    message(bad);
  }
}

TEST(TextureExport, ImportKeepsTextureCoordinates) {
  const TemporaryFolder folder;
  Scene scene;
  scene.write(folder / "m.obj");
  const Mesh mesh = AssimpMeshSource().load(folder / "m.obj");
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  float most = 0;
  for (const Vec2& uv : mesh.uvs) most = std::max(most, uv.y);
  EXPECT_NEAR(most, 3, 1e-4f) << "bark's three repeats upwards";
}

}  // namespace
}  // namespace espalier
