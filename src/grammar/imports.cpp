#include "grammar/imports.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/core.h>

#include "base/error.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class Importer {
 public:
  Importer(std::vector<SourceText>& sources, const ReadImport& read, Diagnostics& diagnostics)
      : sources_(sources), read_(read), diagnostics_(diagnostics) {}

  ast::Grammar run() {
    names_.push_back(fs::path(sources_[0].name).filename().generic_string());
    bytes_ = sources_[0].text.size();
    ast::Grammar whole = parse(sources_[0].text, diagnostics_);
    for (std::size_t file = 1; take_imports(whole, file - 1), file < sources_.size(); ++file) {
      ast::Grammar part = parse(sources_[file].text, diagnostics_, static_cast<std::uint16_t>(file));
      std::erase_if(part.decls, [](const ast::Decl& decl) { return decl.kind == ast::DeclKind::start; });
      std::move(part.decls.begin(), part.decls.end(), std::back_inserter(whole.decls));
    }
    whole.files = std::move(names_);
    return whole;
  }

 private:
  /// Reads what `file` imports and takes those declarations away.
  void take_imports(ast::Grammar& whole, std::size_t file) {
    const auto from_file = [&](const ast::Decl& decl) {
      return decl.kind == ast::DeclKind::import && decl.span.file == file;
    };
    for (const ast::Decl& decl : whole.decls)
      if (from_file(decl)) add(decl, fs::path(names_[file]).parent_path());
    std::erase_if(whole.decls, from_file);
  }

  void add(const ast::Decl& decl, const fs::path& folder) {
    const fs::path path = (folder / decl.name).lexically_normal();
    const auto refuse = [&](const char* code, std::string message, std::string help = {}) {
      diagnostics_.error(code, decl.span, std::move(message), std::move(help));
    };
    const bool outside = fs::path(decl.name).is_absolute() || path.empty() || *path.begin() == "..";
    if (outside)
      return refuse("E0122", fmt::format("imported files lie in or below the grammar's folder, not \"{}\"", decl.name));
    const std::string name = path.generic_string();
    if (std::find(names_.begin(), names_.end(), name) != names_.end()) return;
    if (++imports_ > kMostImports)
      return refuse("E0123", fmt::format("a grammar imports at most {} files", kMostImports));
    if (!read_) return refuse("E0121", fmt::format("there is no folder to import \"{}\" from", decl.name));
    std::string text;
    try {
      text = read_(name);
    } catch (const Error& error) {
      return refuse("E0121", fmt::format("cannot import \"{}\": {}", decl.name, error.what()));
    }
    bytes_ += text.size();
    if (bytes_ > kLargestSource)
      return refuse("E0123", fmt::format("a grammar and its imports have at most {} bytes together", kLargestSource));
    names_.push_back(name);
    sources_.push_back({(fs::path(sources_[0].name).parent_path() / path).generic_string(), std::move(text)});
  }

  std::vector<SourceText>& sources_;
  const ReadImport& read_;
  Diagnostics& diagnostics_;
  std::vector<std::string> names_;  // by file, relative to the grammar's folder
  std::size_t bytes_ = 0, imports_ = 0;
};

}  // namespace

ast::Grammar parse_with_imports(std::vector<SourceText>& sources, const ReadImport& read, Diagnostics& diagnostics) {
  return Importer(sources, read, diagnostics).run();
}

}  // namespace espalier
