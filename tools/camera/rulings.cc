#include "tools/camera/rulings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/math/statistics.h"
#include "tools/camera/numbering.h"
#include "tools/camera/row_checks.h"

namespace dhcal {
namespace {

constexpr double kOwn = 0.2;        // of a pitch: pieces that near a ruling are its own
constexpr double kOff = 5;          // robust sigmas: a ruling that lies further off is set aside
constexpr double kOffFloor = 0.03;  // and at least so far [px]

double Scatter(const Pencil& pencil, const Lens& lens, const std::vector<NumberedPiece>& pieces) {
  return std::max(kFinestScatter, RobustScale(PencilErrors(pencil, lens, pieces)));
}

/// Fits until the scatter that the loss goes by is that of the fit.
bool FitRobustly(const Lens& lens, std::vector<NumberedPiece>* pieces, Pencil* pencil) {
  if (!FitPencil(lens, 1e3, pieces, pencil)) return false;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    if (!FitPencil(lens, Scatter(*pencil, lens, *pieces), pieces, pencil)) return false;
  }
  return true;
}

/// Numbers every piece of every track by the pencil; those between rulings are left out.
std::vector<NumberedPiece> NumberedBy(const Pencil& pencil,
                                      const Lens& lens,
                                      const std::vector<Track>& tracks) {
  std::vector<NumberedPiece> pieces;
  for (const Track& track : tracks) {
    for (const RulingPiece& piece : track.pieces) {
      const double x = pencil.At(piece, lens);
      const double number = std::round(x);
      if (!(std::abs(x - number) < kOwn) || std::abs(number) > 1e5) continue;
      pieces.push_back({piece, static_cast<int>(number), 1});
    }
  }
  return pieces;
}

/// The point near a piece's middle that lies `error_px` beyond its ruling in the row.
Eigen::Vector2d PlaceOf(const NumberedPiece& at,
                        double error_px,
                        const Pencil& pencil,
                        const Lens& lens) {
  const Eigen::Vector2d middle = 0.5 * (at.piece.first + at.piece.second);
  const Eigen::Vector2d along = pencil.Gradient(middle, lens).normalized();
  return middle + along * (error_px - (pencil.At(middle, lens) - at.ruling) / at.per_px);
}

/// The rulings as found, those off the row marked.
std::vector<FoundRuling> Rulings(const Pencil& pencil,
                                 const Lens& lens,
                                 std::vector<NumberedPiece> pieces) {
  std::stable_sort(
      pieces.begin(), pieces.end(), [](const NumberedPiece& a, const NumberedPiece& b) {
        return std::make_pair(a.ruling, a.piece.first.sum()) <
               std::make_pair(b.ruling, b.piece.first.sum());
      });
  const std::vector<double> errors = PencilErrors(pencil, lens, pieces);
  std::vector<FoundRuling> rulings;
  std::vector<double> medians;
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    while (end < pieces.size() && pieces[end].ruling == pieces[begin].ruling) ++end;
    FoundRuling ruling;
    ruling.number = pieces[begin].ruling;
    ruling.error_px = Median({errors.begin() + static_cast<std::ptrdiff_t>(begin),
                              errors.begin() + static_cast<std::ptrdiff_t>(end)});
    ruling.place = PlaceOf(pieces[(begin + end) / 2], ruling.error_px, pencil, lens);
    medians.push_back(ruling.error_px);
    rulings.push_back(ruling);
  }
  const double limit = std::max(kOffFloor, kOff * RobustScale(medians));
  for (FoundRuling& ruling : rulings) ruling.set_aside = std::abs(ruling.error_px) > limit;
  return rulings;
}

void KeepRulings(const std::vector<FoundRuling>& rulings, std::vector<NumberedPiece>* pieces) {
  std::set<int> off;
  for (const FoundRuling& ruling : rulings) {
    if (ruling.set_aside) off.insert(ruling.number);
  }
  const auto is_off = [&](const NumberedPiece& at) { return off.count(at.ruling) > 0; };
  pieces->erase(std::remove_if(pieces->begin(), pieces->end(), is_off), pieces->end());
}

/// What Tukey's loss gives no weight has no part in the sigma either.
void KeepWeighted(const Pencil& pencil, const Lens& lens, std::vector<NumberedPiece>* pieces) {
  const double limit = 4.7 * Scatter(pencil, lens, *pieces);
  const auto is_off = [&](const NumberedPiece& at) {
    return std::abs(pencil.At(at.piece, lens) - at.ruling) > limit * at.per_px;
  };
  pieces->erase(std::remove_if(pieces->begin(), pieces->end(), is_off), pieces->end());
}

double LineWidth(const Pencil& pencil, const Lens& lens, const std::vector<NumberedPiece>& pieces) {
  std::vector<double> widths;
  for (const NumberedPiece& at : pieces) {
    widths.push_back(std::abs(pencil.At(at.piece.second, lens) - pencil.At(at.piece.first, lens)));
  }
  return Median(widths);
}

