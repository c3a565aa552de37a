#include "tools/camera/pencil.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <ceres/ceres.h>

namespace dhcal {
namespace {

using Jet = ceres::Jet<double, kPencilNumbers + kLensNumbers>;

/// Error of a piece in px by the pencil alone, the lens as it is.
struct PieceCost {
  const NumberedPiece* at;
  const Lens* lens;

  template <typename T>
  bool operator()(const T* p, T* residual) const {
    T numbers[kLensNumbers];
    for (int k = 0; k < kLensNumbers; ++k) numbers[k] = T(lens->numbers[k]);
    *residual = PieceError(p, numbers, lens->scale, *at) / at->per_px;
    return true;
  }
};

/// The numbers of pencil and lens, to be differentiated by.
struct JetNumbers {
  Jet p[kPencilNumbers], lens[kLensNumbers];

  JetNumbers(const Pencil& pencil, const Lens& of) {
    for (int k = 0; k < kPencilNumbers; ++k) p[k] = Jet(pencil.p[k], k);
    for (int k = 0; k < kLensNumbers; ++k) lens[k] = Jet(of.numbers[k], kPencilNumbers + k);
  }
};

/// Error of a piece [px] and its derivatives by pencil and lens.
Jet ErrorOf(const Pencil& pencil, const Lens& lens, const NumberedPiece& at) {
  const JetNumbers by(pencil, lens);
  return PieceError(by.p, by.lens, lens.scale, at) / at.per_px;
}

Eigen::Vector2d Middle(const RulingPiece& piece) { return 0.5 * (piece.first + piece.second); }

}  // namespace

double Pencil::At(const Eigen::Vector2d& m, const Lens& lens) const {
  return PencilPlace<double>(p.data(), FromCentre(m, lens.numbers.data(), lens.scale), lens.scale);
}

double Pencil::At(const RulingPiece& piece, const Lens& lens) const {
  return 0.5 * (At(piece.first, lens) + At(piece.second, lens));
}

Eigen::Vector2d Pencil::Gradient(const Eigen::Vector2d& m, const Lens& lens) const {
  constexpr double kStep = 0.5;  // [px]
  const Eigen::Vector2d du(kStep, 0), dv(0, kStep);
  return Eigen::Vector2d(At(m + du, lens) - At(m - du, lens), At(m + dv, lens) - At(m - dv, lens)) /
         (2 * kStep);
}

double Pencil::PerPixel(const Eigen::Vector2d& m, const Lens& lens) const {
  return Gradient(m, lens).norm();
}

bool Pencil::IsRegular(const Lens& lens) const {
  if (!p.allFinite()) return false;
  for (const double u : {0.0, lens.width - 1.0}) {
    for (const double v : {0.0, lens.height - 1.0}) {
      const Eigen::Vector2d x = FromCentre({u, v}, lens.numbers.data(), lens.scale) / lens.scale;
      if (1 + p[3] * x.x() + p[4] * x.y() < 0.1) return false;
    }
  }
  return true;
}

Pencil LinearPencil(const std::vector<NumberedPiece>& pieces, const Lens& lens) {
  const auto rows = static_cast<Eigen::Index>(pieces.size());
  Eigen::MatrixXd A(rows, kPencilNumbers);
  Eigen::VectorXd b(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const NumberedPiece& at = pieces[static_cast<std::size_t>(row)];
    const Eigen::Vector2d x =
        FromCentre(Middle(at.piece), lens.numbers.data(), lens.scale) / lens.scale;
    A.row(row) << 1, x.x(), x.y(), -at.ruling * x.x(), -at.ruling * x.y();
    b[row] = at.ruling;
  }
  Pencil pencil;
  pencil.p = A.colPivHouseholderQr().solve(b);
  return pencil;
}

bool FitPencil(const Lens& lens,
               double scatter,
               std::vector<NumberedPiece>* pieces,
               Pencil* pencil) {
  ceres::Problem problem;
  SetPerPixel(*pencil, lens, pieces);
  for (const NumberedPiece& at : *pieces) {
    if (!(at.per_px > 0)) return false;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PieceCost, 1, kPencilNumbers>(new PieceCost{&at, &lens}),
        new ceres::TukeyLoss(4.7 * scatter),
        pencil->p.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 30;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable() && pencil->IsRegular(lens);
}

void SetPerPixel(const Pencil& pencil, const Lens& lens, std::vector<NumberedPiece>* pieces) {
  for (NumberedPiece& at : *pieces) at.per_px = pencil.PerPixel(Middle(at.piece), lens);
}

std::vector<double> PencilErrors(const Pencil& pencil,
                                 const Lens& lens,
                                 const std::vector<NumberedPiece>& pieces) {
  std::vector<double> errors;
  for (const NumberedPiece& at : pieces) {
    errors.push_back((pencil.At(at.piece, lens) - at.ruling) / at.per_px);
  }
  return errors;
}

double ReadingSigma(const Pencil& pencil,
                    const Lens& lens,
                    const std::vector<NumberedPiece>& pieces) {
  using Matrix5 = Eigen::Matrix<double, kPencilNumbers, kPencilNumbers>;
  Matrix5 H = Matrix5::Zero();
  Eigen::Matrix<double, kPencilNumbers, kLensNumbers> by_lens;
  by_lens.setZero();
  std::map<int, PencilNumbers> pulls;  // of each ruling
  double squares = 0;
  for (const NumberedPiece& at : pieces) {
    const Jet error = ErrorOf(pencil, lens, at);
    const PencilNumbers J = error.v.head<kPencilNumbers>();
    H += J * J.transpose();
    by_lens += J * error.v.tail<kLensNumbers>().transpose();
    const auto pull = pulls.try_emplace(at.ruling, PencilNumbers::Zero()).first;
    pull->second += J * error.a;
    squares += error.a * error.a;
  }
  const Eigen::LDLT<Matrix5> inverse(H);
  const PencilNumbers first = inverse.solve(PencilNumbers::Unit(0));
  double together = 0;
  for (const auto& [ruling, pull] : pulls) together += std::pow(first.dot(pull), 2);
  const auto rulings = static_cast<double>(pulls.size());
  const auto count = static_cast<double>(pieces.size());
  together *= rulings / std::max(1.0, rulings - 3);
  const double apart = first[0] * squares / std::max(1.0, count - kPencilNumbers);
  // What the lens' numbers do to x at a point of the image that stays: by the fit and by
  // themselves.
  const JetNumbers by(pencil, lens);
  const Jet at_point =
      PencilPlace(by.p, FromCentre(lens.centre(), by.lens, lens.scale), lens.scale);
  const LensNumbers moved =
      at_point.v.tail<kLensNumbers>() - (first.transpose() * by_lens).transpose();
  return std::sqrt(std::max(together, apart) + moved.dot(lens.covariance * moved));
}

}  // namespace dhcal
