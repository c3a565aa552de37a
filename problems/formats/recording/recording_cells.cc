#include "problems/formats/recording/recording_cells.h"

#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {

namespace {

constexpr double kBlank = std::numeric_limits<double>::quiet_NaN();

/// Why a cell that is no number is none.
std::string NotANumber(std::string_view cell) {
  std::string message = fmt::format("'{}' is not a finite number", Printable(cell));
  if (cell.find(',') != std::string_view::npos) message += "; write a decimal point, not a comma";
  return message;
}

}  // namespace

const NumberRule kAnyNumber = {"a number", [](double) { return true; }};
const NumberRule kPositive = {"above 0", [](double number) { return number > 0; }};
const NumberRule kNotNegative = {"at least 0", [](double number) { return number >= 0; }};
const NumberRule kSign = {"-1, 0 or 1",
                          [](double number) { return number == -1 || number == 0 || number == 1; }};

void CellReader::Error(int row_idx, int column_idx, const std::string& what) const {
  errors_->Error(table_.CellWhere(row_idx, column_idx),
                 fmt::format("column '{}': {}", Printable(table_.name(column_idx)), what));
}

void CellReader::ReadNumbers(int column_idx,
                             double to_si,
                             const NumberRule& rule,
                             Eigen::Ref<Eigen::VectorXd> numbers) const {
  numbers.setConstant(kBlank);
  if (const TableDoubt& doubt = table_.doubt(column_idx); !doubt.message.empty()) {
    return Error(doubt.row_idx, column_idx, doubt.message);
  }
  for (int row = 0; row < table_.num_rows(); ++row) {
    const std::string_view cell = table_.cell(row, column_idx);
    if (cell.empty()) continue;
    const std::optional<double> number = ParseDouble(cell);
    if (!number) {
      Error(row, column_idx, NotANumber(cell));
    } else if (!rule.holds(*number)) {
      Error(row, column_idx, fmt::format("{} must be {}", cell, rule.words));
    } else {
      numbers[row] = *number * to_si;
    }
  }
}

Eigen::VectorXd CellReader::ReadNumbers(int column_idx) const {
  Eigen::VectorXd numbers(table_.num_rows());
  ReadNumbers(column_idx, 1.0, kAnyNumber, numbers);
  return numbers;
}

Eigen::MatrixXd CellReader::ReadNumbers(const FieldColumns& field, const NumberRule& rule) const {
  const int num_components = static_cast<int>(field.column.size());
  Eigen::MatrixXd numbers = Eigen::MatrixXd::Constant(table_.num_rows(), num_components, kBlank);
  for (int i = 0; i < num_components; ++i) {
    if (field.column[i] < 0) continue;
    ReadNumbers(field.column[i], field.to_si[i], rule, numbers.col(i));
  }
  return numbers;
}

Eigen::MatrixXd CellReader::ReadCoordinates(const FieldColumns& field) const {
  CheckAllOrNone(field.column);
  return ReadNumbers(field, kAnyNumber);
}

std::vector<int> CellReader::ReadLabels(int column_idx,
                                        bool may_be_blank,
                                        std::vector<std::string>* names) const {
  std::vector<int> indices(table_.num_rows(), -1);
  std::unordered_map<std::string_view, int> idx_of_name;
  for (int row = 0; row < table_.num_rows(); ++row) {
    const std::string_view cell = table_.cell(row, column_idx);
    if (cell.empty()) {
      if (!may_be_blank) Error(row, column_idx, "the cell is blank; every row needs a name here");
      continue;
    }
    const auto [found, is_new] = idx_of_name.emplace(cell, static_cast<int>(names->size()));
    if (is_new) names->emplace_back(cell);
    indices[row] = found->second;
  }
  return indices;
}

bool CellReader::IsNumeric(int column_idx) const {
  bool any = false;
  if (!table_.doubt(column_idx).message.empty()) return false;
  for (int row = 0; row < table_.num_rows(); ++row) {
    const std::string_view cell = table_.cell(row, column_idx);
    if (cell.empty()) continue;
    if (!ParseDouble(cell)) return false;
    any = true;
  }
  return any;
}

std::optional<int> CellReader::FirstBlankLine(int column_idx) const {
  for (int row = 0; row < table_.num_rows(); ++row) {
    if (table_.cell(row, column_idx).empty()) return table_.line(row);
  }
  return std::nullopt;
}

Eigen::VectorXd CellReader::NumbersOrNaN(int column_idx) const {
  Eigen::VectorXd numbers(table_.num_rows());
  for (int row = 0; row < table_.num_rows(); ++row) {
    numbers[row] = ParseDouble(table_.cell(row, column_idx)).value_or(kBlank);
  }
  return numbers;
}

void CellReader::CheckNoneBlank(int column_idx) const {
  for (int row = 0; row < table_.num_rows(); ++row) {
    if (!table_.cell(row, column_idx).empty()) continue;
    Error(row, column_idx, "the cell is blank; every row needs all joint coordinates");
  }
}

void CellReader::CheckAllOrNone(const std::vector<int>& columns) const {
  for (int row = 0; row < table_.num_rows(); ++row) {
    int blank = -1, given = -1;
    for (const int column : columns) {
      if (column < 0) return;
      (table_.cell(row, column).empty() ? blank : given) = column;
    }
    if (blank < 0 || given < 0) continue;
    Error(row,
          blank,
          fmt::format("the cell is blank, but '{}' is given in this row; give all or none",
                      table_.name(given)));
  }
}

}  // namespace dhcal
