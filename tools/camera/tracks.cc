#include "tools/camera/tracks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/math/statistics.h"
#include "tools/camera/flanks.h"

namespace dhcal {
namespace {

constexpr std::size_t kFewestRows = 12;  // of a track
constexpr std::size_t kPieceRows = 16;
constexpr int kGap = 6;         // rows that a track may miss, of those looked at
constexpr double kReach = 1.0;  // from where a track is expected [px], and for each row
constexpr double kReachPerRow = 0.25;
constexpr int kEnds = 7;                             // px of a track's ends that are left out
constexpr double kFaintest = 0.8, kStrongest = 1.3;  // of the usual height of its flanks
constexpr double kRoughest = 0.8;  // scatter of a piece [px] beyond which it is no line
// Smoothing across rows makes neighbours alike: so many times the variance of independent ones.
constexpr double kAlike = 3.5;

struct Seen {
  int row = 0;
  FlankPair pair;
};

struct OpenTrack {
  std::vector<Seen> seen;
  double slope = 0;
  int last = 0;  // index of the row that it was last seen in

  double Expected(int row) const {
    return seen.back().pair.middle() + slope * (row - seen.back().row);
  }
};

/// Straight line through values of rows.
struct RowLine {
  double at = 0, slope = 0;  // at the middle row
  double rms = 0;

  RowLine(const Seen* seen, std::size_t count, double middle, const std::vector<char>& used) {
    double n = 0, sv = 0, su = 0, svv = 0, suv = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (used[k] == 0) continue;
      const double v = seen[k].row - middle, u = seen[k].pair.middle();
      n += 1, sv += v, su += u, svv += v * v, suv += u * v;
    }
    const double det = n * svv - sv * sv;
    slope = det > 0 ? (n * suv - sv * su) / det : 0;
    at = n > 0 ? (su - slope * sv) / n : 0;
    double squares = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (used[k] != 0) squares += std::pow(Residual(seen[k], middle), 2);
    }
    rms = std::sqrt(squares / std::max(1.0, n - 2));
  }
  double Residual(const Seen& one, double middle) const {
    return one.pair.middle() - at - slope * (one.row - middle);
  }
};

/// One piece of a track, in the frame where rows run along the ruler; false where it is no line.
bool MakePiece(const Seen* seen, std::size_t count, RulingPiece* piece) {
  const double middle = 0.5 * (seen[0].row + seen[count - 1].row);
  std::vector<char> used(count, 1);
  RowLine line(seen, count, middle, used);
  std::vector<double> residuals, widths;
  for (std::size_t k = 0; k < count; ++k) {
    residuals.push_back(line.Residual(seen[k], middle));
    widths.push_back(seen[k].pair.second - seen[k].pair.first);
  }
  const double limit = 3 * RobustScale(residuals) + 0.05;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    used[k] = std::abs(residuals[k]) <= limit ? 1 : 0;
    kept += static_cast<std::size_t>(used[k]);
  }
  if (kept < 6) return false;
  line = RowLine(seen, count, middle, used);
  if (line.rms > kRoughest) return false;
  const double half = 0.5 * Median(widths);
  piece->first = {line.at - half, middle};
  piece->second = {line.at + half, middle};
  piece->sigma = line.rms * std::sqrt(kAlike / static_cast<double>(kept));
  return true;
}

/// Without the ends, whose corners blur rounds off (aslant lines by more on one flank), and without
/// what is fainter or stronger than the rest.
std::vector<Seen> Clean(const std::vector<Seen>& all) {
  std::vector<double> heights;
  for (const Seen& one : all) heights.push_back(one.pair.height);
  const double usual = Median(heights);
  std::vector<Seen> clean;
  for (const Seen& one : all) {
    const int from_end = std::min(one.row - all.front().row, all.back().row - one.row);
    const double height = one.pair.height / usual;
    if (from_end >= kEnds && height > kFaintest && height < kStrongest) clean.push_back(one);
  }
  return clean;
}

