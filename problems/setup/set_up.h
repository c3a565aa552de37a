// A way to take the two files: as they stand, apart from what is changed here. The doctor tries
// many of them.
#ifndef DHCAL_PROBLEMS_SETUP_SET_UP_H_
#define DHCAL_PROBLEMS_SETUP_SET_UP_H_

#include <tuple>
#include <vector>

namespace dhcal {

/// A quantity that the files give in degrees or radians.
enum class AngleUnit { kAsWritten, kHoldsRadians, kHoldsDegrees };

/// Rows by which readings and joint coordinates may stand apart.
constexpr int kMostRowShift = 2;

struct SetUp {
  struct Joint {
    int column = 0;     // of the recording's joint coordinates, from 0
    int sense = 1;      // times the file's sign
    int quarters = 0;   // of a turn, added to theta: -1, 0, 1 or 2
    double offset = 0;  // [rad] added to theta, too: of a joint that was mastered wrongly
    AngleUnit unit = AngleUnit::kAsWritten;
    int driver = -1;        // joint whose coordinate turns this one, too; -1 = none
    int driver_factor = 0;  // +1 or -1

    friend bool operator<(const Joint& a, const Joint& b) { return a.Key() < b.Key(); }
    friend bool operator==(const Joint& a, const Joint& b) { return a.Key() == b.Key(); }

   private:
    std::tuple<int, int, int, double, AngleUnit, int, int> Key() const {
      return {column, sense, quarters, offset, unit, driver, driver_factor};
    }
  };

  std::vector<Joint> joints;
  bool other_convention = false;
  AngleUnit table_unit = AngleUnit::kAsWritten;  // of theta and alpha
  /// From row `shift_from` on, a reading belongs to the joint coordinates so many rows later.
  int shift = 0;
  int shift_from = 0;
  bool base_per_run = false;
  bool tool_per_run = false;
  // What shows when base and tool are fitted.
  double table_scale = 1;    // the table's lengths times this are metres
  double reading_scale = 1;  // the readings' lengths times this are metres
  double tool_scale = 1;     // the tool's lengths times this are metres
  bool mirrored = false;

  /// All of it, to be compared.
  auto Key() const {
    return std::tie(joints,
                    other_convention,
                    table_unit,
                    shift,
                    shift_from,
                    base_per_run,
                    tool_per_run,
                    table_scale,
                    reading_scale,
                    tool_scale,
                    mirrored);
  }

  friend bool operator<(const SetUp& a, const SetUp& b) { return a.Key() < b.Key(); }
  friend bool operator==(const SetUp& a, const SetUp& b) { return a.Key() == b.Key(); }
};

/// The files as they stand.
inline SetUp AsWritten(int num_joints) {
  SetUp set_up;
  set_up.joints.resize(static_cast<std::size_t>(num_joints));
  for (int j = 0; j < num_joints; ++j) set_up.joints[static_cast<std::size_t>(j)].column = j;
  return set_up;
}

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_SET_UP_H_
