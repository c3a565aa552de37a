#include "problems/formats/urdf/urdf_places.h"

#include <algorithm>
#include <pugixml.hpp>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {
namespace {

/// pugixml counts from behind the "<". A ">" inside quotes ends no tag.
XmlTag TagOf(const pugi::xml_node& node, std::string_view text) {
  if (!node) return {};
  const auto begin = static_cast<std::size_t>(node.offset_debug()) - 1;
  char quote = 0;
  for (std::size_t k = begin; k < text.size(); ++k) {
    const char c = text[k];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return {begin, k + 1};
    }
  }
  return {};
}

/// The first element that only a macro processor understands.
pugi::xml_node FirstMacro(const pugi::xml_node& root) {
  return root.find_node([](const pugi::xml_node& node) {
    if (StartsWith(node.name(), "xacro:")) return true;
    return std::any_of(
        node.attributes_begin(), node.attributes_end(), [](const pugi::xml_attribute& attribute) {
          const std::string_view value = attribute.value();
          return value.find("${") != std::string_view::npos ||
                 value.find("$(arg") != std::string_view::npos;
        });
  });
}

}  // namespace

SourceLocation PlaceInText(const std::string& file, std::string_view text, std::size_t byte) {
  byte = std::min(byte, text.size());
  const std::string_view before = text.substr(0, byte);
  const std::size_t line_end = before.rfind('\n');
  const std::size_t line = line_end == std::string_view::npos ? 0 : line_end + 1;
  return {file,
          static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          CountCharacters(before.substr(line)) + 1};
}

std::optional<UrdfPlaces> FindUrdfPlaces(const std::string& file,
                                         const std::string& text,
                                         Diagnostics* diagnostics) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(
      text.data(), text.size(), pugi::parse_default, pugi::xml_encoding::encoding_utf8);
  if (!parsed) {
    diagnostics->Error(PlaceInText(file, text, static_cast<std::size_t>(parsed.offset)),
                       fmt::format("this is no XML: {}", parsed.description()));
    return std::nullopt;
  }
  const pugi::xml_node root = document.document_element();
  const auto at = [&](const pugi::xml_node& node) {
    return PlaceInText(file, text, TagOf(node, text).begin);
  };
  if (std::string_view(root.name()) != "robot") {
    diagnostics->Error(
        at(root),
        fmt::format("the file's element is <{}>, but a URDF's is <robot>", Printable(root.name())));
    return std::nullopt;
  }
  if (const pugi::xml_node macro = FirstMacro(root)) {
    diagnostics->Error(at(macro),
                       fmt::format("<{}> holds a macro of xacro; make the URDF of it first: "
                                   "xacro {} > robot.urdf",
                                   Printable(macro.name()),
                                   Printable(file)));
    return std::nullopt;
  }
  UrdfPlaces places;
  places.robot = TagOf(root, text).begin;
  for (const pugi::xml_node& joint : root.children("joint")) {
    places.joints.emplace(joint.attribute("name").value(),
                          UrdfJointPlace{TagOf(joint, text),
                                         TagOf(joint.child("origin"), text),
                                         TagOf(joint.child("axis"), text)});
  }
  for (const pugi::xml_node& link : root.children("link")) {
    places.links.emplace(link.attribute("name").value(), TagOf(link, text).begin);
  }
  return places;
}

}  // namespace dhcal
