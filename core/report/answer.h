// The report in short, in plain words: how accurate, what was found, what can be trusted, what to
// do next.
#ifndef DHCAL_CORE_REPORT_ANSWER_H_
#define DHCAL_CORE_REPORT_ANSWER_H_

#include <vector>

#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

/// What the first screen says and, where there is a calibration, how far it can be trusted.
std::vector<Section> AnswerOf(const Result& result);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_ANSWER_H_
