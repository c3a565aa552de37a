// The row of rulings as one thing: lines of a plane, seen by a camera.
//
// Rulings are the lines x = 0, 1, 2 ... of a plane (x in pitches, along the ruler). A homography of
// the plane makes of them the lines of a pencil, so that the whole row has five numbers p:
//   x(m) = (p0 + p1 s + p2 t) / (1 + p3 s + p4 t)       (s, t) = (U(m) - c) / scale
// with U(m) the point m after the lens is undone and c its centre. Along any line of the image this
// is a homography of the ruling's number: cross-ratios hold exactly. The reading is x at c: p0.
//
// A piece of a ruling shows x halfway between its flanks, (x(first) + x(second)) / 2: exact for any
// perspective, and without the width of the line.
#ifndef DHCAL_TOOLS_CAMERA_PENCIL_H_
#define DHCAL_TOOLS_CAMERA_PENCIL_H_

#include <vector>

#include <Eigen/Core>

#include "tools/camera/lens.h"
#include "tools/camera/tracks.h"

namespace dhcal {

constexpr int kPencilNumbers = 5;
/// Scatter of the lines that is taken for none [px]: loss functions need one.
constexpr double kFinestScatter = 0.01;
using PencilNumbers = Eigen::Matrix<double, kPencilNumbers, 1>;

/// x at a point `from_centre` = U(m) - c [px].
template <typename T>
T PencilPlace(const T* p, const Eigen::Matrix<T, 2, 1>& from_centre, double scale) {
  const T s = from_centre.x() / scale, t = from_centre.y() / scale;
  return (p[0] + p[1] * s + p[2] * t) / (1.0 + p[3] * s + p[4] * t);
}

/// A piece and the number of the ruling that it belongs to.
struct NumberedPiece {
  RulingPiece piece;
  int ruling = 0;
  double per_px = 0;  // pitches per px along the ruler where it is; set by the fit
};

/// x of a piece minus the number of its ruling [pitches].
template <typename T>
T PieceError(const T* p, const T* lens_numbers, double scale, const NumberedPiece& at) {
  const T first = PencilPlace(p, FromCentre(at.piece.first, lens_numbers, scale), scale);
  const T second = PencilPlace(p, FromCentre(at.piece.second, lens_numbers, scale), scale);
  return 0.5 * (first + second) - static_cast<double>(at.ruling);
}

struct Pencil {
  PencilNumbers p = PencilNumbers::Zero();

  /// x at a point of the image.
  double At(const Eigen::Vector2d& m, const Lens& lens) const;
  /// Gradient of x there [pitches / px], and its length.
  Eigen::Vector2d Gradient(const Eigen::Vector2d& m, const Lens& lens) const;
  double PerPixel(const Eigen::Vector2d& m, const Lens& lens) const;
  /// x of a piece.
  double At(const RulingPiece& piece, const Lens& lens) const;
  /// Whether x has no pole in the image, as that of a plane before the camera.
  bool IsRegular(const Lens& lens) const;
};

/// Least squares of the linear form of x(m) = number; a start for FitPencil.
Pencil LinearPencil(const std::vector<NumberedPiece>& pieces, const Lens& lens);

/// Ceres, from `start`, with errors in px under Tukey's loss at 4.7 times `scatter`. Sets `per_px`
/// of the pieces. False where it fails.
bool FitPencil(const Lens& lens,
               double scatter,
               std::vector<NumberedPiece>* pieces,
               Pencil* pencil);

void SetPerPixel(const Pencil& pencil, const Lens& lens, std::vector<NumberedPiece>* pieces);

/// Errors of the pieces [px], whose `per_px` are set.
std::vector<double> PencilErrors(const Pencil& pencil,
                                 const Lens& lens,
                                 const std::vector<NumberedPiece>& pieces);

/// Standard deviation of x at the point of the image that is the lens' centre [pitches]: rulings
/// err independently, the pieces of one alike (sandwich by rulings), and what the lens' covariance
/// adds. That the true centre may be another point is no part of it: all readings are about this
/// one.
double ReadingSigma(const Pencil& pencil,
                    const Lens& lens,
                    const std::vector<NumberedPiece>& pieces);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_PENCIL_H_
