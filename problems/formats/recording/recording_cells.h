// Reads whole columns of a recording's cells: numbers under a rule, labels, and what is blank.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_CELLS_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_CELLS_H_

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/io/cell_table.h"
#include "core/io/file_errors.h"
#include "problems/formats/recording/recording_layout.h"

namespace dhcal {

/// What numbers a column may hold, in words ("must be ...") and as a test.
struct NumberRule {
  const char* words;
  bool (*holds)(double);
};

extern const NumberRule kAnyNumber;
extern const NumberRule kPositive;
extern const NumberRule kNotNegative;
extern const NumberRule kSign;  // -1, 0 or 1

/// Reports a wrong cell with its place and the name of its column.
class CellReader {
 public:
  CellReader(const CellTable& table, FileErrors* errors) : table_(table), errors_(errors) {}

  /// The column's numbers times `to_si`; blank and (an error) wrong cells are NaN.
  void ReadNumbers(int column_idx,
                   double to_si,
                   const NumberRule& rule,
                   Eigen::Ref<Eigen::VectorXd> numbers) const;
  Eigen::VectorXd ReadNumbers(int column_idx) const;
  /// The numbers of a field, in SI, one column per component; those without a column are NaN.
  Eigen::MatrixXd ReadNumbers(const FieldColumns& field, const NumberRule& rule) const;
  /// Coordinates that belong together: a row has all or (an error) none of them.
  Eigen::MatrixXd ReadCoordinates(const FieldColumns& field) const;

  /// Labels as indices into `names`, in the order of appearance. A blank one is -1, and an error
  /// unless it may be.
  std::vector<int> ReadLabels(int column_idx,
                              bool may_be_blank,
                              std::vector<std::string>* names) const;

  /// Whether the cells that are not blank are numbers, and there are some.
  bool IsNumeric(int column_idx) const;
  /// Line of the first cell that is blank; nothing when there is none.
  std::optional<int> FirstBlankLine(int column_idx) const;
  /// Numbers of a column that `IsNumeric`; blank cells are NaN.
  Eigen::VectorXd NumbersOrNaN(int column_idx) const;

  /// Cells of a column that needs a number in every row.
  void CheckNoneBlank(int column_idx) const;
  /// Coordinates that belong together: all or none in each row.
  void CheckAllOrNone(const std::vector<int>& columns) const;

  void Error(int row_idx, int column_idx, const std::string& what) const;

 private:
  const CellTable& table_;
  FileErrors* errors_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_CELLS_H_
