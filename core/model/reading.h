// One reading of a recording: a row, or a row and its predecessor.
#ifndef DHCAL_CORE_MODEL_READING_H_
#define DHCAL_CORE_MODEL_READING_H_

#include <vector>

namespace dhcal {

struct Reading {
  int row_idx = -1;
  /// The row before, of a kind that reads pairs; -1 where the row is read by itself.
  int previous_idx = -1;
};

struct Readings {
  std::vector<Reading> fitted;
  std::vector<Reading> test;
  std::vector<Reading> set_aside;  // of rows that were found misread
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_READING_H_
