#include "core/model/diagnosis.h"

namespace dhcal {

const char* ToString(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::kConsistent:
      return "consistent";
    case DiagnosisVerdict::kExplained:
      return "explained";
    case DiagnosisVerdict::kPartlyExplained:
      return "partly_explained";
    case DiagnosisVerdict::kAmbiguous:
      return "ambiguous";
    case DiagnosisVerdict::kUnexplained:
      return "unexplained";
    case DiagnosisVerdict::kFailed:
      return "failed";
  }
  return "?";
}

}  // namespace dhcal
