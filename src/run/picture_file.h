#pragma once
// PictureFile: a derivation drawn as a PictureRequest asks, as PNG with its provenance.

#include <functional>
#include <map>
#include <string>

#include "run/derivation_file.h"
#include "run/picture_request.h"

namespace espalier {

struct PictureJob {
  PictureRequest request;
  std::string derivation;                         // path of a .derivation.json
  std::string grammar;                            // path; empty: the copy in the folder of its run
  std::map<std::string, std::string> attributes;  // set anew; the derivation is adapted to them
  std::string out;                                // .png; empty: none
  std::string frames;                             // folder for the frames of a turntable, 0001.png ..; empty: none
};

struct PictureReport {
  AdaptedGenes adapted;
  bool truncated = false;  // a budget of the model ran out: it is not whole
  std::vector<std::string> written;
};
/// Draws and writes. Throws Error.
PictureReport write_pictures(const PictureJob& job, MeshSource& source, Executor& executor);

/// The PNG of request.frame, the strip, or the picture, of a derivation whose provenance has these settings: to compare
/// with what was written before. `folder`: where its run lies. Throws Error.
std::string picture_again(const PictureRequest& request, const Derivation& derivation, const Provenance& provenance,
                          const std::string& folder, MeshSource& source, Executor& executor);

}  // namespace espalier
