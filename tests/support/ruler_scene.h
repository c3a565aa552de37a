// Photographs of a ruler, calculated: a pinhole camera with a pose and Brown's distortion over a
// ruled plane. Independent of the code that reads them: poses and rays, no pencils or radii undone.
#ifndef DHCAL_TESTS_SUPPORT_RULER_SCENE_H_
#define DHCAL_TESTS_SUPPORT_RULER_SCENE_H_

#include <cstdint>
#include <set>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/rng.h"

namespace dhcal {

/// Something dark or bright on the ruler, with a soft rim.
struct Speck {
  Eigen::Vector2d at;    // [mm], on the ruler
  Eigen::Vector2d axes;  // [mm]
  double angle = 0;
  double brightness = 0;
};

struct RulerScene {
  // The camera. Points of it look along z; x to the right, y down in the image.
  int width = 640, height = 480;
  double focal = 1000;  // [px]
  Eigen::Vector2d centre{319.5, 239.5};
  double k1 = 0, k2 = 0;  // Brown: x_d = x (1 + k1 r^2 + k2 r^4) in the plane z = 1
  double blur = 0.8;      // Gaussian [px]
  double noise = 0;       // of full scale
  // X_RC: pose of the camera on the ruler R: x along the rulings' numbers, z out of the face [mm].
  Eigen::Isometry3d X_RC = Eigen::Isometry3d::Identity();
  // The ruler.
  double pitch = 1, line = 0.3;                  // [mm]
  double low = -6, high = 6;                     // the rulings' ends across the ruler [mm]
  double body_low = -9, body_high = 9;           // the ruler's
  double paper = 0.8, ink = 0.15, ground = 0.3;  // brightnesses
  std::set<int> missing;
  std::vector<int> scratched;
  std::vector<Speck> specks;
  double light_u = 0, light_v = 0, light_r = 0;  // uneven light: slopes over the image, and a spot
  std::uint64_t seed = 1;                        // of the noise
};

/// Where the image's point sees the ruler: x [mm]. Exact.
double RulerXAt(const RulerScene& scene, const Eigen::Vector2d& m);

/// RulerXAt the camera's centre: what a reading of the scene should be.
double TrueReading(const RulerScene& scene);

/// Where a point of the ruler appears.
Eigen::Vector2d ImageOf(const RulerScene& scene, const Eigen::Vector2d& p_R);

/// Where a point of the image would be without distortion.
Eigen::Vector2d WithoutDistortion(const RulerScene& scene, const Eigen::Vector2d& m);

/// Brightness by rows, 0 to 1. `samples` x `samples` rays for each pixel; across a ruling's flank a
/// ray sees the integral over the blur's Gaussian. Not rounded, not limited.
std::vector<float> Render(const RulerScene& scene, int samples = 1);

/// A camera at `x` [mm] along the ruler, `stand_off` [mm] above it, tilted by rotations [rad] about
/// its own axes x, y and z.
Eigen::Isometry3d CameraOver(double x, double y, double stand_off, const Eigen::Vector3d& tilt);

/// How bad it may be.
struct SceneFamily {
  double tilt = 0.43;       // [rad] about each axis
  double distortion = 0.2;  // |k1|
  bool dirt = true;
  int specks = 12;              // at most
  int lost = 1, scratches = 1;  // rulings near the middle
  double largest_noise = 0.03;
  double largest_blur = 2;
};

/// One member, by its seed.
RulerScene RandomScene(const SceneFamily& family, std::uint64_t seed);

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_RULER_SCENE_H_
