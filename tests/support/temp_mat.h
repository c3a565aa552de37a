// A MATLAB file for one test, written with matio.
#ifndef DHCAL_TESTS_SUPPORT_TEMP_MAT_H_
#define DHCAL_TESTS_SUPPORT_TEMP_MAT_H_

#include <array>
#include <cstddef>
#include <matio.h>
#include <string>
#include <vector>

#include "tests/support/temp_file.h"

namespace dhcal {

/// A matrix of doubles, column by column; `values` must live until the file is written.
inline matvar_t* MatVariable(const char* name,
                             std::size_t rows,
                             std::size_t columns,
                             double* values) {
  std::array<std::size_t, 2> dims = {rows, columns};
  return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims.data(), values, 0);
}

/// A MATLAB file for one test. It takes variables over; they may be fields of one struct.
class TempMat {
 public:
  TempMat(const std::vector<matvar_t*>& variables, bool as_struct) : file_("", ".mat") {
    mat_t* const mat = Mat_CreateVer(file_.path().c_str(), nullptr, MAT_FT_MAT5);
    if (as_struct) {
      std::vector<const char*> names;
      for (const matvar_t* variable : variables) names.push_back(variable->name);
      std::array<std::size_t, 2> dims = {1, 1};
      matvar_t* const all = Mat_VarCreateStruct(
          "data", 2, dims.data(), names.data(), static_cast<unsigned>(names.size()));
      for (std::size_t k = 0; k < variables.size(); ++k) {
        Mat_VarSetStructFieldByIndex(all, k, 0, variables[k]);
      }
      Mat_VarWrite(mat, all, MAT_COMPRESSION_ZLIB);
      Mat_VarFree(all);
    } else {
      for (matvar_t* variable : variables) {
        Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
        Mat_VarFree(variable);
      }
    }
    Mat_Close(mat);
  }

  const std::string& path() const { return file_.path(); }

 private:
  TempFile file_;
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_TEMP_MAT_H_
