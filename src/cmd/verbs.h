#pragma once
// The verbs of the program: each does what its options ask, prints, and returns the exit code: 0 done, 1 a comparison
// failed or there is no result, 2 bad input (also by throwing Error).

#include "cmd/options.h"

namespace espalier {

inline constexpr int kDone = 0;
inline constexpr int kDiffers = 1;
inline constexpr int kBadInput = 2;

int check_verb(const CheckOptions& options);
int format_verb(const FormatOptions& options);
int import_verb(const ImportOptions& options);
int sample_verb(const SampleOptions& options);
int breed_verb(const BreedOptions& options);
int run_verb(const RunVerbOptions& options);
int compare_verb(const CompareOptions& options);
int sweep_verb(const SweepOptions& options);
int preview_verb(const PreviewOptions& options);
int score_verb(const ScoreOptions& options);
int inspect_verb(const InspectOptions& options);
int reproduce_verb(const ReproduceOptions& options);
int export_verb(const ExportVerbOptions& options);
int render_verb(const RenderOptions& options);
int similarity_verb(const SimilarityOptions& options);
int graph_verb(const GraphOptions& options);
int explain_verb(const ExplainOptions& options);
int studio_verb(const StudioOptions& options);

}  // namespace espalier
