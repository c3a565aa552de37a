#include "core/io/yaml_value.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/angle_text.h"

namespace dhcal {

namespace {

/// Why a text that should be a number is none, when the reason is a common one.
std::string NumberHint(const std::string& text) {
  std::string with_point = text;
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  if (with_point != text && ParseDouble(with_point)) return "; write a decimal point, not a comma";
  return "";
}

}  // namespace

Range Range::AtLeast(double low) { return {low}; }

Range Range::Above(double low) {
  Range range{low};
  range.open_low = true;
  return range;
}

Range Range::Inside(double low, double high) { return {low, high, true, true}; }

bool Range::Contains(double number) const {
  const bool above = open_low ? number > low : number >= low;
  const bool below = open_high ? number < high : number <= high;
  return above && below;
}

std::string Range::ToString() const {
  std::string text;
  if (std::isfinite(low)) text += fmt::format("{} {}", open_low ? "above" : "at least", low);
  if (std::isfinite(high)) {
    if (!text.empty()) text += " and ";
    text += fmt::format("{} {}", open_high ? "below" : "at most", high);
  }
  return text;
}

YamlValue::YamlValue(const YAML::Node& node,
                     std::string name,
                     SourceLocation key_where,
                     const YamlSource* source)
    : node_(node), name_(std::move(name)), key_where_(std::move(key_where)), source_(source) {}

std::string YamlValue::QuotedName() const { return name_.empty() ? "the file" : "'" + name_ + "'"; }

std::string YamlValue::Describe() const {
  if (node_.IsMap()) return "a map of keys";
  if (node_.IsSequence()) return "a list";
  if (!node_.IsScalar()) return "empty";
  return "'" + Printable(node_.Scalar()) + "'";
}

void YamlValue::Error(const std::string& what) const {
  source_->Error(where(), QuotedName() + " " + what);
}

void YamlValue::Warning(const std::string& what) const {
  source_->Warning(where(), QuotedName() + " " + what);
}

std::optional<std::string> YamlValue::PlainScalar(const std::string& expected) const {
  // The library marks a quoted scalar with the tag "!"; in quotes, 5 is a text.
  if (node_.IsScalar() && node_.Tag() != "!") return node_.Scalar();
  const std::string in_quotes = node_.IsScalar() ? " in quotes" : "";
  Error(fmt::format("is {}{}, but {} is expected", Describe(), in_quotes, expected));
  return std::nullopt;
}

std::optional<double> YamlValue::Number(const Range& range) const {
  const std::optional<std::string> text = PlainScalar("a number");
  if (!text) return std::nullopt;
  const std::optional<double> number = ParseDouble(*text);
  if (!number) {
    Error(fmt::format("is {}, but a finite number is expected{}", Describe(), NumberHint(*text)));
    return std::nullopt;
  }
  if (!range.Contains(*number)) {
    Error(fmt::format("is {}, but must be {}", *text, range.ToString()));
    return std::nullopt;
  }
  return number;
}

std::optional<double> YamlValue::Angle(double to_si) const {
  const std::optional<double> pi =
      node_.IsScalar() && node_.Tag() != "!" ? ParsePi(node_.Scalar()) : std::nullopt;
  if (pi && to_si == 1.0) return pi;
  if (pi) {
    Error(
        fmt::format("is {}, but a number of degrees is expected; write {}, or end the key in _rad",
                    Describe(),
                    *pi / to_si));
    return std::nullopt;
  }
  const std::optional<double> number = Number();
  if (!number) return std::nullopt;
  return *number * to_si;
}

std::optional<int> YamlValue::Integer(int low, int high) const {
  const std::string expected = fmt::format("a whole number from {} to {}", low, high);
  const std::optional<std::string> text = PlainScalar(expected);
  if (!text) return std::nullopt;
  const std::optional<std::int64_t> number = ParseInteger(*text);
  if (!number || *number < low || *number > high) {
    Error(fmt::format("is {}, but {} is expected", Describe(), expected));
    return std::nullopt;
  }
  return static_cast<int>(*number);
}

std::optional<std::uint64_t> YamlValue::Unsigned() const {
  const std::string expected = "a whole number of at least 0";
  const std::optional<std::string> text = PlainScalar(expected);
  if (!text) return std::nullopt;
  const std::optional<std::uint64_t> number = ParseUnsigned(*text);
  if (!number) Error(fmt::format("is {}, but {} is expected", Describe(), expected));
  return number;
}

std::optional<bool> YamlValue::Boolean() const {
  const std::optional<std::string> text = PlainScalar("true or false");
  if (!text) return std::nullopt;
  if (*text == "true") return true;
  if (*text == "false") return false;
  Error(fmt::format("is {}, but true or false is expected", Describe()));
  return std::nullopt;
}

std::optional<std::string> YamlValue::Text() const {
  if (node_.IsScalar() && !Trim(node_.Scalar()).empty()) return node_.Scalar();
  Error(fmt::format("is {}, but a text is expected", Describe()));
  return std::nullopt;
}

std::optional<std::vector<YamlValue>> YamlValue::List() const {
  if (!IsList()) {
    Error(fmt::format("is {}, but a list [..] is expected", Describe()));
    return std::nullopt;
  }
  std::vector<YamlValue> items;
  for (const YAML::Node& item : node_) {
    const std::string item_name = fmt::format("{}[{}]", name_, items.size() + 1);
    items.emplace_back(item, item_name, source_->At(item.Mark()), source_);
  }
  return items;
}

std::optional<Eigen::VectorXd> YamlValue::Numbers(int length) const {
  const std::optional<std::vector<YamlValue>> items = List();
  if (!items) return std::nullopt;
  const int count = static_cast<int>(items->size());
  if (length >= 0 && count != length) {
    Error(fmt::format("has {} numbers, but {} are expected", count, length));
    return std::nullopt;
  }
  Eigen::VectorXd numbers(count);
  bool good = true;
  for (int i = 0; i < count; ++i) {
    const std::optional<double> number = (*items)[i].Number();
    good = good && number.has_value();
    if (number) numbers[i] = *number;
  }
  return good ? std::optional(numbers) : std::nullopt;
}

}  // namespace dhcal
