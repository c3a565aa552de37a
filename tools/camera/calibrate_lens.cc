#include "tools/camera/calibrate_lens.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

namespace dhcal {
namespace {

constexpr int kFewestImages = 3;

bool TooFew(StraightenedLens* straightened) {
  if (straightened->failure.empty() && straightened->images < kFewestImages) {
    straightened->failure =
        fmt::format("only {} images show a row of rulings, but a lens takes at least {}",
                    straightened->images,
                    kFewestImages);
  }
  return !straightened->failure.empty();
}

}  // namespace

StraightenedLens CalibrateLens(const Lens& plain,
                               const std::vector<CountedRulings>& counted,
                               const RulerOptions& options) {
  std::vector<std::vector<NumberedPiece>> rows;
  for (const CountedRulings& image : counted) {
    if (image.counts.empty() || NumRulings(image.counts.front()) < options.fewest) continue;
    rows.push_back(image.counts.front());
  }
  StraightenedLens first = Straighten(plain, rows);
  if (TooFew(&first)) return first;
  rows.clear();
  for (const CountedRulings& image : counted) {
    RulerReading reading = FitRulings(image, first.lens, options);
    if (reading.refusal.empty()) rows.push_back(std::move(reading.pieces));
  }
  StraightenedLens second = Straighten(first.lens, std::move(rows));
  TooFew(&second);
  second.rms_before = first.rms_before;
  return second;
}

}  // namespace dhcal
