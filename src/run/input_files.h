#pragma once
// Input files: copies of everything that a run reads, under names that work inside its folder.

#include <map>
#include <string>
#include <vector>

#include "run/grammar_file.h"

namespace espalier {

struct InputFile {
  std::string name;   // "inputs/spaceship.esp": in the run folder, and in provenance
  std::string bytes;
  std::string hash;   // content_hash
};

class InputFiles {
 public:
  /// Takes the grammar, its imports and the mesh and image files that it names, keeping where they lie relative to each
  /// other. Throws Error.
  void add_grammar(const LoadedGrammar& grammar);
  /// Takes a target's mesh or image; the same file twice is stored once. Returns its name.
  std::string add_target(const std::string& path);

  /// Takes the derivations that a search starts from.
  const InputFile& add_start(const std::string& path);

  const std::string& grammar_name() const { return grammar_name_; }
  const std::vector<InputFile>& files() const { return files_; }
  /// name -> hash, for provenance.
  std::map<std::string, std::string> hashes() const;
  /// Writes all below `folder`. Throws Error.
  void write(const std::string& folder) const;

 private:
  std::string add(const std::string& name, std::string bytes);

  std::string grammar_name_;
  std::vector<InputFile> files_;
};

}  // namespace espalier
