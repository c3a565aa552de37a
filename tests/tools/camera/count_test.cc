// Whole pitches between images: counted right, or in doubt.
#include "tools/camera/count.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// Images at `places`, each numbered from a ruling of its own, with coarse positions off by
/// `coarse`.
std::vector<ImagePlace> Images(const std::vector<double>& places,
                               const std::vector<double>& coarse_errors) {
  std::vector<ImagePlace> images;
  for (std::size_t k = 0; k < places.size(); ++k) {
    ImagePlace image;
    image.readable = true;
    image.place = places[k] - 10 * std::floor(places[k] / 10);  // whole pitches forgotten
    image.scale = 14;
    image.coarse = places[k] + coarse_errors[k];
    images.push_back(image);
  }
  return images;
}

TEST(Count, FollowsCoarseMovesWhatTheirCommonError) {
  const std::vector<double> places = {3.2, 29.7, 55.1, 31.4};
  const auto counted = CountAlong(Images(places, {7.4, 7.5, 7.3, 7.4}), 0.25);
  for (std::size_t k = 1; k < places.size(); ++k) {
    EXPECT_EQ(counted[k].doubt, "");
    EXPECT_NEAR(counted[k].place - counted[0].place, places[k] - places[0], 1e-9);
  }
  EXPECT_NEAR(counted[0].place, 10.2, 1e-9) << "the one nearest to the coarse position";
}

TEST(Count, AMoveThatCouldBeAnotherRulingIsInDoubt) {
  const auto counted = CountAlong(Images({3.2, 29.7, 55.1}, {0, 0.4, 0}), 0.25);
  EXPECT_THAT(counted[1].doubt, HasSubstr("0.40 pitches beside"));
  EXPECT_TRUE(std::isnan(counted[1].place));
  EXPECT_NEAR(counted[2].place - counted[0].place, 51.9, 1e-9) << "counted on from the one before";
}

TEST(Count, BeginsAnewInEachRun) {
  std::vector<ImagePlace> images = Images({3.2, 29.7, 14.6, 40.1}, {0, 0, 0.45, 0.45});
  images[2].group = images[3].group = 1;
  for (const CountedPlace& place : CountAlong(images, 0.25)) EXPECT_EQ(place.doubt, "");
}

TEST(Count, AnImageWithEveryOtherRulingIsInDoubt) {
  std::vector<ImagePlace> images = Images({3.2, 29.7, 55.1}, {0, 0, 0});
  images[1].scale = 28;
  EXPECT_THAT(CountAlong(images, 0.25)[1].doubt, HasSubstr("28.0 px apart"));
}

TEST(Count, UnreadableImagesHaveNoPlaceAndNoDoubt) {
  std::vector<ImagePlace> images = Images({3.2, 29.7}, {0, 0});
  images[0].readable = false;
  const auto counted = CountAlong(images, 0.25);
  EXPECT_TRUE(std::isnan(counted[0].place));
  EXPECT_EQ(counted[0].doubt, "");
  EXPECT_NEAR(counted[1].place, 29.7, 1e-9);
}

TEST(Count, AWrongPitchIsInDoubtInMostImages) {
  // Read with pitches of twice the length: the coarse moves are half as many.
  Rng rng(5);
  std::vector<double> places, errors;
  for (int k = 0; k < 200; ++k) {
    places.push_back(rng.Uniform(0, 500));
    errors.push_back(-0.5 * places.back());
  }
  int doubted = 0;
  for (const CountedPlace& place : CountAlong(Images(places, errors), 0.25)) {
    doubted += place.doubt.empty() ? 0 : 1;
  }
  EXPECT_GT(doubted, 70);
}

}  // namespace
}  // namespace dhcal
