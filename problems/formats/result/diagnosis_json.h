// The key `diagnosis` of result.json (FORMATS.md, section 3).
#ifndef DHCAL_PROBLEMS_FORMATS_RESULT_DIAGNOSIS_JSON_H_
#define DHCAL_PROBLEMS_FORMATS_RESULT_DIAGNOSIS_JSON_H_

#include "core/io/json_values.h"
#include "core/model/diagnosis.h"

namespace dhcal {

Json DiagnosisToJson(const DiagnosisResult& diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RESULT_DIAGNOSIS_JSON_H_
