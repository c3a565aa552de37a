// One value of a YAML file: what it is called, where it stands, and what it is as a number, text
// or list. Each getter adds an error and returns nothing when the value is something else.
#ifndef DHCAL_CORE_IO_YAML_VALUE_H_
#define DHCAL_CORE_IO_YAML_VALUE_H_

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include "core/base/diagnostics.h"
#include "core/io/yaml_source.h"

namespace dhcal {

/// The numbers that a key accepts; all finite ones by default.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;   // `low` itself is refused
  bool open_high = false;  // `high` itself is refused

  static Range AtLeast(double low);
  static Range Above(double low);
  static Range Inside(double low, double high);  // without its ends

  bool Contains(double number) const;
  /// "at least 0", "above 0", "above 0 and below 1".
  std::string ToString() const;
};

/// Cheap to copy.
class YamlValue {
 public:
  /// `name` is the dotted path of keys, such as "solver.kappa"; "" for the whole file.
  YamlValue(const YAML::Node& node,
            std::string name,
            SourceLocation key_where,
            const YamlSource* source);

  const YAML::Node& node() const { return node_; }
  const std::string& name() const { return name_; }
  const YamlSource* source() const { return source_; }
  /// Where the value stands.
  SourceLocation where() const { return source_->At(node_.Mark()); }
  /// Where its key stands, for what is missing inside it.
  const SourceLocation& key_where() const { return key_where_; }
  /// "'solver.kappa'", or "the file".
  std::string QuotedName() const;
  /// What it is, in words for "is ..., but ... is expected".
  std::string Describe() const;

  bool IsMap() const { return node_.IsMap(); }
  bool IsList() const { return node_.IsSequence(); }
  bool IsEmptyList() const { return node_.IsSequence() && node_.size() == 0; }

  /// Adds an error "'<name>' <what is wrong>" at the value.
  void Error(const std::string& what) const;
  void Warning(const std::string& what) const;

  std::optional<double> Number(const Range& range = {}) const;
  /// An angle in SI [rad]; where it is written in radians (`to_si` 1), "pi/2" may be used, too.
  std::optional<double> Angle(double to_si) const;
  std::optional<int> Integer(int low, int high) const;
  std::optional<std::uint64_t> Unsigned() const;
  std::optional<bool> Boolean() const;
  /// A text that is not empty.
  std::optional<std::string> Text() const;
  std::optional<std::vector<YamlValue>> List() const;
  /// A list of `length` numbers; any length when it is negative.
  std::optional<Eigen::VectorXd> Numbers(int length) const;

 private:
  std::optional<std::string> PlainScalar(const std::string& expected) const;

  YAML::Node node_;
  std::string name_;
  SourceLocation key_where_;
  const YamlSource* source_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_YAML_VALUE_H_
