#include "tools/camera/flanks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/math/statistics.h"

namespace dhcal {
namespace {

constexpr double kAlong = 1.2;           // Gaussian along the row, whose derivative is taken [px]
constexpr double kAcross = 1.0;          // and across it
constexpr double kNeighbourhood = 0.04;  // of the image's width, for the light around
constexpr int kMostRows = 320;           // that are looked at
constexpr double kAboveNoise = 5;        // standard deviations that a flank stands out
constexpr int kBins = 256;               // of the logarithm of heights

/// Brightness by the light's: light that falls unevenly no longer moves flanks. The light is that
/// of the brightest things around, which lines and dark dirt are not, smoothed; at a quarter of the
/// resolution, which it has to spare.
cv::Mat EvenlyLit(const cv::Mat& gray) {
  cv::Mat light;
  cv::resize(gray, light, {}, 0.25, 0.25, cv::INTER_AREA);
  const int reach = std::max(2, static_cast<int>(kNeighbourhood * light.cols));
  const cv::Mat around = cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
  cv::dilate(light, light, around, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::GaussianBlur(light, light, {}, reach, reach, cv::BORDER_REPLICATE);
  cv::resize(light, light, gray.size(), 0, 0, cv::INTER_LINEAR);
  light += 0.02 * cv::mean(gray)[0] + 1e-6;
  cv::Mat even;
  cv::divide(gray, light, even);
  return even;
}

std::vector<float> GaussianKernel(double sigma, bool derivative) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  std::vector<float> kernel;
  double norm = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double g = std::exp(-0.5 * k * k / (sigma * sigma));
    norm += derivative ? g * k * k : g;
    kernel.push_back(static_cast<float>(derivative ? g * k : g));
  }
  for (float& value : kernel) value = static_cast<float>(value / norm);
  return kernel;
}

bool IsPeak(const float* g, int k) {
  const float here = std::abs(g[k]);
  return here > std::abs(g[k - 1]) && here >= std::abs(g[k + 1]) && g[k - 1] * g[k] > 0 &&
         g[k + 1] * g[k] > 0;
}

/// The height that parts flanks from noise: Otsu's, in the logarithm of the peaks' heights. Zero
/// where there is no peak.
double FlankHeight(const cv::Mat& change, int stride) {
  std::array<double, kBins> histogram{};
  double highest = 0;
  std::vector<float> heights;
  for (int row = 0; row < change.rows; row += stride) {
    const float* const g = change.ptr<float>(row);
    for (int k = 1; k + 1 < change.cols; ++k) {
      if (IsPeak(g, k)) heights.push_back(std::abs(g[k]));
    }
  }
  for (const float height : heights) highest = std::fmax(highest, height);
  if (heights.empty()) return 0;
  constexpr double kDecades = 8;  // in powers of e below the highest
  double count = 0, sum = 0;
  for (const float height : heights) {
    const double below = std::log(highest / height) / kDecades;
    if (below >= 1) continue;
    const int bin = std::min(kBins - 1, static_cast<int>((1 - below) * kBins));
    histogram[static_cast<std::size_t>(bin)] += 1;
    count += 1;
    sum += bin;
  }
  double best = -1, low_count = 0, low_sum = 0;
  int cut = 0;
  for (int bin = 0; bin + 1 < kBins; ++bin) {
    low_count += histogram[static_cast<std::size_t>(bin)];
    low_sum += bin * histogram[static_cast<std::size_t>(bin)];
    if (low_count == 0 || low_count == count) continue;
    const double apart = low_sum / low_count - (sum - low_sum) / (count - low_count);
    const double between = low_count * (count - low_count) * apart * apart;
    if (between > best) {
      best = between;
      cut = bin + 1;
    }
  }
  return highest * std::exp(-kDecades * (1 - static_cast<double>(cut) / kBins));
}

/// Standard deviation that the image's noise has in `change`: from second differences both ways,
/// which slow things and straight edges leave small (Immerkaer 1996), by their median.
double NoiseOf(const cv::Mat& even, int stride) {
  const cv::Mat mask = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1) / 6;
  cv::Mat differences;
  cv::filter2D(even, differences, CV_32F, mask);
  std::vector<double> sizes;
  for (int row = 0; row < differences.rows; row += 4 * stride) {
    const float* const d = differences.ptr<float>(row);
    for (int k = 0; k < differences.cols; k += 2) sizes.push_back(d[k]);
  }
  double along = 0, across = 0;
  for (const float value : GaussianKernel(kAlong, true)) along += value * value;
  for (const float value : GaussianKernel(kAcross, false)) across += value * value;
  return RobustScale(std::move(sizes)) * std::sqrt(along * across);
}

/// Of a peak that is Gaussian, as that of a blurred step is: a parabola in its logarithm.
double PeakPlace(const float* g, int k) {
  const double left = std::log(std::abs(g[k - 1])), here = std::log(std::abs(g[k])),
               right = std::log(std::abs(g[k + 1]));
  const double curve = left - 2 * here + right;
  return curve < 0 ? k + 0.5 * (left - right) / curve : k;
}

/// A flank into the line directly followed by one out of it.
std::vector<FlankPair> PairsOfRow(const float* g, int width, double height, bool dark) {
  std::vector<FlankPair> pairs;
  int into = -1;
  for (int k = 1; k + 1 < width; ++k) {
    if (std::abs(g[k]) < height || !IsPeak(g, k)) continue;
    if ((g[k] < 0) == dark) {
      into = k;
    } else if (into >= 0) {
      pairs.push_back(
          {PeakPlace(g, into), PeakPlace(g, k), std::fmin(std::abs(g[into]), std::abs(g[k]))});
      into = -1;
    }
  }
  return pairs;
}

/// Slope of the lines, where their flanks are high, by the structure tensor.
double SlopeOf(const cv::Mat& change, double height, int stride) {
  double along = 0, mixed = 0;
  for (int row = 2; row + 2 < change.rows; row += stride) {
    const float* const g = change.ptr<float>(row);
    const float* const above = change.ptr<float>(row - 2);
    const float* const below = change.ptr<float>(row + 2);
    for (int k = 1; k + 1 < change.cols; ++k) {
      if (std::abs(g[k]) < height) continue;
      const double by_u = 0.5 * (g[k + 1] - g[k - 1]), by_v = 0.25 * (below[k] - above[k]);
      along += by_u * by_u;
      mixed += by_u * by_v;
    }
  }
  return along > 0 ? std::clamp(-mixed / along, -1.5, 1.5) : 0;
}

}  // namespace

FlankRows FindFlanks(const cv::Mat& gray, bool dark) {
  const cv::Mat even = EvenlyLit(gray);
  cv::Mat change;
  cv::sepFilter2D(even,
                  change,
                  CV_32F,
                  GaussianKernel(kAlong, true),
                  GaussianKernel(kAcross, false),
                  {-1, -1},
                  0,
                  cv::BORDER_REPLICATE);
  const int stride = std::max(1, gray.rows / kMostRows);
  const double height = std::max(FlankHeight(change, stride), kAboveNoise * NoiseOf(even, stride));
  FlankRows found;
  if (height == 0) return found;
  found.slope = SlopeOf(change, height, stride);
  for (int row = 0; row < change.rows; row += stride) {
    FlankRow flanks;
    flanks.row = row;
    flanks.pairs = PairsOfRow(change.ptr<float>(row), change.cols, height, dark);
    found.rows.push_back(std::move(flanks));
  }
  return found;
}

}  // namespace dhcal
