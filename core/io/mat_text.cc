#include "core/io/mat_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <matio.h>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/csv_text.h"

namespace dhcal {

namespace {

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

/// More than any recording has; some damaged files never end.
constexpr int kMostVariables = 1000;

/// No recording's matrix is wider; an image, or a damaged file, is.
constexpr std::size_t kMostColumns = 64;

/// A vector or matrix, column by column as MATLAB stores it.
struct MatNumbers {
  std::string name;
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
};

template <typename T>
std::vector<double> ToDoubles(const matvar_t& variable, std::size_t count) {
  const T* const data = static_cast<const T*>(variable.data);
  return std::vector<double>(data, data + count);
}

/// The numbers of a variable; empty when it holds none of a kind that MATLAB computes with.
std::vector<double> ValuesOf(const matvar_t& variable, std::size_t count) {
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return ToDoubles<double>(variable, count);
    case MAT_T_SINGLE:
      return ToDoubles<float>(variable, count);
    case MAT_T_INT8:
      return ToDoubles<mat_int8_t>(variable, count);
    case MAT_T_UINT8:
      return ToDoubles<mat_uint8_t>(variable, count);
    case MAT_T_INT16:
      return ToDoubles<mat_int16_t>(variable, count);
    case MAT_T_UINT16:
      return ToDoubles<mat_uint16_t>(variable, count);
    case MAT_T_INT32:
      return ToDoubles<mat_int32_t>(variable, count);
    case MAT_T_UINT32:
      return ToDoubles<mat_uint32_t>(variable, count);
    default:
      return {};
  }
}

class MatReader {
 public:
  MatReader(const std::string& file, FileErrors* errors) : file_(file), errors_(errors) {}

  std::optional<std::string> Read();

 private:
  void Add(matvar_t* variable);
  void AddNumbers(const matvar_t& variable, const std::string& name);
  /// Whether the file can hold what it says: a damaged one asks for all the memory there is.
  bool IsPlausible(matvar_t* variable) const;
  void DropShort(std::size_t num_rows);
  std::string Text(std::size_t num_rows) const;

