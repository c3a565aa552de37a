// What a terminal shows: the answer, what to do next and where the rest is, on one screen.
#ifndef DHCAL_CORE_REPORT_FIRST_SCREEN_H_
#define DHCAL_CORE_REPORT_FIRST_SCREEN_H_

#include <string>

#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

/// `folder`: where the result was written; empty where it could not be.
Document FirstScreenOf(const Result& result, const std::string& folder);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_FIRST_SCREEN_H_
