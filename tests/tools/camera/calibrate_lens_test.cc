// The lens of calculated photographs, found from the rulings alone.
#include "tools/camera/calibrate_lens.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/ruler_scene.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/camera/camera_images.h"
#include "tools/camera/gray_image.h"
#include "tools/camera/lens_file.h"

namespace dhcal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

/// A camera with a lens, over a long ruler; pose `k` of many.
RulerScene Bent(int k) {
  Rng rng(static_cast<std::uint64_t>(900 + k));
  RulerScene scene;
  scene.seed = static_cast<std::uint64_t>(k);
  scene.centre += Vector2d(5, -4);
  scene.k1 = -0.22;
  scene.k2 = 0.05;
  scene.noise = 0.01;
  scene.low = scene.body_low = -9;
  scene.high = scene.body_high = 9;
  scene.specks.push_back({{201, 1}, {0.7, 0.4}, 0.3, 0.1});
  const auto tilt = [&] { return rng.Uniform(-0.3, 0.3); };
  const Vector3d tilts(tilt(), tilt(), tilt());
  scene.X_RC = CameraOver(200 + rng.Uniform(-5, 5), rng.Uniform(-6, 6), rng.Uniform(60, 80), tilts);
  return scene;
}

StraightenedLens Calibrated(int images) {
  std::vector<CountedRulings> counted;
  const Lens plain = PlainLens(640, 480);
  for (int k = 0; k < images; ++k) {
    cv::Mat gray;
    EXPECT_EQ(ToGray(Photograph(Bent(k)), &gray), "");
    counted.push_back(CountRulings(gray, plain, {}));
  }
  return CalibrateLens(plain, counted, {});
}

/// How far lines of the plane are from straight after the lens is undone [px]: largest over a grid
/// of rows of points that a pinhole alone would see in line.
double Crookedness(const Lens& lens, const RulerScene& scene) {
  double worst = 0;
  for (int k = 0; k < 12; ++k) {
    // Of the undistorted picture: lines down and across, bent by the lens, straightened by ours.
    const bool down = k % 2 == 0;
    const double aside = 0.15 * k - 0.8;
    const Vector2d a =
        scene.centre + (down ? Vector2d(290 * aside, -200) : Vector2d(-290, 200 * aside));
    const Vector2d b =
        scene.centre + (down ? Vector2d(250 * aside, 200) : Vector2d(290, 180 * aside));
    std::vector<Vector2d> points;
    for (int step = 0; step <= 20; ++step) {
      const Vector2d wanted = a + (b - a) * step / 20.0;
      const Vector2d x = (wanted - scene.centre) / scene.focal;
      const double r2 = x.squaredNorm();
      points.push_back(Straightened(
          lens, scene.centre + scene.focal * (1 + scene.k1 * r2 + scene.k2 * r2 * r2) * x));
    }
    const Vector2d along = (points.back() - points.front()).normalized();
    for (const Vector2d& point : points) {
      const Vector2d off = point - points.front();
      worst = std::fmax(worst, std::abs(along.x() * off.y() - along.y() * off.x()));
    }
  }
  return worst;
}

TEST(CalibrateLens, StraightensLinesThatWereInNoImage) {
  const StraightenedLens found = Calibrated(10);
  ASSERT_EQ(found.failure, "");
  EXPECT_GE(found.images, 9);
  EXPECT_GT(found.rms_before, 5 * found.rms_after);
  EXPECT_LT(found.rms_after, 0.05);
  EXPECT_GT(Crookedness(PlainLens(640, 480), Bent(0)), 2) << "[px], as photographed";
  EXPECT_LT(Crookedness(found.lens, Bent(0)), 0.05) << "[px]";
  // The centre is where it was put, by its own sigma.
  for (int k = 0; k < 2; ++k) {
    const double sigma = std::sqrt(found.lens.covariance(k, k));
    EXPECT_LT(sigma, 1) << "[px]";
    EXPECT_LT(std::abs(found.lens.centre()[k] - Bent(0).centre[k]), 4 * sigma);
  }
}

TEST(CalibrateLens, ImagesWithoutRulingsAreTooFew) {
  EXPECT_THAT(Calibrated(2).failure, HasSubstr("only 2 images"));
}

TEST(LensFile, ReadsBackExactly) {
  StraightenedLens written;
  written.lens = PlainLens(640, 480);
  written.lens.numbers << 321.1, 238.7, 0.013, -1.0 / 3, 0.1;
  written.lens.covariance.setRandom();
  written.lens.covariance = (written.lens.covariance * written.lens.covariance.transpose()).eval();
  const TempFolder folder;
  WriteFile(folder / "lens.yaml", LensToYaml(written));
  Diagnostics diagnostics;
  const auto read = ReadLensFile(folder / "lens.yaml", &diagnostics);
  ASSERT_TRUE(read) << diagnostics.ToString();
  EXPECT_EQ(read->numbers, written.lens.numbers);
  EXPECT_EQ(read->covariance, written.lens.covariance);
  EXPECT_EQ(read->scale, written.lens.scale);
}

TEST(LensFile, WhatIsWrongIsSaid) {
  const TempFolder folder;
  const auto message = [&](const std::string& text) {
    WriteFile(folder / "lens.yaml", text);
    Diagnostics diagnostics;
    EXPECT_FALSE(ReadLensFile(folder / "lens.yaml", &diagnostics));
    return diagnostics.ToString();
  };
  const std::string head = "schema: 1\nwidth_px: 640\nheight_px: 480\nscale_px: 400\n";
  EXPECT_THAT(message(head + "centre_px: [1, 2]\n"), HasSubstr("'k'"));
  EXPECT_THAT(message(head + "centre_px: [320]\nk: [0, 0, 0]\n"), HasSubstr("lens.yaml:5"));
  EXPECT_THAT(message(head + "centre_px: [320, 240]\nk: [-1, 0, 0]\n"),
              HasSubstr("folds the image"));
  EXPECT_THAT(message(head + "centre_px: [320, 240]\nk: [0, 0, 0]\nkk: 1\n"), HasSubstr("'kk'"));
}

}  // namespace
}  // namespace dhcal