  std::string file_;
  FileErrors* errors_;
  std::vector<MatNumbers> numbers_;
  std::vector<std::string> left_out_;
  bool opaque_ = false;
  double file_size_ = 0;  // [bytes]
};

void MatReader::AddNumbers(const matvar_t& variable, const std::string& name) {
  MatNumbers numbers;
  numbers.name = name;
  if (variable.rank == 2 && variable.isComplex == 0 && variable.data != nullptr) {
    numbers.rows = variable.dims[0];
    numbers.columns = variable.dims[1];
    // Counted by what was read, not by what the file says of itself.
    const std::size_t count = numbers.rows * numbers.columns;
    const auto size = static_cast<std::size_t>(std::max(variable.data_size, 1));
    if (count > 0 && count <= variable.nbytes / size) numbers.values = ValuesOf(variable, count);
  }
  if (numbers.values.empty()) {
    left_out_.push_back(name);
    return;
  }
  if (numbers.rows == 1) std::swap(numbers.rows, numbers.columns);
  if (numbers.columns > kMostColumns) {
    left_out_.push_back(name);
    return;
  }
  numbers_.push_back(std::move(numbers));
}

void MatReader::Add(matvar_t* variable) {
  const std::string name = variable->name == nullptr ? "" : variable->name;
  const bool one = variable->rank == 2 && variable->dims[0] == 1 && variable->dims[1] == 1;
  if (variable->class_type == MAT_C_OPAQUE || variable->class_type == MAT_C_OBJECT) {
    opaque_ = true;
    left_out_.push_back(name);
  } else if (variable->class_type == MAT_C_STRUCT && one) {
    const unsigned num_fields = Mat_VarGetNumberOfFields(variable);
    for (unsigned k = 0; k < num_fields; ++k) {
      matvar_t* const field = Mat_VarGetStructFieldByIndex(variable, k, 0);
      if (field != nullptr) Add(field);
    }
  } else if (variable->class_type >= MAT_C_DOUBLE && variable->class_type <= MAT_C_UINT32) {
    AddNumbers(*variable, name);
  } else {
    left_out_.push_back(name);
  }
}

bool MatReader::IsPlausible(matvar_t* variable) const {
  constexpr double kBestCompression = 1100;  // of zlib
  double count = 1;
  for (int k = 0; k < variable->rank; ++k) count *= static_cast<double>(variable->dims[k]);
  if (count > kBestCompression * file_size_) return false;
  if (variable->class_type != MAT_C_STRUCT || count != 1) return true;
  const unsigned num_fields = Mat_VarGetNumberOfFields(variable);
  for (unsigned k = 0; k < num_fields; ++k) {
    matvar_t* const field = Mat_VarGetStructFieldByIndex(variable, k, 0);
    if (field != nullptr && !IsPlausible(field)) return false;
  }
  return true;
}

void MatReader::DropShort(std::size_t num_rows) {
  const auto is_short = [&](const MatNumbers& numbers) { return numbers.rows != num_rows; };
  for (const MatNumbers& numbers : numbers_) {
    if (is_short(numbers)) left_out_.push_back(numbers.name);
  }
  numbers_.erase(std::remove_if(numbers_.begin(), numbers_.end(), is_short), numbers_.end());
}

std::string MatReader::Text(std::size_t num_rows) const {
  CsvText csv;
  for (const MatNumbers& numbers : numbers_) {
    for (std::size_t j = 0; j < numbers.columns; ++j) {
      csv.Label(numbers.columns == 1 ? numbers.name : fmt::format("{}({})", numbers.name, j + 1));
    }
  }
  csv.EndRow();
  for (std::size_t i = 0; i < num_rows; ++i) {
    for (const MatNumbers& numbers : numbers_) {
      for (std::size_t j = 0; j < numbers.columns; ++j) {
        const double value = numbers.values[j * num_rows + i];
        // An infinite number must not pass as not measured.
        if (std::isinf(value)) {
          csv.Label("inf");
        } else {
          csv.Number(value);
        }
      }
    }
    csv.EndRow();
  }
  return csv.Take();
}

std::optional<std::string> MatReader::Read() {
  Mat_LogInitFunc("ceres_dhcal", [](int, char*) {});  // its messages are for developers
  const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open(file_.c_str(), MAT_ACC_RDONLY));
  if (!mat) {
    errors_->Error({file_}, "this is no MATLAB file that can be read; save it with save -v7");
    return std::nullopt;
  }
  std::error_code status;
  file_size_ = static_cast<double>(std::filesystem::file_size(file_, status));
  for (int k = 0; k < kMostVariables; ++k) {
    const std::unique_ptr<matvar_t, FreeVariable> variable(Mat_VarReadNextInfo(mat.get()));
    if (!variable) break;
    if (!IsPlausible(variable.get()) || Mat_VarReadDataAll(mat.get(), variable.get()) != 0) {
      errors_->Error(
          {file_},
          "the file is damaged: a variable cannot be read, or is larger than the file can hold");
      return std::nullopt;
    }
    Add(variable.get());
  }
  std::size_t num_rows = 0;
  for (const MatNumbers& numbers : numbers_) num_rows = std::max(num_rows, numbers.rows);
  DropShort(num_rows);
  if (numbers_.empty() || num_rows < 2) {
    errors_->Error({file_},
                   opaque_
                       ? "the file holds a MATLAB table or object, which MATLAB alone reads; "
                         "save a struct of vectors: s = table2struct(T, 'ToScalar', true); "
                         "save('recording.mat', '-struct', 's')"
                       : "the file holds no vectors or matrices of numbers with a row per "
                         "reading; save variables such as q_deg (n x joints) and xyz_mm (n x 3)");
    return std::nullopt;
  }
  if (!left_out_.empty()) {
    errors_->Note({file_},
                  fmt::format("variables left out, for they are no real numbers with {} rows: {}",
                              num_rows,
                              QuotedList(left_out_, "and")));
  }
  return Text(num_rows);
}

}  // namespace

bool IsMatFile(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  return ending == ".mat" || ending == ".MAT";
}

std::optional<std::string> MatToText(const std::string& file, FileErrors* errors) {
  return MatReader(file, errors).Read();
}

}  // namespace dhcal
