// A table in lines of text.
#ifndef DHCAL_CORE_REPORT_TEXT_TABLE_H_
#define DHCAL_CORE_REPORT_TEXT_TABLE_H_

#include <string>

#include "core/report/document.h"

namespace dhcal {

/// Title, heading and rows, indented by two. Columns are as wide as their cells need; when that is
/// more than the report is wide, the first column gives way.
std::string ToText(const Table& table);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_TEXT_TABLE_H_
