#include "grammar/words.h"

#include <algorithm>
#include <array>

namespace espalier {
namespace {

using enum BuiltinSort;

// Sorted by name, for the binary search.
constexpr std::array kBuiltins = {
    Builtin{"abs", function, 1, 1},
    Builtin{"acos", function, 1, 1},
    Builtin{"angle", distribution, 0, 0},
    Builtin{"asin", function, 1, 1},
    Builtin{"atan2", function, 2, 2},
    Builtin{"bark_texture", texture, 0, 8, "dark light furrows contrast waves cracks bands seed"},
    Builtin{"box", primitive, 0, 0},
    Builtin{"ceil", function, 1, 1},
    Builtin{"chance", distribution, 1, 1},
    Builtin{"childless", value},
    Builtin{"clamp", function, 3, 3},
    Builtin{"cone", primitive, 0, 2, "top sides"},
    Builtin{"cos", function, 1, 1},
    Builtin{"cross", function, 2, 2},
    Builtin{"cylinder", primitive, 0, 1, "sides"},
    Builtin{"depth", value, 1, 1},
    Builtin{"dot", function, 2, 2},
    Builtin{"exp", function, 1, 1},
    Builtin{"floor", function, 1, 1},
    Builtin{"image_texture", texture, 1, 1, "file"},
    Builtin{"integer", distribution, 2, 2},
    Builtin{"leaf", primitive, 0, 0},
    Builtin{"leaf_texture", texture, 0, 9, "color vein width tip teeth lobes veins wilt seed"},
    Builtin{"length", function, 1, 1},
    Builtin{"log", function, 1, 1},
    Builtin{"loguniform", distribution, 2, 2},
    Builtin{"max", function, 2, 2},
    Builtin{"min", function, 2, 2},
    Builtin{"mix", function, 3, 3},
    Builtin{"noise_texture", texture, 0, 9, "a b cells octaves contrast warp ridges stretch seed"},
    Builtin{"normal", distribution, 4, 4},
    Builtin{"normalize", function, 1, 1},
    Builtin{"pick", distribution, 2, 256},
    Builtin{"pyramid", primitive, 0, 0},
    Builtin{"quad", primitive, 0, 0},
    Builtin{"round", function, 1, 1},
    Builtin{"scope", value},
    Builtin{"sin", function, 1, 1},
    Builtin{"smooth", function, 3, 3},
    Builtin{"sphere", primitive, 0, 0},
    Builtin{"sqrt", function, 1, 1},
    Builtin{"surface", surface, 1, 11,
            "color roughness metal opacity glow cutout two_sided texture tiles tiles_up metres"},
    Builtin{"tan", function, 1, 1},
    Builtin{"uniform", distribution, 2, 2},
    Builtin{"vec", function, 1, 1},
    Builtin{"wedge", primitive, 0, 0},
};

constexpr auto kKeywords = std::to_array<std::string_view>({
    "aim",   "and",   "around",    "as",     "at",      "attr",  "bone",   "by",       "choose", "comp",   "const",
    "detail", "else", "emit",      "extrude", "false",  "fn",    "for",    "forward",  "grammar", "if",    "import",
    "in",    "is",    "let",       "limit",  "material", "maybe", "mesh",  "mirror",   "mod",    "move",   "not",
    "or",    "otherwise", "paint", "pitch",  "proxy",   "reflect", "repeat", "reseed", "resize", "roll",   "rule",
    "scale", "size",  "spawn",     "split",  "start",   "toward", "true",  "turn",     "when",   "yaw",    "~",
});

constexpr auto kStatementWords = std::to_array<std::string_view>({
    "aim",    "around", "bone",  "choose", "comp",   "detail", "emit",  "extrude", "for",   "forward",
    "if",     "let",    "maybe", "mirror", "move",   "paint",  "pitch", "reflect", "reseed", "resize",
    "roll",   "scale",  "size",  "spawn",  "split",  "turn",   "yaw",   "{",
});

constexpr auto kDeclarationWords = std::to_array<std::string_view>({
    "attr", "const", "detail", "fn", "import", "material", "mesh", "rule", "start",
});

static_assert(std::is_sorted(kKeywords.begin(), kKeywords.end()));
static_assert(std::is_sorted(kBuiltins.begin(), kBuiltins.end(),
                             [](const Builtin& a, const Builtin& b) { return a.name < b.name; }));

template <typename Words>
bool among(const Words& words, std::string_view word) {
  return std::binary_search(words.begin(), words.end(), word);
}

}  // namespace

std::span<const Builtin> builtins() { return kBuiltins; }

const Builtin* find_builtin(std::string_view name) {
  const auto found = std::lower_bound(kBuiltins.begin(), kBuiltins.end(), name,
                                      [](const Builtin& b, std::string_view n) { return b.name < n; });
  return found != kBuiltins.end() && found->name == name ? &*found : nullptr;
}

bool is_keyword(std::string_view word) { return among(kKeywords, word); }
bool is_axis(std::string_view word) { return word == "x" || word == "y" || word == "z"; }
bool is_reserved(std::string_view word) { return is_keyword(word) || is_axis(word) || find_builtin(word); }
std::span<const std::string_view> statement_words() { return kStatementWords; }
std::span<const std::string_view> declaration_words() { return kDeclarationWords; }

}  // namespace espalier
