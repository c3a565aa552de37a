// What the words in names of columns mean, other than ours.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_WORDS_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_WORDS_H_

#include <string>
#include <string_view>

#include "problems/formats/recording/column_spelling.h"

namespace dhcal {

/// The words of ours that mean the same: "measurement_x" -> "x"; others as they are.
std::string OurWords(const std::string& words);

/// A column of a matrix, "xyz_mm(1)", as the component that it is; another one as it was.
ColumnSpelling ComponentOf(std::string_view name, ColumnSpelling spelling);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_WORDS_H_
