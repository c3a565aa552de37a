#include "tools/camera/numbering.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/math/statistics.h"

namespace dhcal {
namespace {

constexpr double kLong = 0.4;     // of the usual length: tracks that numbers are sought for
constexpr double kOnPlace = 0.2;  // of a pitch, from where a ruling is expected
constexpr double kFollow = 0.5;   // how far the pitch follows each step
constexpr double kMissing = 0.7;  // what a ruling that is missing costs, of one that is there
constexpr double kRival = 0.6;    // of the best score: numberings that are weighed against it
constexpr std::size_t kMostRivals = 4;
constexpr double kFinestPitch = 3;  // [px]

/// A track as a line u(v) along the ruler, v across it, the lens undone.
struct TrackLine {
  double at = 0, slope = 0, middle = 0, low = 0, high = 0;
  int track = 0, rows = 0;
  double Place(double v) const { return at + slope * (v - middle); }
};

TrackLine LineOf(const Track& track, const Lens& lens, bool along_columns) {
  TrackLine line;
  double n = 0, sv = 0, su = 0, svv = 0, suv = 0;
  for (const RulingPiece& piece : track.pieces) {
    Eigen::Vector2d m = Straightened(lens, 0.5 * (piece.first + piece.second));
    if (along_columns) std::swap(m.x(), m.y());
    if (n == 0) line.low = line.high = m.y();
    line.low = std::min(line.low, m.y());
    line.high = std::max(line.high, m.y());
    n += 1, sv += m.y(), su += m.x(), svv += m.y() * m.y(), suv += m.y() * m.x();
  }
  line.middle = sv / n;
  line.at = su / n;
  const double spread = svv - sv * sv / n;
  line.slope = spread > 1 ? (suv - sv * su / n) / spread : 0;
  line.rows = track.rows;
  return line;
}

double WeightedMiddle(std::vector<TrackLine> lines) {
  std::sort(lines.begin(), lines.end(), [](const TrackLine& a, const TrackLine& b) {
    return a.middle < b.middle;
  });
  double all = 0, so_far = 0;
  for (const TrackLine& line : lines) all += line.rows;
  for (const TrackLine& line : lines) {
    so_far += line.rows;
    if (2 * so_far >= all) return line.middle;
  }
  return 0;
}

/// Steps from a pair of neighbours outwards.
class Walk {
 public:
  Walk(const std::vector<CandidateLine>& lines, int longest_gap)
      : lines_(lines), longest_gap_(longest_gap) {}

  Numbering From(std::size_t seed) const {
    Numbering found;
    found.numbers.resize(lines_.size());
    found.numbers[seed] = 0;
    found.numbers[seed + 1] = 1;
    const double pitch = lines_[seed + 1].place - lines_[seed].place;
    Go(seed + 1, 1, pitch, &found);
    Go(seed, -1, pitch, &found);
    Score(&found);
    return found;
  }

 private:
  /// From line `from` in the direction `way` as far as rulings follow.
  void Go(std::size_t from, int way, double pitch, Numbering* found) const {
    int number = *found->numbers[from], missed = 0;
    double last = lines_[from].place;
    auto next = static_cast<std::ptrdiff_t>(from) + way;
    const auto end = static_cast<std::ptrdiff_t>(lines_.size());
    while (next >= 0 && next < end && missed <= longest_gap_) {
      const double expected = last + way * pitch * (missed + 1);
      // Not beyond what is expected by more than it may be off; of those near it the nearest.
      std::ptrdiff_t best = -1;
      for (; next >= 0 && next < end; next += way) {
        const double off = (lines_[static_cast<std::size_t>(next)].place - expected) * way;
        const double reach = kOnPlace * pitch * (1 + 0.5 * missed);
        if (off > reach) break;
        if (off < -reach) continue;
        const auto Off = [&](std::ptrdiff_t k) {
          return std::abs(lines_[static_cast<std::size_t>(k)].place - expected) -
                 0.1 * pitch * lines_[static_cast<std::size_t>(k)].weight;
        };
        if (best < 0 || Off(next) < Off(best)) best = next;
      }
      ++number;
      if (best < 0) {
        ++missed;
        continue;
      }
      const double place = lines_[static_cast<std::size_t>(best)].place;
      pitch += kFollow * (std::abs(place - last) / (missed + 1) - pitch);
      last = place;
      missed = 0;
      found->numbers[static_cast<std::size_t>(best)] =
          *found->numbers[from] + way * (number - *found->numbers[from]);
      next = best + way;
    }
  }

