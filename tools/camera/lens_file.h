// A lens as a small YAML file.
#ifndef DHCAL_TOOLS_CAMERA_LENS_FILE_H_
#define DHCAL_TOOLS_CAMERA_LENS_FILE_H_

#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "tools/camera/lens.h"
#include "tools/camera/straighten.h"

namespace dhcal {

/// The file's text: numbers that read back exactly, with their sigmas and how straight lines are.
std::string LensToYaml(const StraightenedLens& straightened);

/// Nothing and errors where the file is none, or its lens folds the image.
std::optional<Lens> ReadLensFile(const std::string& file, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_LENS_FILE_H_
