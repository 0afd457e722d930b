#pragma once
// CurveDrawing: a scene's guiding curves, with what belongs to them, as solid things to draw: wires, the bones of a
// model, and ghosts; and where a camera sees all of it.

#include <vector>

#include "render/line_drawing.h"
#include "render/render.h"
#include "run/curve_marks.h"

namespace espalier {

/// What curves are drawn with. All must outlive it.
struct CurveStage {
  const CurveTarget& curves;
  const MeshTable& meshes;            // of the model
  const std::vector<Mesh>& targets;   // the scene's meshes, in their places
};

class CurveDrawing {
 public:
  /// `marked`: of the model; an empty model is one, too.
  CurveDrawing(const CurveStage& stage, const Model& model, const MarkedCurves& marked);

  /// Segments in the colours of their marks.
  const LineDrawing& wires() const { return wires_; }
  const LineDrawing& wires_and_bones() const { return all_; }
  /// The scene's meshes, thickness, and the region of a density.
  const std::vector<Mesh>& ghosts() const { return ghosts_; }
  /// From the side that `look` says, to see the curves, the ghosts and the model whole; or look.place.
  CameraPlace place(const RenderSettings& look) const;
  /// The same for a turntable: it sees all of it from all sides.
  CameraPlace turning_place(const RenderSettings& look) const;

 private:
  /// A curve as it is drawn: so many pieces, equal in the parameter.
  struct Polyline {
    std::vector<Vec3> points;
    std::vector<std::uint16_t> inks;  // per piece: the mark of its segment
  };
  static Polyline polyline(const CurveCost& cost, std::uint32_t curve, const std::vector<std::uint8_t>& uses);
  void add_ghosts(const CurveStage& stage);
  void measure(const CurveStage& stage, const Model& model, const std::vector<Polyline>& lines);

  LineDrawing wires_, all_;
  std::vector<Mesh> ghosts_;
  std::vector<Vec3> points_;  // that the camera shall show
  Bounds box_;
};

/// A closed mesh around a curve: the points within its thickness of it. Empty where it has none.
Mesh thickness_tube(const GuidingCurve& guide);

}  // namespace espalier
