#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "derivation/encode.h"
#include "derivation/gene_reader.h"

namespace espalier {
namespace {

[[noreturn]] void fail(const std::string& what) { throw Error("derivation: " + what); }

/// Receives the events of nlohmann's parser, so no document is ever built.
class Document final : public nlohmann::json_sax<nlohmann::json> {
 public:
  Document(const GeneratorGraph& graph, std::uint32_t most_genes, Fit fit)
      : graph_(graph), genes_(graph, most_genes), fit_(fit) {}

  Derivation finish();

  bool null() override { return scalar("null"); }
  bool boolean(bool value) override { return scalar(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return scalar(fmt::format("{}", value)); }
  bool number_float(number_float_t, const string_t& text) override { return scalar(text); }
  bool number_unsigned(number_unsigned_t value) override;
  bool string(string_t& value) override;
  bool binary(binary_t&) override { return scalar("binary"); }
  bool start_object(std::size_t) override;
  bool end_object() override;
  bool key(string_t& name) override;
  bool start_array(std::size_t) override;
  bool end_array() override;
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    fail(fmt::format("{}: not JSON at byte {}: {}", where(), position, error.what()));
  }

 private:
  enum class Place : std::uint8_t { outside, document, genes, gene, draws, skipped, done };
  static constexpr std::array<std::string_view, 6> kMembers = {"espalier_derivation", "grammar", "grammar_hash",
                                                              "detail_seed", "genes", "provenance"};
  enum Member : std::size_t { version, grammar, grammar_hash, detail_seed, genes, provenance };

  std::string where() const;
  bool scalar(std::string_view value) {
    if (place_ != Place::skipped) fail(fmt::format("{}: {} is not expected here", where(), value));
    return true;
  }
  void take_text(const std::string& value);
  void take_seed(const std::string& value);

  const GeneratorGraph& graph_;
  GeneReader genes_;
  Fit fit_;
  Place place_ = Place::outside;
  std::size_t member_ = kMembers.size();  // the one being read
  std::array<bool, kMembers.size()> seen_{};
  std::size_t skip_depth_ = 0;            // open brackets within "provenance"
  std::uint64_t detail_seed_ = 0;
};

std::string Document::where() const {
  if (place_ == Place::gene || place_ == Place::draws) return genes_.where();
  if (place_ == Place::genes) return fmt::format("genes, after {}", genes_.size());
  if (place_ == Place::document && member_ < kMembers.size()) return std::string(kMembers[member_]);
  return "document";
}

void Document::take_seed(const std::string& value) {
  constexpr std::size_t kDigits = 16;
  const char* end = value.data() + value.size();
  const auto [stop, status] = std::from_chars(value.data(), end, detail_seed_, 16);
  const bool upper = std::any_of(value.begin(), value.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  if (value.size() != kDigits || stop != end || status != std::errc() || upper) {
    fail(fmt::format("detail_seed: must be 16 lower-case hexadecimal digits, got \"{}\"", value));
  }
}

void Document::take_text(const std::string& value) {
  const auto must_be = [&](const std::string& expected) {
    if (value == expected || fit_ != Fit::same_grammar) return;
    fail(fmt::format("{}: made by \"{}\", but the grammar at hand is \"{}\"", kMembers[member_], value, expected));
  };
  switch (member_) {
    case grammar: return must_be(graph_.name);
    case grammar_hash: return must_be(graph_.source_hash);
    case detail_seed: return take_seed(value);
    default: fail(fmt::format("{}: \"{}\" is not expected here", where(), value));
  }
}

bool Document::number_unsigned(number_unsigned_t value) {
  if (place_ == Place::draws) {
    genes_.take_draw(value);
  } else if (place_ == Place::gene) {
    genes_.take_variant_index(value);
  } else if (place_ == Place::document && member_ == version) {
    if (value != kDerivationVersion) {
      fail(fmt::format("espalier_derivation: version {} is not known, only {}", value, kDerivationVersion));
    }
  } else {
    return scalar(fmt::format("{}", value));
  }
  return true;
}

bool Document::string(string_t& value) {
  if (place_ == Place::gene) {
    genes_.take_text(value);
  } else if (place_ == Place::document) {
    take_text(value);
  } else {
    return scalar(fmt::format("\"{}\"", value));
  }
  return true;
}

bool Document::start_object(std::size_t) {
  if (place_ == Place::skipped) {
    ++skip_depth_;
  } else if (place_ == Place::outside) {
    place_ = Place::document;
  } else if (place_ == Place::document && member_ == provenance) {
    place_ = Place::skipped;
    skip_depth_ = 1;
  } else {
    return scalar("an object");
  }
  return true;
}

bool Document::end_object() {
  if (place_ == Place::document) {
    place_ = Place::done;
  } else if (--skip_depth_ == 0) {
    place_ = Place::document;
  }
  return true;
}

bool Document::key(string_t& name) {
  if (place_ == Place::skipped) return true;
  member_ = static_cast<std::size_t>(std::find(kMembers.begin(), kMembers.end(), name) - kMembers.begin());
  if (member_ == kMembers.size()) fail(fmt::format("document: member \"{}\" is not known", name));
  if (seen_[member_]) fail(fmt::format("document: member \"{}\" stands twice", name));
  seen_[member_] = true;
  return true;
}

bool Document::start_array(std::size_t) {
  if (place_ == Place::skipped) {
    ++skip_depth_;
  } else if (place_ == Place::document && member_ == genes) {
    place_ = Place::genes;
  } else if (place_ == Place::genes) {
    place_ = Place::gene;
    genes_.begin_gene();
  } else if (place_ == Place::gene) {
    genes_.begin_draws();
    place_ = Place::draws;
  } else {
    return scalar("an array");
  }
  return true;
}

bool Document::end_array() {
  switch (place_) {
    case Place::draws: place_ = Place::gene; break;
    case Place::gene: genes_.end_gene(); place_ = Place::genes; break;
    case Place::genes: place_ = Place::document; break;
    default: --skip_depth_; break;  // within "provenance", which is an object: never the last bracket
  }
  return true;
}

Derivation Document::finish() {
  for (std::size_t m = 0; m < kMembers.size(); ++m) {
    if (m != provenance && !seen_[m]) fail(fmt::format("document: member \"{}\" is missing", kMembers[m]));
  }
  Derivation derivation = genes_.finish();
  derivation.detail_seed = detail_seed_;
  if (const std::string fault = find_fault(graph_, derivation, fit_); !fault.empty()) fail(fault);
  return derivation;
}

}  // namespace

Derivation decode(const GeneratorGraph& graph, std::string_view json, std::uint32_t most_genes, Fit fit) {
  Document document(graph, most_genes, fit);
  nlohmann::json::sax_parse(json.begin(), json.end(), &document);
  return document.finish();
}

}  // namespace espalier
