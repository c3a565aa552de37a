#include "problems/formats/problem/path_resolver.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/yaml_source.h"

namespace dhcal {
namespace {

constexpr const char* kDataVariable = "${DHCAL_DATA}";

/// "~/x" as a shell would have it.
std::string WithHome(const std::string& path) {
  const char* const home = std::getenv("HOME");
  if (home == nullptr || !StartsWith(path, "~/")) return path;
  return home + path.substr(1);
}

}  // namespace

std::string ResolvePath(const YamlValue& value, const std::string& data_dir) {
  const std::optional<std::string> text = value.Text();
  if (!text) return "";
  if (StartsWith(*text, kDataVariable)) {
    if (data_dir.empty()) {
      value.Error(
          fmt::format("starts with {}, but no data folder is known; give it with the flag "
                      "--data_dir or the environment variable DHCAL_DATA",
                      kDataVariable));
      return "";
    }
    const std::string rest = text->substr(std::string(kDataVariable).size());
    const std::size_t first = std::min(rest.find_first_not_of('/'), rest.size());
    return (std::filesystem::path(data_dir) / rest.substr(first)).string();
  }
  if (text->find("${") != std::string::npos) {
    value.Error(fmt::format(
        "is '{}'; the only variable is {}, at the start", Printable(*text), kDataVariable));
    return "";
  }
  return (std::filesystem::path(value.source()->file()).parent_path() / WithHome(*text)).string();
}

}  // namespace dhcal
