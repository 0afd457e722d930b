#pragma once
// Viability: whether a model is worth showing to a person at all. It says no, and why, of models that are truncated,
// grow into the ground, are so dense that their parts lie inside each other, are empty, or break a hard limit.
// (Typical failures of random trees: Congdon and Mazza 2003.)

#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "model/model.h"
#include "score/gauge.h"
#include "score/limit.h"

namespace espalier {

struct ViabilitySettings {
  double most_below_ground = 0.05;  // share of the parts' surface below y = 0, 0..1
  double most_crowding = 0.5;       // share of the parts' volume that finds no room (see below), 0..1
  Limits limits;                    // the hard ones (min, max) count; ramps do not

  bool operator==(const ViabilitySettings&) const = default;
};

/// Throws Error stating rule and value.
void validate(const ViabilitySettings& settings);

struct ViabilityReport {
  bool viable = true;
  std::vector<std::string> reasons;  // why it is not: "23 % of it grows below the ground"
  double below_ground = 0;           // share of the surface
  double crowding = 0;               // share of the volume
  PerMeasure<double> measures;       // all of them, with details
};

class Viability {
 public:
  /// The memory of one thread.
  struct Scratch {
    Gauge::Scratch gauge;
    std::vector<float> filled;  // m3 per cell
  };

  /// Throws Error for bad settings.
  Viability(const MeshTable& meshes, const ViabilitySettings& settings);

  /// `model`: of the derivation, with details. Boxes stand for parts. Crowding: a grid of 24 cells along the longest
  /// side of the model; what a cell's parts have more volume than the cell must lie inside each other. A lower bound
  /// of the overlap, in one pass.
  ViabilityReport judge(const Derivation& derivation, const Model& model, Scratch& scratch) const;

 private:
  struct MeshFacts {
    Bounds box;
    double volume = 0;  // m3; of cones: with top = 1
    bool cone = false;
  };
  double below_ground(const Model& model) const;
  double crowding(const Model& model, Scratch& scratch) const;
  double fill(const Model& model, const Vec3& corner, float cell, std::vector<float>& filled) const;

  ViabilitySettings settings_;
  Gauge gauge_;
  std::vector<MeshFacts> meshes_;
};

}  // namespace espalier
