#include "tools/camera/straighten.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "core/math/statistics.h"

namespace dhcal {
namespace {

using LensJet = ceres::Jet<double, kPencilNumbers + kLensNumbers>;

struct StraightenCost {
  const NumberedPiece* at;
  double scale;

  template <typename T>
  bool operator()(const T* p, const T* lens, T* residual) const {
    *residual = PieceError(p, lens, scale, *at) / at->per_px;
    return true;
  }
};

struct Row {
  std::vector<NumberedPiece> pieces;
  Pencil pencil;
};

std::vector<double> AllErrors(const std::vector<Row>& rows, const Lens& lens) {
  std::vector<double> errors;
  for (const Row& row : rows) {
    const std::vector<double> more = PencilErrors(row.pencil, lens, row.pieces);
    errors.insert(errors.end(), more.begin(), more.end());
  }
  return errors;
}

/// The centre of a lens that bends nothing cannot be seen; it is looked for near the image's [px].
double CentrePrior(const Lens& lens) { return 0.04 * lens.scale; }
Eigen::Vector2d PriorCentre(const Lens& lens) {
  return PlainLens(lens.width, lens.height).centre();
}

struct CentreCost {
  Eigen::Vector2d centre;
  double weight;

  template <typename T>
  bool operator()(const T* lens, T* residual) const {
    for (int k = 0; k < 2; ++k) residual[k] = (lens[k] - centre[k]) * weight;
    return true;
  }
};

/// Errors count in px, and scatter by `scatter`.
bool FitAll(double scatter, bool lens_free, std::vector<Row>* rows, Lens* lens) {
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<CentreCost, 2, kLensNumbers>(
                               new CentreCost{PriorCentre(*lens), scatter / CentrePrior(*lens)}),
                           nullptr,
                           lens->numbers.data());
  const auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (Row& row : *rows) {
    for (NumberedPiece& at : row.pieces) {
      at.per_px = row.pencil.PerPixel(0.5 * (at.piece.first + at.piece.second), *lens);
      if (!(at.per_px > 0)) return false;
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<StraightenCost, 1, kPencilNumbers, kLensNumbers>(
              new StraightenCost{&at, lens->scale}),
          new ceres::TukeyLoss(4.7 * scatter),
          row.pencil.p.data(),
          lens->numbers.data());
    }
    ordering->AddElementToGroup(row.pencil.p.data(), 0);
  }
  ordering->AddElementToGroup(lens->numbers.data(), 1);
  if (!lens_free) problem.SetParameterBlockConstant(lens->numbers.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering = ordering;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-10;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable() && lens->numbers.allFinite();
}

/// Covariance of the lens: each image's pencil is eliminated, pieces of one ruling pull together.
LensCovariance CovarianceOf(const std::vector<Row>& rows, const Lens& lens, double scatter) {
  using Matrix5 = Eigen::Matrix<double, kPencilNumbers, kPencilNumbers>;
  LensCovariance H = LensCovariance::Zero();
  H.topLeftCorner<2, 2>().diagonal().setConstant(std::pow(scatter / CentrePrior(lens), 2));
  LensCovariance pulls = scatter * scatter * H;
  for (const Row& row : rows) {
    Matrix5 P = Matrix5::Zero();
    Eigen::Matrix<double, kPencilNumbers, kLensNumbers> C;
    C.setZero();
    std::vector<std::pair<int, LensJet>> errors;
    for (const NumberedPiece& at : row.pieces) {
      LensJet p[kPencilNumbers], numbers[kLensNumbers];
      for (int k = 0; k < kPencilNumbers; ++k) p[k] = LensJet(row.pencil.p[k], k);
      for (int k = 0; k < kLensNumbers; ++k) {
        numbers[k] = LensJet(lens.numbers[k], kPencilNumbers + k);
      }
      const LensJet error = PieceError(p, numbers, lens.scale, at) / at.per_px;
      if (std::abs(error.a) > 4.7 * scatter) continue;
      const PencilNumbers J = error.v.head<kPencilNumbers>();
      const LensNumbers L = error.v.tail<kLensNumbers>();
      P += J * J.transpose();
      C += J * L.transpose();
      H += L * L.transpose();
      errors.emplace_back(at.ruling, error);
    }
    const Eigen::Matrix<double, kPencilNumbers, kLensNumbers> PC = P.ldlt().solve(C);
    H -= C.transpose() * PC;
    std::map<int, LensNumbers> of_ruling;
    for (const auto& [ruling, error] : errors) {
      const LensNumbers own =
          error.v.tail<kLensNumbers>() - PC.transpose() * error.v.head<kPencilNumbers>();
      of_ruling.try_emplace(ruling, LensNumbers::Zero()).first->second += own * error.a;
    }
    for (const auto& [ruling, pull] : of_ruling) pulls += pull * pull.transpose();
  }
  const LensCovariance inverse = H.ldlt().solve(LensCovariance::Identity());
  return inverse * pulls * inverse;
}

}  // namespace

StraightenedLens Straighten(const Lens& start, std::vector<std::vector<NumberedPiece>> rows) {
  StraightenedLens result;
  result.lens = start;
  std::vector<Row> usable;
  for (std::vector<NumberedPiece>& pieces : rows) {
    Row row{std::move(pieces), {}};
    if (row.pieces.size() < 2 * kPencilNumbers) continue;
    row.pencil = LinearPencil(row.pieces, start);
    if (row.pencil.IsRegular(start)) usable.push_back(std::move(row));
  }
  result.images = static_cast<int>(usable.size());
  if (usable.empty()) {
    result.failure = "no image shows a row of rulings";
    return result;
  }
  constexpr double kAny = 100;  // scatter [px]
  bool fits = FitAll(kAny, false, &usable, &result.lens);
  result.rms_before = fits ? RobustScale(AllErrors(usable, start)) : 0;
  double scatter = kAny;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds && fits; ++round) {
    fits = FitAll(scatter, true, &usable, &result.lens);
    scatter = std::max(kFinestScatter, RobustScale(AllErrors(usable, result.lens)));
  }
  if (!fits) {
    result.failure = "no lens straightens the rulings";
    return result;
  }
  result.rms_after = scatter;
  result.lens.covariance = CovarianceOf(usable, result.lens, scatter);
  if (!KeepsOrder(result.lens))
    result.failure =
        "the lens that straightens the rulings best folds "
        "the image; take more images, with rulings all "
        "over them";
  return result;
}

}  // namespace dhcal
