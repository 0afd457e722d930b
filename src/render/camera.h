#pragma once
// Camera: a pinhole, or parallel rays. It looks at a set of points from a given side, as near as it can with all of
// them in the picture, or stands where it is told to.

#include <cstdint>
#include <span>

#include "base/vec.h"
#include "render/ray.h"

namespace espalier {

/// Half the sides of the picture: tangents of angles, for parallel rays lengths.
struct Lens {
  float x = 0.3f, y = 0.25f;
  bool parallel = false;
};

/// About 27 degrees along the longer side.
Lens long_lens(std::uint32_t width, std::uint32_t height);
/// `fov_deg`: vertical angle of view, above 0 and below 180.
Lens lens_of_angle(float fov_deg, std::uint32_t width, std::uint32_t height);
/// Parallel rays; the picture is `tall` high.
Lens parallel_lens(float tall, std::uint32_t width, std::uint32_t height);

struct Camera {
  Vec3 eye{0, 0, 5};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // unit
  float tan_x = 0.3f, tan_y = 0.25f;                    // of half the angles of view; half the sides if parallel
  bool parallel = false;

  /// The unit direction through the picture point (x, y) in [-1, 1], y upwards.
  Vec3 direction(float x, float y) const;
  /// The ray through that point. From an eye far beyond the scene of unit size it starts nearer, so that distances
  /// along it are exact enough.
  Ray ray(float x, float y) const;
  /// The picture point of p, and in z how far ahead of the eye it lies.
  Vec3 picture_point(const Vec3& p) const;
  /// How wide what one of `height` pixels shows is where a ray has gone so far from the eye.
  float pixel_width(float t, std::uint32_t height) const {
    return 2 * tan_y / static_cast<float>(height) * (parallel ? 1 : t + skipped());
  }

 private:
  float skipped() const;
};

/// Seen from azimuth (0: from +z, 90: from +x) and elevation (-90..90), with no place yet.
Camera camera_from_side(float azimuth_deg, float elevation_deg, const Lens& lens);

/// `margin` is the share of the picture left free at each side. Parallel rays keep their lens: the middle of the points
/// is the middle of the picture.
Camera frame_points(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, const Lens& lens,
                    float margin);
Camera frame_points(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, std::uint32_t width,
                    std::uint32_t height, float margin);

/// As frame_points, with room for all that the points sweep on a turn about the axis x = z = 0; stands square to it.
Camera frame_turning(std::span<const Vec3> points, float azimuth_deg, float elevation_deg, const Lens& lens,
                     float margin);

/// At `eye`, with `at` in the middle. They must differ. Where `up` is y, looking straight down -z is up, straight up
/// +z.
Camera placed_camera(const Vec3& eye, const glm::dvec3& ahead, const Lens& lens, const Vec3& up = {0, 1, 0});

/// The camera gone round the vertical axis through `centre`.
Camera turned(const Camera& camera, const Vec3& centre, float degrees);

}  // namespace espalier
