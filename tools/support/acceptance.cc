#include "tools/support/acceptance.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/report/error_table.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

/// Rows that a test would have had, but that were found misread.
std::string ExcludedTestRows(const Result& result) {
  const auto count = std::count_if(result.rows_set_aside.begin(),
                                   result.rows_set_aside.end(),
                                   [](const RowSetAside& row) { return row.test; });
  if (count == 0) return "";
  return fmt::format(" ({} of these rows excluded as misread)", count);
}

}  // namespace

std::optional<double> ParseLimit(const std::string& text) {
  for (const auto& [unit, metres] : {std::pair("mm", 1e-3), std::pair("um", 1e-6)}) {
    if (!EndsWith(text, unit)) continue;
    const std::optional<double> value =
        ParseDouble(Trim(std::string_view(text).substr(0, text.size() - 2)));
    if (value && *value > 0) return *value * metres;
  }
  return std::nullopt;
}

Acceptance JudgeAcceptance(const Result& result, double limit) {
  const double error = ErrorUnseen(result);
  const std::string asked = WithMillimetres(limit);
  if (std::isnan(error)) {
    return {false,
            fmt::format("not accepted: no row was kept unseen, so nothing shows whether the error "
                        "is within {}; write test in a column set of some rows",
                        asked)};
  }
  const bool met = error <= limit;
  return {met,
          fmt::format("{}: on rows that were not fitted{} calibrated.yaml errs by {} ({}), {} {} "
                      "asked for",
                      met ? "accepted" : "not accepted",
                      ExcludedTestRows(result),
                      WithMillimetres(error),
                      ErrorName(result.kind),
                      met ? "within the" : "more than the",
                      asked)};
}

}  // namespace dhcal
