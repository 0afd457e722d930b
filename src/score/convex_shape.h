#pragma once
// ConvexShape: one placed part that a row along z enters at most once, in exact terms and double precision. The kernel
// derives its float forms from it; shapes too large or too ill-conditioned for floats are drawn by `column` itself.

#include <cstdint>
#include <vector>

#include "score/lattice.h"
#include "score/solid.h"

namespace espalier {

struct ConvexShape {
  SolidKind kind = SolidKind::nothing;
  std::int32_t origin[3];  // a lattice point near the part and in the window; coordinates below are relative to it
  Reach reach;             // lattice points that may be covered, clipped to the window
  double l[3][3], t[3];    // local = l * (lattice - origin) + t
  double extent[3];        // half the size of the part's box, in cells; not clipped
  double radius = 0, taper = 0;  // round: radius + taper * local y
  std::vector<Plane> planes;     // convex and prism: normal . (lattice - origin) <= offset, caps of prisms not included

  /// Local coordinates that lie within +-1/2: the first `slabs` rows named here.
  int slabs = 0;
  int slab_row[3] = {0, 1, 2};

  /// Places a solid of any kind but nothing and facets. False: it covers nothing.
  bool set(const Lattice& lattice, const Solid& solid, const GridPlacement& placement, float top);

  /// The interval of z (relative to origin) inside the shape above (x, y), relative too; empty if low >= high.
  void column(double x, double y, double& low, double& high) const;

  /// All eight corners of the reach lie inside: then all of it does.
  bool fills_reach() const;

 private:
  bool invert(const GridPlacement& placement, const Solid& solid);
  void set_extent(const Solid& solid, const GridPlacement& placement, double top);
  void set_origin(const Lattice& lattice, const double centre[3]);
  void set_planes(const Solid& solid, double top);
  void clip_to_sphere(double x, double y, double& low, double& high) const;
  void clip_to_round(double x, double y, double& low, double& high) const;
};

/// If the part is a box with faces along the lattice (to 1e-5 of a cell): its lattice points. `covers` is false where
/// it is thinner than a millionth of a cell.
bool aligned_box(const Lattice& lattice, const GridPlacement& placement, Reach& reach, bool& covers);

}  // namespace espalier
