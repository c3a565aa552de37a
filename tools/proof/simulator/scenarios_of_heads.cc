// A measuring head over straight edges, 12 placements of 20 poses.
#include <cmath>

#include "core/base/units.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/scenarios.h"

namespace dhcal::concealed {
namespace {

/// [m] of an edge that the arm can follow.
double EdgeLength(const Trial& trial) {
  return trial.drawing.name == "kr15" ? 0.5 : trial.drawing.name == "ur10" ? 0.4 : 0.2;
}

void CleanHead(Trial* trial, Rng* rng) {
  constexpr int kPlacements = 12, kPosesOfEach = 20, kTestsOfEach = 4;
  trial->head.emplace();
  trial->head->length = EdgeLength(*trial);
  trial->motion =
      AlongEdges(trial->drawing, {kPlacements, kPosesOfEach, kTestsOfEach}, &*trial->head, rng);
  trial->sensor.noise = trial->head->camera_noise;
}

void RulerScaleWrong(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->ruler_scale = 50e-6;
  trial->scale_is_wrong = true;
}

void EdgeBowed(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  // 0.1 mm between the ends.
  trial->causes = {EdgeIsBowed(8e-4 / std::pow(trial->head->length, 2))};
}

void EdgeFacesApart(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->causes = {RuledFaceClimbs(0.25e-3 / trial->head->length)};
}

void RulingsHigher(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->causes = {RuledFaceHigher(0.5e-3)};
}

void CameraPixels(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->causes = {PixelsWrong(0.02)};
}

void LaserSlants(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  const double angle = rng->Uniform(-kPi, kPi);
  trial->causes = {BeamSlants(2, 2e-3 * Eigen::Vector2d(std::cos(angle), std::sin(angle)))};
}

void LaserNotLinear(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->causes = {LaserBends(1, 0.08, 1.6)};
}

void Joint2YieldsUnderHead(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->causes = {Yields(2, 2 * trial->drawing.main_compliance)};
}

void BowedAndYielding(Trial* trial, Rng* rng) {
  CleanHead(trial, rng);
  trial->causes = {Yields(2, 2 * trial->drawing.main_compliance),
                   EdgeIsBowed(4e-4 / std::pow(trial->head->length, 2))};
}

}  // namespace

const std::vector<Scenario>& HeadScenarios() {
  constexpr bool kQuick = true;
  static const std::vector<Scenario> scenarios = {
      {"D16N", "head over edges, nothing left out", Group::kNull, kQuick, 1000, CleanHead},
      {"D15R", "head whose ruler is wrong by 50 ppm", Group::kNull, false, 1000, RulerScaleWrong},
      {"D16", "head over an edge bowed by 0.1 mm", Group::kSingle, kQuick, 1000, EdgeBowed},
      {"D16A",
       "head over an edge whose faces part by 0.25 mm",
       Group::kSingle,
       false,
       1000,
       EdgeFacesApart},
      {"D16B", "head; rulings 0.5 mm higher", Group::kSingle, false, 1000, RulingsHigher},
      {"D16C", "head; camera's pixels wrong by 2 %", Group::kSingle, false, 1000, CameraPixels},
      {"D16D", "head; laser 2 slants by 2 mrad", Group::kSingle, false, 1000, LaserSlants},
      {"D16E", "head; laser 1 is not linear", Group::kSingle, false, 1000, LaserNotLinear},
      {"D16F", "head; joint 2 yields", Group::kSingle, false, 1000, Joint2YieldsUnderHead},
      {"D16G",
       "head over a bowed edge; joint 2 yields",
       Group::kSeveral,
       false,
       1000,
       BowedAndYielding}};
  return scenarios;
}

}  // namespace dhcal::concealed
