// Reads the variables of a MATLAB file as the text of a table.
#ifndef DHCAL_CORE_IO_MAT_TEXT_H_
#define DHCAL_CORE_IO_MAT_TEXT_H_

#include <optional>
#include <string>

#include "core/io/file_errors.h"

namespace dhcal {

/// Whether the file's name ends in ".mat".
bool IsMatFile(const std::string& file);

/// Comma separated text: a header, then a line per row, so that line 2 is the first row. Columns
/// are the real numeric vectors that are as long as the longest one, and the columns of such
/// matrices, "q_deg(1)" ...; of a struct its fields. Numbers that are NaN are blank. Nothing and an
/// error when the file is none or holds no such variable; one note names the variables left out.
std::optional<std::string> MatToText(const std::string& file, FileErrors* errors);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_MAT_TEXT_H_