Track Finished(const OpenTrack& open, int track_idx, bool along_columns) {
  Track track;
  track.rows = static_cast<int>(open.seen.size());
  const std::vector<Seen> seen = Clean(open.seen);
  if (seen.empty()) return track;
  const std::size_t pieces = std::max<std::size_t>(1, seen.size() / kPieceRows);
  for (std::size_t k = 0; k < pieces; ++k) {
    const std::size_t begin = k * seen.size() / pieces;
    const std::size_t end = (k + 1) * seen.size() / pieces;
    RulingPiece piece;
    if (!MakePiece(seen.data() + begin, end - begin, &piece)) continue;
    piece.track_idx = track_idx;
    if (along_columns) {
      std::swap(piece.first.x(), piece.first.y());
      std::swap(piece.second.x(), piece.second.y());
    }
    track.pieces.push_back(piece);
  }
  return track;
}

/// Joins what follows each other from row to row.
class Linker {
 public:
  explicit Linker(double slope) : slope_(slope) {}

  void Add(const FlankRow& flanks, int number) {
    Close(number);
    std::vector<char> taken(open_.size(), 0);
    const std::size_t before = open_.size();
    for (const FlankPair& pair : flanks.pairs) {
      std::size_t nearest = before;
      double distance = 0;
      for (std::size_t k = 0; k < before; ++k) {
        const double off = std::abs(open_[k].Expected(flanks.row) - pair.middle());
        if (taken[k] == 0 && off < Reach(open_[k], flanks.row) &&
            (nearest == before || off < distance)) {
          nearest = k;
          distance = off;
        }
      }
      if (nearest == before) {
        open_.push_back({{{flanks.row, pair}}, slope_, number});
        continue;
      }
      taken[nearest] = 1;
      Extend(&open_[nearest], {flanks.row, pair}, number);
    }
  }
  std::vector<OpenTrack> Take() {
    Close(-1);
    return std::move(closed_);
  }

 private:
  static double Reach(const OpenTrack& track, int row) {
    return kReach + kReachPerRow * (row - track.seen.back().row);
  }
  static void Extend(OpenTrack* track, const Seen& seen, int number) {
    // The slope over the last dozen rows, slowly taking over from that of all lines.
    track->seen.push_back(seen);
    track->last = number;
    const std::size_t count = track->seen.size();
    if (count < kFewestRows) return;
    const Seen& earlier = track->seen[count - kFewestRows];
    const double slope =
        (seen.pair.middle() - earlier.pair.middle()) / std::max(1, seen.row - earlier.row);
    track->slope += 0.2 * (slope - track->slope);
  }
  /// Ends tracks that have not been seen lately; all for `number` -1.
  void Close(int number) {
    const auto goes_on = [&](const OpenTrack& track) {
      return number >= 0 && number - track.last <= kGap;
    };
    const auto ended = std::stable_partition(open_.begin(), open_.end(), goes_on);
    for (auto track = ended; track != open_.end(); ++track) {
      if (track->seen.size() >= kFewestRows) closed_.push_back(std::move(*track));
    }
    open_.erase(ended, open_.end());
  }

  double slope_;
  std::vector<OpenTrack> open_, closed_;
};

}  // namespace

std::vector<Track> FindTracks(const cv::Mat& gray, const TrackOptions& options) {
  const FlankRows flanks =
      FindFlanks(options.along_columns ? cv::Mat(gray.t()) : gray, options.dark);
  Linker linker(flanks.slope);
  int number = 0;
  for (const FlankRow& row : flanks.rows) linker.Add(row, number++);
  std::vector<Track> tracks;
  for (const OpenTrack& open : linker.Take()) {
    Track track = Finished(open, static_cast<int>(tracks.size()), options.along_columns);
    if (!track.pieces.empty()) tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace dhcal
