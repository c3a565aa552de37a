#include "tools/camera/lens.h"

#include <cmath>

namespace dhcal {

Lens PlainLens(int width, int height) {
  Lens lens;
  lens.width = width;
  lens.height = height;
  lens.scale = 0.5 * std::hypot(width, height);
  lens.numbers << 0.5 * (width - 1), 0.5 * (height - 1), 0, 0, 0;
  return lens;
}

Eigen::Vector2d Straightened(const Lens& lens, const Eigen::Vector2d& m) {
  return lens.centre() + FromCentre(m, lens.numbers.data(), lens.scale);
}

bool KeepsOrder(const Lens& lens) {
  double largest = 0;
  for (const double u : {0.0, lens.width - 1.0}) {
    for (const double v : {0.0, lens.height - 1.0}) {
      largest = std::fmax(largest, (Eigen::Vector2d(u, v) - lens.centre()).norm() / lens.scale);
    }
  }
  constexpr int kSteps = 100;
  for (int step = 0; step <= kSteps; ++step) {
    const double r2 = std::pow(largest * step / kSteps, 2);
    const double grows =
        1 + r2 * (3 * lens.numbers[2] + r2 * (5 * lens.numbers[3] + r2 * 7 * lens.numbers[4]));
    if (grows <= 0) return false;
  }
  return true;
}

}  // namespace dhcal
