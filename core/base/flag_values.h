// What the texts of flags mean: numbers in their ranges.
#ifndef DHCAL_CORE_BASE_FLAG_VALUES_H_
#define DHCAL_CORE_BASE_FLAG_VALUES_H_

#include <string>

#include "core/base/diagnostics.h"

namespace dhcal {

/// Reads flags' texts, and says what is wrong in them. A flag that is not given (empty) keeps what
/// stands there.
class FlagValues {
 public:
  explicit FlagValues(Diagnostics* diagnostics) : diagnostics_(diagnostics) {}

  void Whole(const char* name, const std::string& text, int low, int high, int* number);
  /// False where it is not given or wrong.
  bool Number(const char* name, const std::string& text, double low, double high, double* number);
  /// "--name is 'text', but <expected> is expected".
  void Wrong(const char* name, const std::string& text, const std::string& expected);
  void Error(const std::string& what) { diagnostics_->Error({"command line"}, what); }

 private:
  Diagnostics* diagnostics_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_FLAG_VALUES_H_
