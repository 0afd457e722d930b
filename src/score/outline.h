#pragma once
// Outline: what bounds one part in an image. The outline of a convex part meets a row of pixels at most twice, so it is
// kept as pieces whose least and greatest column in a row bound the part there: straight edges (all of a polyhedron's,
// for those inside do no harm) and ellipses (a sphere's, and the rims of cylinders and cones).

#include <array>
#include <cstdint>
#include <vector>

#include "score/caster.h"

namespace espalier {

/// From row y_low to row y_high > y_low; at row y column x + slope (y - y_low).
struct OutlineEdge {
  float y_low, y_high, x, slope;
};

/// At row y + t / per_half_height, for t = -1..1, columns x + lean t +- half_width sqrt(1 - t^2).
struct OutlineEllipse {
  float x, y, lean, half_width, per_half_height, y_low, y_high;
};

/// Columns and rows of edges and ellipses are relative to `origin`.
struct Outline {
  std::int32_t origin[2] = {0, 0};
  std::int32_t column[2] = {0, 0}, row[2] = {0, 0};  // half-open, within the image: nothing lies outside
  std::vector<OutlineEdge> edges;
  std::vector<OutlineEllipse> ellipses;
};

/// Makes outlines of placed parts; one per thread. No allocation once warm.
class OutlineMaker {
 public:
  explicit OutlineMaker(const Projection& projection) : projection_(projection) {}

  enum class Result : std::uint8_t {
    nothing,    // not in the image
    outline,    // in outline()
    triangles,  // not convex: draw triangle(i) for each i below triangles()
    by_pixel,   // round, and huge or cut by the nearest plane: test the pixels of outline()'s rectangle with `meets`
  };
  Result set(const Caster& caster, const Instance& instance);
  /// Of a part that came out as triangles; false if this one is not in the image.
  bool triangle(std::size_t i);
  std::size_t triangles() const { return caster_->triangles.size(); }
  const Outline& outline() const { return outline_; }

 private:
  struct Pixel {
    double x, y;
  };
  struct Segment {
    Pixel a, b;
  };
  /// A circle or sphere: middle and two or three radii, as homogeneous pixels.
  struct Ball {
    DVec3 middle;
    DVec3 radius[3];
  };
  struct Ellipse {
    Pixel middle;
    double lean, half_width, half_height, per_half_height;
  };

  void place(const Instance& instance, double top);
  void begin();
  void include(const Pixel& p);
  void place_corners(const std::vector<Vec3>& corners);
  Result set_round(double top);
  Result set_sphere();
  Result by_pixel();
  void add_segment(const DVec3& a, const DVec3& b, std::vector<DVec3>* cuts);
  bool add_ellipse(const Ball& ball);
  void add_tangents(const DVec3& bottom, const DVec3& top, double ratio);
  bool open_rectangle();
  bool finish();
  void add_edge(Pixel a, Pixel b);
  void push_edge(const Pixel& a, const Pixel& b);

  Projection projection_;
  Outline outline_;
  const Caster* caster_ = nullptr;
  DVec3 centre_, axis_[3];  // of the part, as homogeneous pixels
  double top_ = 1;
  std::vector<DVec3> corners_, cuts_;
  std::vector<Pixel> pixels_;  // of the corners, if the whole part lies beyond the nearest plane
  bool whole_ = false;
  bool near_ = false;  // all pieces lie within a picture's size of the image
  std::vector<Segment> segments_;
  std::vector<Ellipse> ellipses_;
  Pixel low_, high_;  // of all that was added
};

}  // namespace espalier
