// Photographs as brightness, whatever a camera wrote.
#ifndef DHCAL_TOOLS_CAMERA_GRAY_IMAGE_H_
#define DHCAL_TOOLS_CAMERA_GRAY_IMAGE_H_

#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "core/base/diagnostics.h"

namespace dhcal {

/// Brightness of an image file (PNG, TIFF, JPEG, BMP, PGM; 8 or 16 bits, grey or colour), CV_32F,
/// full scale 1. An error and nothing where it is no image or shows nothing at all. The pixels are
/// as stored: what a camera says of its orientation is left alone.
std::optional<cv::Mat> ReadGrayImage(const std::string& file, Diagnostics* diagnostics);

/// The same of an image in memory, 1, 3 or 4 channels (the last blue, green, red, and a fourth that
/// is ignored); "" or what is wrong with it.
std::string ToGray(const cv::Mat& image, cv::Mat* gray);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_GRAY_IMAGE_H_
