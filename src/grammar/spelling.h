#pragma once
// "Did you mean ...?": the nearest known word to one that is not known.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// The candidate with the smallest edit distance (insert, delete, replace, swap neighbours), the first of equals; empty
/// where none is within a third of the word's length (at least 1). Letter case counts half a step; words of one or two
/// letters may differ in case alone.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

/// "did you mean `X`?" or empty.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace espalier
