// Photographs that are calculated elsewhere (tests/support/ruler_scene.h), read.
#include "tools/camera/rulings.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/support/ruler_scene.h"
#include "tests/tools/camera/camera_images.h"
#include "tools/camera/gray_image.h"

namespace dhcal {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

RulerReading Read(const RulerScene& scene, const Lens& lens, const RulerOptions& options = {}) {
  cv::Mat gray;
  EXPECT_EQ(ToGray(Photograph(scene), &gray), "");
  return ReadRulings(gray, lens, options);
}

/// Error of a reading [px], the whole pitches aside that an image cannot know.
double ReadingError(const RulerScene& scene, const RulerReading& reading) {
  const double error = reading.place - TrueReading(scene) / scene.pitch;
  return (error - std::round(error)) * reading.px_per_pitch;
}

/// Over many images: squares of errors in px.
struct Errors {
  int images = 0, refused = 0, rulings = 0, miscounted = 0;
  double reading = 0, of_rulings = 0, standardised = 0;

  void Add(const RulerScene& scene, const RulerReading& found) {
    ++images;
    if (!found.refusal.empty()) {
      ++refused;
      return;
    }
    const double error = ReadingError(scene, found);
    reading += error * error;
    standardised += std::pow(error / (found.sigma * found.px_per_pitch), 2);
    const double first = std::round(found.place - TrueReading(scene) / scene.pitch);
    for (const FoundRuling& ruling : found.rulings) {
      const double off = RulerXAt(scene, ruling.place) / scene.pitch - (ruling.number - first);
      if (std::abs(off) > 0.5) ++miscounted;
      if (ruling.set_aside) continue;
      ++rulings;
      of_rulings += std::pow(off * found.px_per_pitch, 2);
    }
  }
  int read() const { return images - refused; }
};

Errors Family(const SceneFamily& family, std::uint64_t first, int members) {
  Errors errors;
  for (int k = 0; k < members; ++k) {
    const RulerScene scene = RandomScene(family, first + static_cast<std::uint64_t>(k));
    errors.Add(scene, Read(scene, LensOf(scene)));
  }
  return errors;
}

TEST(Rulings, LieWithinATwentiethOfAPixelUnderBlurNoiseDirtUnevenLightAndALens) {
  const Errors errors = Family({}, 1, 14);
  EXPECT_LE(errors.refused, 1);
  EXPECT_GT(errors.rulings, 500);
  EXPECT_LT(std::sqrt(errors.of_rulings / errors.rulings), 0.05) << "of single rulings [px]";
  EXPECT_LT(std::sqrt(errors.reading / errors.read()), 0.01) << "of readings [px]";
  EXPECT_EQ(errors.miscounted, 0);
}

TEST(Rulings, TellTheSigmaOfTheirReading) {
  SceneFamily clean;
  clean.dirt = false;
  const Errors errors = Family(clean, 501, 14);
  EXPECT_EQ(errors.refused, 0);
  const double ratio = std::sqrt(errors.standardised / errors.read());
  EXPECT_GT(ratio, 0.6);
  EXPECT_LT(ratio, 1.5);
}

TEST(Rulings, AreCountedRightOrNotAtAllInImagesFullOfDirt) {
  SceneFamily harsh;
  harsh.specks = 60;
  harsh.lost = 12;
  harsh.scratches = 6;
  const Errors errors = Family(harsh, 2001, 8);
  EXPECT_EQ(errors.miscounted, 0);
  EXPECT_GT(errors.read(), 0);
  EXPECT_LT(std::sqrt(errors.reading / errors.read()), 0.2) << "[px]";
}

/// A plain photograph: nothing but a ruler from a slight angle.
RulerScene Plain() {
  RulerScene scene;
  scene.noise = 0.01;
  scene.X_RC = CameraOver(100.37, 0.4, 70, Vector3d(0.1, 0.15, 0.05));
  return scene;
}

TEST(Rulings, ASamplingOfPixelsByManyRaysSaysTheSame) {
  RulerScene scene = Plain();
  scene.noise = 0;
  scene.blur = 0.6;
  cv::Mat gray;
  ASSERT_EQ(ToGray(Photograph(scene, CV_16U, 4), &gray), "");
  const RulerReading reading = ReadRulings(gray, PlainLens(640, 480), {});
  ASSERT_EQ(reading.refusal, "");
  EXPECT_LT(std::abs(ReadingError(scene, reading)), 0.005);
}

TEST(Rulings, MissingAndScratchedOnesShiftNothing) {
  RulerScene scene = Plain();
  scene.missing = {98, 105, 106};
  scene.scratched = {100, 103};
  const RulerReading reading = Read(scene, PlainLens(640, 480));
  ASSERT_EQ(reading.refusal, "");
  EXPECT_EQ(reading.missing, 3);
  EXPECT_LT(std::abs(ReadingError(scene, reading)), 0.01);
}

TEST(Rulings, AreReadInEveryDirectionOfTheImage) {
  const RulerScene scene = Plain();
  cv::Mat across, down;
  ASSERT_EQ(ToGray(Photograph(scene), &across), "");
  down = across.t();
  RulerOptions options;
  const Lens lens = PlainLens(640, 480), tall = PlainLens(480, 640);
  const double right = ReadRulings(across, lens, options).place;
  options.backwards = true;
  const double left = ReadRulings(across, lens, options).place;
  EXPECT_NEAR(std::remainder(right + left, 1.0), 0, 1e-4);
  options = {};
  options.view.along_columns = true;
  const RulerReading turned = ReadRulings(down, tall, options);
  ASSERT_EQ(turned.refusal, "");
  EXPECT_NEAR(std::remainder(turned.place - right, 1.0), 0, 1e-4);
}

TEST(Rulings, LightOnesOnDarkGroundAreReadWhereTheCommandSaysSo) {
  RulerScene scene = Plain();
  std::swap(scene.ink, scene.paper);
  RulerOptions options;
  options.view.dark = false;
  const RulerReading reading = Read(scene, PlainLens(640, 480), options);
  ASSERT_EQ(reading.refusal, "");
  EXPECT_LT(std::abs(ReadingError(scene, reading)), 0.01);
}

TEST(Rulings, AGapWiderThanAllowedIsRefused) {
  RulerScene scene = Plain();
  for (int k = 97; k < 102; ++k) scene.missing.insert(k);
  EXPECT_THAT(Read(scene, PlainLens(640, 480)).refusal, HasSubstr("gap of 5 rulings"));
  RulerOptions options;
  options.longest_gap = 5;
  const RulerReading reading = Read(scene, PlainLens(640, 480), options);
  EXPECT_EQ(reading.refusal, "");
  EXPECT_LT(std::abs(ReadingError(scene, reading)), 0.02);
}

TEST(Rulings, AFewOrNoneAreRefused) {
  RulerScene scene = Plain();
  const auto keep = [&](int first, int last) {
    scene.missing.clear();
    for (int k = 0; k < 200; ++k) {
      if (k < first || k > last) scene.missing.insert(k);
    }
    return Read(scene, PlainLens(640, 480)).refusal;
  };
  EXPECT_THAT(keep(0, -1), HasSubstr("shows no rulings"));
  EXPECT_THAT(keep(100, 100), HasSubstr("no row of rulings"));
  EXPECT_THAT(keep(99, 102), HasSubstr("shows 4 rulings in a row"));
}

TEST(Rulings, NoiseAloneIsNoRuler) {
  RulerScene scene;
  scene.X_RC = CameraOver(100, 500, 70, Vector3d::Zero());  // beside the ruler
  scene.noise = 0.05;
  EXPECT_NE(Read(scene, PlainLens(640, 480)).refusal, "");
}

TEST(Rulings, ACentreBeyondTheRulerIsRefused) {
  RulerScene scene = Plain();
  for (int k = 0; k < 104; ++k) scene.missing.insert(k);
  EXPECT_THAT(Read(scene, PlainLens(640, 480)).refusal, HasSubstr("beyond the rulings"));
}

TEST(Rulings, ALensThatIsNotUndoneIsNoticed) {
  RulerScene scene = Plain();
  scene.k1 = -0.25;
  const RulerReading bent = Read(scene, PlainLens(640, 480));
  EXPECT_TRUE(!bent.refusal.empty() || bent.error_px > 0.1) << bent.error_px;
  EXPECT_LT(std::abs(ReadingError(scene, Read(scene, LensOf(scene)))), 0.01);
}

// The figures of problems/guides/ruler_images.md; ctest -L slow -R SlowRulingFigures prints them.
TEST(SlowRulingFigures, OverManyImages) {
  SceneFamily harsh;
  harsh.specks = 60;
  harsh.lost = 12;
  harsh.scratches = 6;
  for (const auto& [name, family, first] :
       {std::tuple{"usual", SceneFamily(), 10001}, std::tuple{"harsh", harsh, 20001}}) {
    const Errors errors = Family(family, static_cast<std::uint64_t>(first), 500);
    const double rulings = std::sqrt(errors.of_rulings / errors.rulings);
    printf(
        "%s: %d images, %d refused, %d rulings to %.4f px RMS, readings to %.4f px RMS, %.2f of "
        "their sigma, %d rulings miscounted\n",
        name,
        errors.images,
        errors.refused,
        errors.rulings,
        rulings,
        std::sqrt(errors.reading / errors.read()),
        std::sqrt(errors.standardised / errors.read()),
        errors.miscounted);
    EXPECT_EQ(errors.miscounted, 0) << name;
    EXPECT_LT(rulings, 0.05) << name;
  }
}

}  // namespace
}  // namespace dhcal
