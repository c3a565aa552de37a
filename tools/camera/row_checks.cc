#include "tools/camera/row_checks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>

#include <fmt/format.h>

namespace dhcal {
namespace {

constexpr double kBetween = 0.25;  // of a pitch: what lies further off a ruling is between two
constexpr double kMostContradicted = 0.1;  // pieces with another number than counted, of all
constexpr double kMostBetween = 0.25;      // pieces between rulings, of all
constexpr double kLeastFilled = 0.6;       // of the numbers from the first to the last
constexpr double kLargestSigma = 0.03;     // of a reading [pitches]
// A gap counts as certain where one ruling more or less makes the errors so many times larger.
constexpr double kWorse = 5, kWorseBy = 0.1;  // and so many px

double RmsError(const std::vector<NumberedPiece>& pieces, const Lens& lens) {
  const Pencil pencil = LinearPencil(pieces, lens);
  // per px as counted: that of the pencil at hand would shrink with a pencil that folds.
  double squares = 0;
  for (const double error : PencilErrors(pencil, lens, pieces)) squares += error * error;
  return std::sqrt(squares / static_cast<double>(pieces.size()));
}

/// Whether the row could as well be one ruling longer or shorter where `last` is followed by a gap.
bool GapIsDoubtful(const std::vector<NumberedPiece>& pieces, const Lens& lens, int last) {
  const double as_counted = RmsError(pieces, lens);
  for (const int shift : {-1, 1}) {
    std::vector<NumberedPiece> shifted = pieces;
    for (NumberedPiece& at : shifted) {
      if (at.ruling > last) at.ruling += shift;
    }
    if (RmsError(shifted, lens) < kWorse * as_counted + kWorseBy) return true;
  }
  return false;
}

std::string GapDoubt(const RulerReading& reading, const Lens& lens, int longest_gap) {
  std::set<int> numbers;
  for (const NumberedPiece& at : reading.pieces) numbers.insert(at.ruling);
  for (auto number = numbers.begin(); std::next(number) != numbers.end(); ++number) {
    const int missing = *std::next(number) - *number - 1;
    if (missing > longest_gap) {
      return fmt::format(
          "has a gap of {} rulings; across more than {} it is not counted (clean the "
          "ruler, or allow it with --longest_gap)",
          missing,
          longest_gap);
    }
    if (missing > 0 && GapIsDoubtful(reading.pieces, lens, *number)) {
      return fmt::format("has a gap of {} or {} rulings, which of them the others do not tell",
                         missing,
                         missing + 1);
    }
  }
  return "";
}

/// Share of the tracks' pieces that lie between rulings, inside the row.
double ShareBetween(const RulerReading& reading,
                    const Lens& lens,
                    const std::vector<Track>& tracks) {
  const int first = reading.rulings.front().number, last = reading.rulings.back().number;
  double all = 0, between = 0;
  for (const Track& track : tracks) {
    for (const RulingPiece& piece : track.pieces) {
      const double x = reading.pencil.At(piece, lens);
      if (!(x > first - 0.5 && x < last + 0.5)) continue;
      all += 1;
      between += std::abs(x - std::round(x)) > kBetween ? 1 : 0;
    }
  }
  return all > 0 ? between / all : 1;
}

}  // namespace

std::string CountDoubt(const Pencil& pencil,
                       const Lens& lens,
                       const std::vector<NumberedPiece>& counted) {
  double contradicted = 0, between = 0;
  for (const NumberedPiece& at : counted) {
    const double x = pencil.At(at.piece, lens);
    if (std::abs(x - std::round(x)) > kBetween) {
      between += 1;
    } else if (std::abs(x - at.ruling) > 0.5) {
      contradicted += 1;
    }
  }
  const auto all = static_cast<double>(counted.size());
  if (contradicted > kMostContradicted * all) {
    return fmt::format(
        "shows rulings that count otherwise one by one than as a row: {:.0f} % of "
        "them",
        100 * contradicted / all);
  }
  if (between > kMostBetween * all) {
    return fmt::format(
        "shows lines of which {:.0f} % lie between the rulings of an even row; if the "
        "lens bends lines, calibrate it (--calibrate_lens)",
        100 * between / all);
  }
  return "";
}

std::string RowDoubt(const RulerReading& reading,
                     const Lens& lens,
                     const std::vector<Track>& tracks,
                     const RulerOptions& options) {
  const int rulings = NumRulings(reading.pieces);
  if (rulings < options.fewest) {
    return fmt::format(
        "shows {} rulings in a row, but a reading takes at least {}", rulings, options.fewest);
  }
  std::string gap = GapDoubt(reading, lens, options.longest_gap);
  if (!gap.empty()) return gap;
  const int first = reading.rulings.front().number, last = reading.rulings.back().number;
  if (rulings < kLeastFilled * (last - first + 1)) {
    return fmt::format("shows {} of {} rulings; more than {:.0f} % are needed to count them",
                       rulings,
                       last - first + 1,
                       100 * kLeastFilled);
  }
  if (ShareBetween(reading, lens, tracks) > kMostBetween) {
    return "shows as many lines between the rulings as a finer pitch would";
  }
  if (reading.place < first - 1 || reading.place > last + 1) {
    return fmt::format("has its centre {:.1f} pitches beyond the rulings that it shows",
                       reading.place > last ? reading.place - last : first - reading.place);
  }
  if (!(reading.sigma < kLargestSigma)) {
    return fmt::format("gives the centre to {:.2f} pitches only, too little to count by",
                       reading.sigma);
  }
  return "";
}

}  // namespace dhcal
