#include "tools/camera/tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "core/io/csv_text.h"
#include "core/math/statistics.h"

namespace dhcal {

void Remark(const RulerCommand& command,
            const std::vector<RulerReading>& found,
            Diagnostics* diagnostics) {
  std::vector<double> widths, errors;
  for (const RulerReading& reading : found) {
    if (!reading.refusal.empty()) continue;
    widths.push_back(reading.width);
    errors.push_back(reading.error_px);
  }
  if (widths.empty()) return;
  if (Median(widths) > 0.55) {
    diagnostics->Warning({"command line"},
                         fmt::format("the {} lines are wider than what is between them; if the "
                                     "rulings are the others, say --rulings {}",
                                     command.rulings,
                                     command.rulings == "dark" ? "light" : "dark"));
  }
  if (command.lens.empty() && Median(errors) > 0.1) {
    diagnostics->Warning(
        {"command line"},
        fmt::format("rulings lie {:.2f} px beside straight, even rows: calibrate the "
                    "lens (--calibrate_lens) and give it with --lens",
                    Median(errors)));
  }
}

std::string DetailsText(const RulerCommand& command,
                        const std::vector<RulerReading>& found,
                        const std::vector<double>& ruler,
                        double pitch) {
  CsvText csv;
  for (const char* const name : {"image",
                                 "ruler_mm",
                                 "ruler_sigma_mm",
                                 "rulings",
                                 "missing",
                                 "set_aside",
                                 "scatter_px",
                                 "px_per_pitch"}) {
    csv.Label(name);
  }
  csv.EndRow();
  const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
  for (std::size_t k = 0; k < found.size(); ++k) {
    const RulerReading& reading = found[k];
    csv.Label(command.images[k]);
    if (!std::isfinite(ruler[k])) {
      for (int blank = 0; blank < 7; ++blank) csv.Blank();
    } else {
      csv.Number(rounded(ruler[k]));
      csv.Number(rounded(reading.sigma * pitch));
      csv.Integer(static_cast<int>(reading.rulings.size()));
      csv.Integer(reading.missing);
      csv.Integer(reading.num_set_aside);
      csv.Number(std::round(reading.error_px * 1e4) / 1e4);
      csv.Number(std::round(reading.px_per_pitch * 1e3) / 1e3);
    }
    csv.EndRow();
  }
  return csv.Take();
}

std::string Summary(const std::vector<RulerReading>& found,
                    const std::vector<double>& ruler,
                    double pitch) {
  std::vector<double> sigmas;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (std::isfinite(ruler[k])) sigmas.push_back(found[k].sigma * pitch);
  }
  return fmt::format(
      "{} of {} images read; sigma of a reading {:.5f} mm (median), {:.5f} mm "
      "(largest), without the ruler's own errors\n",
      sigmas.size(),
      found.size(),
      Median(sigmas),
      *std::max_element(sigmas.begin(), sigmas.end()));
}

}  // namespace dhcal