  void Score(Numbering* found) const {
    double fits = 0, others = 0;
    int low = 0, high = 0;
    std::vector<double> pitches;
    const CandidateLine* before = nullptr;
    int before_number = 0;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (!found->numbers[k]) {
        others += lines_[k].weight;
        continue;
      }
      fits += lines_[k].weight;
      ++found->found;
      if (before != nullptr) {
        pitches.push_back((lines_[k].place - before->place) / (*found->numbers[k] - before_number));
      }
      before = &lines_[k];
      before_number = *found->numbers[k];
      low = std::min(low, before_number);
      high = std::max(high, before_number);
    }
    found->pitch = Median(pitches);
    found->score = fits - others - kMissing * (high - low + 1 - found->found);
  }

  const std::vector<CandidateLine>& lines_;
  int longest_gap_;
};

/// Whether two numberings count alike, but for where they begin.
bool CountAlike(const Numbering& a, const Numbering& b) {
  std::optional<int> shift;
  for (std::size_t k = 0; k < a.numbers.size(); ++k) {
    if (!a.numbers[k] || !b.numbers[k]) continue;
    if (!shift) shift = *b.numbers[k] - *a.numbers[k];
    if (*b.numbers[k] - *a.numbers[k] != *shift) return false;
  }
  return shift.has_value();
}

}  // namespace

std::vector<CandidateLine> CandidateLines(const std::vector<Track>& tracks,
                                          const Lens& lens,
                                          bool along_columns) {
  std::vector<int> lengths;
  for (const Track& track : tracks) lengths.push_back(track.rows);
  std::sort(lengths.rbegin(), lengths.rend());
  if (lengths.empty()) return {};
  // The usual length is that of the longer ones: rulings that nothing covers.
  const double usual = lengths[lengths.size() / 4];
  std::vector<TrackLine> lines;
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    if (tracks[k].rows < kLong * usual) continue;
    lines.push_back(LineOf(tracks[k], lens, along_columns));
    lines.back().track = static_cast<int>(k);
  }
  const double reference = WeightedMiddle(lines);
  std::sort(lines.begin(), lines.end(), [&](const TrackLine& a, const TrackLine& b) {
    return a.Place(reference) < b.Place(reference);
  });
  std::vector<CandidateLine> candidates;
  std::vector<TrackLine> last;  // track of the last candidate
  for (const TrackLine& line : lines) {
    const double weight = std::min(1.0, line.rows / usual);
    const double place = line.Place(reference);
    const bool same = !candidates.empty() && place - candidates.back().place < 3 &&
                      (line.low > last.back().high || line.high < last.back().low);
    if (same) {
      CandidateLine& one = candidates.back();
      one.place = (one.place * one.weight + place * weight) / (one.weight + weight);
      one.weight = std::min(1.0, one.weight + weight);
      one.tracks.push_back(line.track);
    } else {
      candidates.push_back({place, weight, {line.track}});
    }
    last = {line};
  }
  return candidates;
}

std::vector<Numbering> NumberLines(const std::vector<CandidateLine>& lines, int longest_gap) {
  const Walk walk(lines, longest_gap);
  std::vector<Numbering> all;
  for (std::size_t seed = 0; seed + 1 < lines.size(); ++seed) {
    if (lines[seed + 1].place - lines[seed].place < kFinestPitch) continue;
    Numbering found = walk.From(seed);
    if (found.found >= 3) all.push_back(std::move(found));
  }
  std::stable_sort(all.begin(), all.end(), [](const Numbering& a, const Numbering& b) {
    return a.score > b.score;
  });
  std::vector<Numbering> rivals;
  for (Numbering& one : all) {
    if (one.score < kRival * all.front().score || rivals.size() == kMostRivals) break;
    const auto alike = [&](const Numbering& rival) { return CountAlike(rival, one); };
    if (std::none_of(rivals.begin(), rivals.end(), alike)) rivals.push_back(std::move(one));
  }
  return rivals;
}

}  // namespace dhcal
