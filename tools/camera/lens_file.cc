#include "tools/camera/lens_file.h"

#include <utility>

#include <fmt/format.h>

#include "core/io/text_file.h"
#include "core/io/yaml_map.h"
#include "core/io/yaml_source.h"

namespace dhcal {
namespace {

constexpr int kLargestImage = 100000;  // [px]

/// A list of `length` numbers under `key`, which must be there.
Eigen::VectorXd RequireNumbers(YamlMap* map, const std::string& key, int length) {
  const std::optional<YamlValue> value = map->Require(key);
  const auto numbers = value ? value->Numbers(length) : std::nullopt;
  return numbers.value_or(Eigen::VectorXd::Zero(length));
}

Lens ReadLens(const YamlValue& value) {
  YamlMap map(value);
  Lens lens;
  if (!map.valid()) return lens;
  int schema = 1;
  if (map.RequireKey("schema")) map.Read("schema", &schema, 1, 1);
  if (map.RequireKey("width_px")) map.Read("width_px", &lens.width, 1, kLargestImage);
  if (map.RequireKey("height_px")) map.Read("height_px", &lens.height, 1, kLargestImage);
  if (map.RequireKey("scale_px")) map.Read("scale_px", &lens.scale, Range::Above(0));
  lens.numbers.head<2>() = RequireNumbers(&map, "centre_px", 2);
  lens.numbers.tail<3>() = RequireNumbers(&map, "k", 3);
  if (const std::optional<YamlValue> found = map.Find("covariance")) {
    const auto numbers = found->Numbers(kLensNumbers * kLensNumbers);
    if (numbers) lens.covariance = LensCovariance(numbers->data());
  }
  for (const char* const told : {"sigma", "straightness_px", "images"}) map.Find(told);
  return lens;
}

template <typename Numbers>
std::string ListOf(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers.data(), numbers.data() + numbers.size(), ", "));
}

}  // namespace

std::string LensToYaml(const StraightenedLens& straightened) {
  const Lens& lens = straightened.lens;
  const LensNumbers sigma = lens.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::Vector2d centre = lens.numbers.head<2>();
  const Eigen::Vector3d k = lens.numbers.tail<3>();
  std::string text = fmt::format(
      "# Lens by dhcal_ruler, from {} images: U(m) = c + (m - c) (1 + k1 r^2 + k2 r^4 + k3 r^6),\n"
      "# r = |m - c| / scale_px, pixels counted from 0 at their middles.\n",
      straightened.images);
  text += fmt::format("schema: 1\nwidth_px: {}\nheight_px: {}\n", lens.width, lens.height);
  text +=
      fmt::format("scale_px: {}\ncentre_px: {}\nk: {}\n", lens.scale, ListOf(centre), ListOf(k));
  text += fmt::format("sigma: [{:.3g}]  # of centre_px and k\n",
                      fmt::join(sigma.data(), sigma.data() + sigma.size(), ", "));
  text += fmt::format("covariance: {}\n", ListOf(lens.covariance));
  text +=
      fmt::format("straightness_px: [{:.4f}, {:.4f}]  # scatter of the rulings, before and after\n",
                  straightened.rms_before,
                  straightened.rms_after);
  return text + fmt::format("images: {}\n", straightened.images);
}

std::optional<Lens> ReadLensFile(const std::string& file, Diagnostics* diagnostics) {
  std::optional<std::string> text = ReadTextFile(file, diagnostics);
  if (!text) return std::nullopt;
  Diagnostics found;
  Lens lens;
  const YamlSource source(file, std::move(*text), &found);
  if (const std::optional<YAML::Node> root = source.Parse()) {
    lens = ReadLens(YamlValue(*root, "", {file, 1, 1}, &source));
  }
  if (found.ok() && !KeepsOrder(lens)) {
    found.Error({file}, "describes a lens that folds the image; calibrate it anew");
  }
  for (const Diagnostic& message : found.all()) diagnostics->Add(message);
  return found.ok() ? std::optional(lens) : std::nullopt;
}

}  // namespace dhcal
