// Places in the text of a URDF: where joints stand, and the tags that corrections are written into.
#ifndef DHCAL_PROBLEMS_FORMATS_URDF_URDF_PLACES_H_
#define DHCAL_PROBLEMS_FORMATS_URDF_URDF_PLACES_H_

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/diagnostics.h"

namespace dhcal {

/// A start tag, "<origin ...>" or "<origin .../>", as bytes of the text; empty = not there.
struct XmlTag {
  std::size_t begin = 0;
  std::size_t end = 0;  // behind ">"

  bool there() const { return end > begin; }
  bool closed(std::string_view text) const { return there() && text[end - 2] == '/'; }
};

struct UrdfJointPlace {
  XmlTag joint, origin, axis;
};

struct UrdfPlaces {
  std::map<std::string, UrdfJointPlace> joints;
  std::map<std::string, std::size_t> links;  // byte
  std::size_t robot = 0;                     // byte where <robot begins
};

/// Line and column of a byte of the text, from 1; columns in characters.
SourceLocation PlaceInText(const std::string& file, std::string_view text, std::size_t byte);

/// The places of a text; nothing after an error: no XML, no <robot>, or a macro file (xacro).
std::optional<UrdfPlaces> FindUrdfPlaces(const std::string& file,
                                         const std::string& text,
                                         Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_URDF_URDF_PLACES_H_