void Summarise(const Lens& lens, RulerReading* reading) {
  reading->place = reading->pencil.p[0];
  reading->sigma = ReadingSigma(reading->pencil, lens, reading->pieces);
  reading->error_px = Scatter(reading->pencil, lens, reading->pieces);
  reading->px_per_pitch = 1 / reading->pencil.PerPixel(lens.centre(), lens);
  reading->width = LineWidth(reading->pencil, lens, reading->pieces);
  const int span = reading->rulings.back().number - reading->rulings.front().number + 1;
  reading->missing = span - static_cast<int>(reading->rulings.size());
  for (const FoundRuling& ruling : reading->rulings) reading->num_set_aside += ruling.set_aside;
}

constexpr char kNoPlane[] = "shows lines that no plane with rulings would show to a camera";

/// A reading by one count.
RulerReading FitCount(const std::vector<NumberedPiece>& count,
                      const std::vector<Track>& tracks,
                      const Lens& lens,
                      const RulerOptions& options) {
  RulerReading reading;
  const int found = NumRulings(count);
  if (found < options.fewest) {
    reading.refusal = fmt::format(
        "shows {} rulings in a row, but a reading takes at least {}", found, options.fewest);
    return reading;
  }
  std::vector<NumberedPiece> pieces = count;
  reading.pencil = LinearPencil(pieces, lens);
  if (!reading.pencil.IsRegular(lens) || !FitRobustly(lens, &pieces, &reading.pencil)) {
    reading.refusal = kNoPlane;
    return reading;
  }
  reading.refusal = CountDoubt(reading.pencil, lens, count);
  if (!reading.refusal.empty()) return reading;

  reading.pieces = NumberedBy(reading.pencil, lens, tracks);
  bool fitted = FitRobustly(lens, &reading.pieces, &reading.pencil);
  if (fitted) {
    KeepRulings(Rulings(reading.pencil, lens, reading.pieces), &reading.pieces);
    fitted = FitRobustly(lens, &reading.pieces, &reading.pencil);
  }
  if (!fitted) {
    reading.refusal = kNoPlane;
    return reading;
  }
  std::vector<NumberedPiece> all = NumberedBy(reading.pencil, lens, tracks);
  SetPerPixel(reading.pencil, lens, &all);
  reading.rulings = Rulings(reading.pencil, lens, std::move(all));
  KeepWeighted(reading.pencil, lens, &reading.pieces);
  Summarise(lens, &reading);
  reading.refusal = RowDoubt(reading, lens, tracks, options);
  return reading;
}

/// Whether two readings are the same but for the number that they count from.
bool SameRow(const RulerReading& a, const RulerReading& b) {
  const double apart = a.place - b.place;
  return std::abs(apart - std::round(apart)) < 0.02 &&
         std::abs(a.px_per_pitch / b.px_per_pitch - 1) < 0.01;
}

}  // namespace

int NumRulings(const std::vector<NumberedPiece>& pieces) {
  std::set<int> numbers;
  for (const NumberedPiece& at : pieces) numbers.insert(at.ruling);
  return static_cast<int>(numbers.size());
}

CountedRulings CountRulings(const cv::Mat& gray, const Lens& lens, const RulerOptions& options) {
  CountedRulings counted;
  counted.tracks = FindTracks(gray, options.view);
  const std::vector<CandidateLine> lines =
      CandidateLines(counted.tracks, lens, options.view.along_columns);
  for (const Numbering& numbering : NumberLines(lines, options.longest_gap)) {
    std::vector<NumberedPiece> pieces;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (!numbering.numbers[k]) continue;
      const int number = *numbering.numbers[k] * (options.backwards ? -1 : 1);
      for (const int track : lines[k].tracks) {
        for (const RulingPiece& piece : counted.tracks[static_cast<std::size_t>(track)].pieces) {
          pieces.push_back({piece, number, 1});
        }
      }
    }
    counted.counts.push_back(std::move(pieces));
  }
  if (lines.empty()) {
    counted.refusal = "shows no rulings";
  } else if (counted.counts.empty()) {
    counted.refusal = fmt::format("shows no row of rulings: lines across the ruler found in it: {}",
                                  lines.size());
  }
  return counted;
}

RulerReading FitRulings(const CountedRulings& counted,
                        const Lens& lens,
                        const RulerOptions& options) {
  RulerReading best;
  best.refusal = counted.refusal;
  bool first = true;
  for (const std::vector<NumberedPiece>& count : counted.counts) {
    RulerReading reading = FitCount(count, counted.tracks, lens, options);
    if (first || (!best.refusal.empty() && reading.refusal.empty())) {
      best = std::move(reading);
    } else if (reading.refusal.empty() && !SameRow(best, reading)) {
      best.refusal = fmt::format("can be counted in two ways, rulings {:.1f} px or {:.1f} px apart",
                                 best.px_per_pitch,
                                 reading.px_per_pitch);
      return best;
    }
    first = false;
  }
  return best;
}

RulerReading ReadRulings(const cv::Mat& gray, const Lens& lens, const RulerOptions& options) {
  return FitRulings(CountRulings(gray, lens, options), lens, options);
}

}  // namespace dhcal
