// What a lens does to an image, undone: radii about a centre.
//
// A point m of the image and its place U(m) in a picture without distortion, both in px:
//   U(m) = c + (m - c) (1 + k1 r^2 + k2 r^4 + k3 r^6)      r = |m - c| / scale
// From the image to the straight picture in closed form; Brown's model, read backwards;
// the third number makes up for what two of it become on the way back. After it a
// plane is mapped by a homography: lines are straight.
#ifndef DHCAL_TOOLS_CAMERA_LENS_H_
#define DHCAL_TOOLS_CAMERA_LENS_H_

#include <Eigen/Core>

namespace dhcal {

/// Numbers of a lens: centre u, v [px], k1, k2, k3.
constexpr int kLensNumbers = 5;
using LensNumbers = Eigen::Matrix<double, kLensNumbers, 1>;
using LensCovariance = Eigen::Matrix<double, kLensNumbers, kLensNumbers>;

struct Lens {
  int width = 0, height = 0;  // of the images [px]
  double scale = 1;           // [px], radius that k1, k2 and k3 refer to
  /// Centre of the distortion, and the point whose sight a reading is about.
  LensNumbers numbers = LensNumbers::Zero();
  /// Of the numbers; zero where they are taken as exact.
  LensCovariance covariance = LensCovariance::Zero();

  Eigen::Vector2d centre() const { return numbers.head<2>(); }
};

/// No distortion; the centre is that of the image, (width - 1) / 2: pixels count from 0 at their
/// middles. The scale is half the image's diagonal.
Lens PlainLens(int width, int height);

/// U(m) - c, by `numbers` of any scalar.
template <typename T>
Eigen::Matrix<T, 2, 1> FromCentre(const Eigen::Vector2d& m, const T* numbers, double scale) {
  const Eigen::Matrix<T, 2, 1> x(m.x() - numbers[0], m.y() - numbers[1]);
  const T r2 = x.squaredNorm() / (scale * scale);
  return x * (1.0 + r2 * (numbers[2] + r2 * (numbers[3] + r2 * numbers[4])));
}

/// U(m) [px].
Eigen::Vector2d Straightened(const Lens& lens, const Eigen::Vector2d& m);

/// Whether radii grow with radii all over the image, so that no two points become one.
bool KeepsOrder(const Lens& lens);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_LENS_H_
