#include "problems/diagnosis/hypotheses/loads.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/physics/gravity.h"

namespace dhcal {
namespace {

constexpr double kLeastGuess = 0.02;  // of the largest load
constexpr char kFriction[] = "friction_Nm";
constexpr int kDirections = 12;
constexpr double kDegreesAround[] = {-7.5, -5, -2.5, 2.5, 5, 7.5};
constexpr double kFrictionsTried[] = {0, 0.1, 0.3, 0.6};  // of the largest torque

double GuessedLoad(const PhysicsContext& c, int joint) {
  if (!GravityLoads(c, joint)) return 0;
  const Eigen::VectorXd torque = GravityTorque(c, MassCases(c, joint).front(), joint);
  return std::sqrt(torque.squaredNorm() / static_cast<double>(torque.size()));
}

struct Moment {
  int link = 0;
  double degrees = 0;
};

std::vector<Moment> MomentsTried(const PhysicsContext& c,
                                 const std::vector<EffectRequest>& near,
                                 const EffectRequest& loaded) {
  std::vector<Moment> moments;
  for (int link = loaded.joint; link <= std::min(loaded.joint + 1, c.num_joints()); ++link) {
    for (int k = 0; k < kDirections; ++k) moments.push_back({link, 180.0 * k / kDirections});
  }
  for (const EffectRequest& member : near) {
    const auto link = static_cast<int>(member.setting(kMomentLink, 0));
    if (member.effect != loaded.effect || member.joint != loaded.joint || link == 0) continue;
    const double found = member.setting(kMomentDegrees, 0);
    for (const double step : kDegreesAround) moments.push_back({link, found + step});
  }
  return moments;
}

}  // namespace

GuessedLoads::GuessedLoads(const PhysicsContext& context) {
  for (int joint = 0; joint < context.num_joints(); ++joint) {
    load_.push_back(GuessedLoad(context, joint));
    least_ = std::max(least_, kLeastGuess * load_.back());
  }
}

std::vector<EffectRequest> WithMoments(const PhysicsContext& context,
                                       const GuessedLoads& guessed,
                                       const std::vector<EffectRequest>& near,
                                       const std::vector<EffectRequest>& requests) {
  std::vector<EffectRequest> forms;
  for (const EffectRequest& loaded : requests) {
    if (loaded.setting("flank", 0) == 0 || loaded.settings.count(kFriction) > 0) continue;
    if (guessed.tells(loaded.joint)) continue;
    for (const Moment& moment : MomentsTried(context, near, loaded)) {
      for (const double friction : kFrictionsTried) {
        EffectRequest form = loaded;
        form.settings[kMomentLink] = moment.link;
        form.settings[kMomentDegrees] = moment.degrees;
        // The largest torque of 1 kg m.
        if (friction > 0) form.settings[kFriction] = friction * context.robot().gravity_B.norm();
        forms.push_back(std::move(form));
      }
    }
  }
  return forms;
}

}  // namespace dhcal
