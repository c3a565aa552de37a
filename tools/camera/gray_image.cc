#include "tools/camera/gray_image.h"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace dhcal {
namespace {

constexpr int kSmallest = 32;  // [px] either way

/// What cannot be an image file, said before the decoder says less; "" else.
std::string NoFile(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return "there is no such file; give an image";
  if (std::filesystem::is_directory(status)) return "is a folder; give the images in it";
  if (std::filesystem::file_size(file, error) == 0) return "is empty; give an image";
  return "";
}

cv::Mat Decoded(const std::string& file) {
  try {
    return cv::imread(file, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // of sizes that it takes for an attack
    return {};
  }
}

}  // namespace

std::string ToGray(const cv::Mat& image, cv::Mat* gray) {
  if (image.cols < kSmallest || image.rows < kSmallest) {
    return fmt::format("has {} x {} px, but at least {} x {} are expected",
                       image.cols,
                       image.rows,
                       kSmallest,
                       kSmallest);
  }
  cv::Mat one = image;
  if (image.channels() == 3) cv::cvtColor(image, one, cv::COLOR_BGR2GRAY);
  if (image.channels() == 4) cv::cvtColor(image, one, cv::COLOR_BGRA2GRAY);
  if (one.channels() != 1) return "has two channels; save it as grey or colour";
  const int depth = one.depth();
  const double full = depth == CV_8U ? 255.0 : depth == CV_16U ? 65535.0 : 1.0;
  one.convertTo(*gray, CV_32F, 1.0 / full);
  double low = 0, high = 0;
  cv::minMaxLoc(*gray, &low, &high);
  if (!(high > low)) return "is of one brightness all over: there is nothing to see in it";
  return "";
}

std::optional<cv::Mat> ReadGrayImage(const std::string& file, Diagnostics* diagnostics) {
  std::string wrong = NoFile(file);
  cv::Mat gray;
  if (wrong.empty()) {
    const cv::Mat image = Decoded(file);
    wrong = image.empty() ? "is no image that can be read; PNG, TIFF, JPEG, BMP or PGM is expected"
                          : ToGray(image, &gray);
  }
  if (wrong.empty()) return gray;
  diagnostics->Error({file}, wrong);
  return std::nullopt;
}

}  // namespace dhcal
