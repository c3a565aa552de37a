// A strict reader of one YAML map: every key must be asked for by the program, or it is an error
// that names the nearest key that is.
#ifndef DHCAL_CORE_IO_YAML_MAP_H_
#define DHCAL_CORE_IO_YAML_MAP_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/io/yaml_value.h"

namespace dhcal {

/// One way to write a quantity: the ending of its key and the factor to SI.
struct UnitSpelling {
  std::string suffix;  // "_mm"; "" for a key without a unit
  double to_si = 1;
};
using UnitSpellings = std::vector<UnitSpelling>;

const UnitSpellings& LengthUnits();      // _m _mm
const UnitSpellings& AngleUnits();       // _rad _deg
const UnitSpellings& SmallAngleUnits();  // _rad _deg _mrad

/// The keys "<stem><suffix>" of a quantity.
std::vector<std::string> Spellings(const std::string& stem, const UnitSpellings& units);

/// A value found under one of the spellings of its quantity.
struct UnitValue {
  YamlValue value;
  double to_si = 1;
};

/// Reads the keys of one map. The Read functions change their output only when the key is there
/// and its value is right, so defaults stand where the data is declared. The destructor reports
/// the keys that nothing asked for.
class YamlMap {
 public:
  /// Adds an error when `value` is not a map; the reader is then empty and asks for nothing.
  explicit YamlMap(const YamlValue& value);
  ~YamlMap();
  YamlMap(const YamlMap&) = delete;
  YamlMap& operator=(const YamlMap&) = delete;

  const YamlValue& value() const { return value_; }
  /// False when the value is no map at all.
  bool valid() const { return value_.IsMap(); }

  /// Whether the key is written, whatever its value.
  bool Has(const std::string& key);
  /// The same; absence is an error.
  bool RequireKey(const std::string& key);
  /// The key's value, or nothing when it is absent or (an error) empty.
  std::optional<YamlValue> Find(const std::string& key);
  /// `Find` of a key whose absence is an error.
  std::optional<YamlValue> Require(const std::string& key);
  /// The value under any one spelling; two of them are an error.
  std::optional<UnitValue> Find(const std::string& stem, const UnitSpellings& units);

  void Read(const std::string& key, double* number, const Range& range = {});
  void Read(const std::string& key, int* number, int low, int high);
  void Read(const std::string& key, bool* flag);
  void Read(const std::string& key, std::string* text);
  /// Number in SI; the range is that of the number as written.
  void Read(const std::string& stem,
            const UnitSpellings& units,
            double* number,
            const Range& range = {});
  /// List of `length` numbers in SI; any length when it is negative.
  void Read(const std::string& stem,
            const UnitSpellings& units,
            int length,
            Eigen::VectorXd* numbers);

  /// One of a few words; true when it was read.
  template <typename Enum>
  bool ReadChoice(const std::string& key,
                  const std::vector<std::pair<std::string, Enum>>& words,
                  Enum* choice) {
    const std::optional<YamlValue> found = Find(key);
    if (!found) return false;
    std::vector<std::string> names;
    names.reserve(words.size());
    for (const auto& word : words) names.push_back(word.first);
    const int idx = ChooseWord(*found, names);
    if (idx >= 0) *choice = words[idx].second;
    return idx >= 0;
  }

  /// All entries of a map whose keys are the user's own names; none is unknown.
  std::vector<std::pair<std::string, YamlValue>> AllEntries();

  /// Unknown keys are not reported: which ones would be known depends on what is wrong already.
  void AcceptAllKeys() { any_key_ = true; }

  /// Ends the place in messages about unknown keys: "of kind 'file'".
  void set_remark(std::string remark) { remark_ = std::move(remark); }

 private:
  struct Entry {
    std::string key;
    SourceLocation where;
    YamlValue value;
    bool duplicate = false;
  };

  const Entry* FindEntry(const std::string& key) const;
  void AddEntry(const YAML::Node& key, const YAML::Node& value);
  void ReportUnknownKeys() const;
  std::string UnknownKeyMessage(const std::string& key) const;
  std::optional<YamlValue> ValueOf(const Entry& entry) const;
  void ReportSameQuantity(const Entry& first, const Entry& second) const;

  static int ChooseWord(const YamlValue& value, const std::vector<std::string>& words);

  YamlValue value_;
  std::vector<Entry> entries_;
  std::vector<std::string> known_keys_;
  bool any_key_ = false;
  std::string remark_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_YAML_MAP_H_
