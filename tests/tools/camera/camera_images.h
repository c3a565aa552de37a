// Calculated photographs as OpenCV's images.
#ifndef DHCAL_TESTS_TOOLS_CAMERA_CAMERA_IMAGES_H_
#define DHCAL_TESTS_TOOLS_CAMERA_CAMERA_IMAGES_H_

#include <cmath>
#include <vector>

#include <Eigen/QR>
#include <opencv2/core.hpp>

#include "tests/support/ruler_scene.h"
#include "tools/camera/lens.h"

namespace dhcal {

/// 8 or 16 bits, as a camera would give it.
inline cv::Mat Photograph(const RulerScene& scene, int depth = CV_8U, int samples = 1) {
  std::vector<float> brightness = Render(scene, samples);
  const cv::Mat exact(scene.height, scene.width, CV_32F, brightness.data());
  cv::Mat image;
  exact.convertTo(image, depth, depth == CV_16U ? 65535.0 : 255.0);
  return image;
}

/// A scene's lens as ours, exact: k1, k2, k3 of the way back by least squares over the radius,
/// weighted with the area.
inline Lens LensOf(const RulerScene& scene) {
  Lens lens = PlainLens(scene.width, scene.height);
  lens.numbers.head<2>() = scene.centre;
  constexpr int kRadii = 200;
  Eigen::MatrixXd A(kRadii, 3);
  Eigen::VectorXd b(kRadii);
  for (int k = 0; k < kRadii; ++k) {
    const double r = (k + 1.0) / kRadii;
    const Eigen::Vector2d m = scene.centre + Eigen::Vector2d(r * lens.scale, 0);
    const double moved = (WithoutDistortion(scene, m) - m).x() / lens.scale;
    A.row(k) << std::pow(r, 3), std::pow(r, 5), std::pow(r, 7);
    A.row(k) *= std::sqrt(r);
    b[k] = moved * std::sqrt(r);
  }
  lens.numbers.tail<3>() = A.colPivHouseholderQr().solve(b);
  return lens;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_TOOLS_CAMERA_CAMERA_IMAGES_H_
