#pragma once
// ModelFiles: the files that show one derivation: its model in any format, its picture, its genes.

#include <array>
#include <string>
#include <vector>

#include "base/executor.h"
#include "io/provenance.h"
#include "model/expand.h"
#include "model/level_of_detail.h"
#include "model/texture_table.h"
#include "render/render.h"
#include "run/input_files.h"

namespace espalier {

/// What to say of models that did not fit (Model::truncated).
inline constexpr const char* kTruncated =
    "truncated: a model has at most 1 000 000 parts and calls of details, 4 000 000 copies of genes, 16 000 000 turns "
    "of loops and 100 000 of one; the rest is left out";

class ModelFiles {
 public:
  /// All but `look` must outlive it. `ghosts`: target meshes shown in pictures; `look`: of pictures.
  ModelFiles(const GeneratorGraph& graph, const MeshTable& meshes, const TextureTable& textures,
             const std::vector<Mesh>& ghosts, const RenderSettings& look, Executor& executor);

  /// By the ending of `path`: .glb .obj .ply .stl with details, .png, .json (the derivation). Meshes are made as
  /// `provenance.mesh` says, so that a file is made again as it was. Triangles of a model; else 0. Throws Error.
  std::uint64_t write(const Derivation& derivation, const std::string& path, const Provenance& provenance);
  struct LevelFile {
    std::string name;  // without folder
    std::uint64_t triangles = 0;
  };
  /// The model, grown once, at every level of `detail`, the finest first: for `path` = DIR/NAME.glb DIR/NAME-lod0.glb ..
  /// with the provenance and how it was made. Throws Error.
  std::vector<LevelFile> write_levels(const Derivation& derivation, const std::string& path, LevelOfDetail detail,
                                      Provenance provenance);
  Picture picture(const Derivation& derivation);
  Picture picture(const Derivation& derivation, std::array<std::uint32_t, 2> size);
  /// With details; stays until the next call.
  const Model& model_of(const Derivation& derivation);
  /// Of the derivation last written or drawn.
  const Model& model() const { return model_; }
  /// Its materials with their textures.
  Surfaces surfaces() { return Surfaces(graph_, model_, textures_); }

 private:
  /// Of model_.
  std::uint64_t export_as(const std::string& path, const Provenance& provenance);

  const GeneratorGraph& graph_;
  const MeshTable& meshes_;
  TextureTable textures_;
  const std::vector<Mesh>& ghosts_;
  RenderSettings look_;
  Executor& executor_;
  Expander expander_;
  Model model_;
};

/// encode() with the provenance as a member, ending with a newline.
std::string derivation_document(const GeneratorGraph& graph, const Derivation& derivation,
                                const Provenance& provenance);

/// What a file says that shows number `index` of what `settings` make, in a folder with its inputs and these settings.
/// `made_by`: see Provenance.
Provenance provenance_in_folder(const std::string& made_by, std::uint64_t seed, std::uint64_t index,
                                const InputFiles& inputs, const std::string& settings, const Derivation& derivation);

/// 64-bit hash as 16 hex digits: how provenance names a derivation.
std::string hash_text(const Derivation& derivation);

}  // namespace espalier
