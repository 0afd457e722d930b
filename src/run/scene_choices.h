#pragma once
// The words that scenes use for enums, shared by reader and writer.

#include <string_view>

#include "run/toml_section.h"
#include "score/silhouette_target.h"
#include "score/volume_target.h"
#include "search/ga_settings.h"

namespace espalier {

inline constexpr Choice<VolumeForm> kVolumeForms[] = {{"linear", VolumeForm::linear},
                                                      {"smootherstep", VolumeForm::smootherstep},
                                                      {"smootherstep-separate", VolumeForm::smootherstep_separate}};
inline constexpr Choice<SilhouetteForm> kSilhouetteForms[] = {{"linear", SilhouetteForm::linear},
                                                              {"smootherstep", SilhouetteForm::smootherstep}};
inline constexpr Choice<VolumeView> kVolumeViews[] = {{"parts", VolumeView::parts}, {"full", VolumeView::full}};
inline constexpr Choice<OverlapCount> kOverlapCounts[] = {{"voxels", OverlapCount::voxels},
                                                          {"hits", OverlapCount::hits}};
inline constexpr Choice<SelectionScheme> kSelectionSchemes[] = {{"roulette", SelectionScheme::roulette},
                                                                {"tournament", SelectionScheme::tournament},
                                                                {"random", SelectionScheme::random}};
inline constexpr Choice<Compatibility> kCompatibilities[] = {{"edge", Compatibility::edge},
                                                             {"symbol", Compatibility::symbol}};

template <typename T, std::size_t N>
std::string_view word_for(const Choice<T> (&choices)[N], T value) {
  for (const Choice<T>& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  return "?";
}

}  // namespace espalier
