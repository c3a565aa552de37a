#include "tests/support/ruler_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dhcal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Step(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Point of the plane z = 1 that Brown's model takes to `distorted`: Newton on the radius.
Vector2d WithoutBrown(const RulerScene& scene, const Vector2d& distorted) {
  const double wanted = distorted.norm();
  if (wanted < 1e-12) return distorted;
  double r = wanted;
  for (int k = 0; k < 8; ++k) {
    const double r2 = r * r;
    const double error = r * (1 + scene.k1 * r2 + scene.k2 * r2 * r2) - wanted;
    r -= error / (1 + 3 * scene.k1 * r2 + 5 * scene.k2 * r2 * r2);
    if (std::abs(error) < 1e-13) break;
  }
  return distorted * (r / wanted);
}

Vector2d OnRuler(const RulerScene& scene, const Vector2d& m) {
  const Vector2d x = WithoutBrown(scene, (m - scene.centre) / scene.focal);
  const Vector3d direction = scene.X_RC.linear() * Vector3d(x.x(), x.y(), 1);
  const Vector3d from = scene.X_RC.translation();
  return (from - direction * (from.z() / direction.z())).head<2>();
}

/// Of the ruler's face at p [mm]; a step across is blurred over `sigma` [mm] along x and y.
double Brightness(const RulerScene& scene, const Vector2d& p, const Vector2d& sigma) {
  const double body =
      Step((p.y() - scene.body_low) / sigma.y()) - Step((p.y() - scene.body_high) / sigma.y());
  if (body < 1e-6) return scene.ground;
  const double row = Step((p.y() - scene.low) / sigma.y()) - Step((p.y() - scene.high) / sigma.y());
  double ink = 0;
  const int nearest = static_cast<int>(std::lround(p.x() / scene.pitch));
  if (row > 1e-6) {
    const int reach = 1 + static_cast<int>(std::ceil(5 * sigma.x() / scene.pitch));
    for (int k = nearest - reach; k <= nearest + reach; ++k) {
      if (scene.missing.count(k) > 0) continue;
      const double off = p.x() - k * scene.pitch;
      double mark =
          Step((off + scene.line / 2) / sigma.x()) - Step((off - scene.line / 2) / sigma.x());
      // A bright scratch aslant over the ruling, that leaves parts of both flanks.
      if (std::count(scene.scratched.begin(), scene.scratched.end(), k) > 0) {
        const double across = off - 0.06 * (p.y() - 0.5 * (scene.low + scene.high));
        mark *= 1 - 0.9 * (Step((across + 0.1) / sigma.x()) - Step((across - 0.1) / sigma.x()));
      }
      ink += mark;
    }
  }
  double face = scene.paper + (scene.ink - scene.paper) * row * ink;
  for (const Speck& speck : scene.specks) {
    const Vector2d off = p - speck.at;
    const double c = std::cos(speck.angle), s = std::sin(speck.angle);
    const double a = (c * off.x() + s * off.y()) / speck.axes.x();
    const double b = (c * off.y() - s * off.x()) / speck.axes.y();
    const double radius = std::hypot(a, b);
    if (radius > 2) continue;
    const double rim = sigma.mean() / speck.axes.mean();
    face += (speck.brightness - face) * Step((1 - radius) / rim);
  }
  return scene.ground + (face - scene.ground) * body;
}

double Light(const RulerScene& scene, const Vector2d& m) {
  const double u = m.x() / scene.width - 0.5, v = m.y() / scene.height - 0.5;
  // As a photographer sets it: paper nowhere beyond full scale.
  const double brightest = 1 + 0.5 * (std::abs(scene.light_u) + std::abs(scene.light_v));
  return (1 + scene.light_u * u + scene.light_v * v - scene.light_r * (u * u + v * v)) / brightest;
}

void AddDirt(const SceneFamily& family, double x, double reach, RulerScene* scene, Rng* rng) {
  const int here = static_cast<int>(std::lround(x / scene->pitch));
  const auto near = [&] { return here + static_cast<int>(std::lround(rng->Uniform(-12, 12))); };
  for (int k = 0; k < family.lost; ++k) scene->missing.insert(near());
  for (int k = 0; k < family.scratches; ++k) scene->scratched.push_back(near());
  const int specks = static_cast<int>(rng->Uniform(0, family.specks));
  for (int k = 0; k < specks; ++k) {
    Speck speck;
    speck.at = {x + rng->Uniform(-reach, reach), rng->Uniform(scene->low, scene->high)};
    speck.axes = {rng->Uniform(0.1, 1), rng->Uniform(0.1, 1.6)};
    speck.angle = rng->Uniform(0, 3.1);
    speck.brightness = rng->Uniform(0, 1);
    scene->specks.push_back(speck);
  }
}

}  // namespace

double RulerXAt(const RulerScene& scene, const Vector2d& m) { return OnRuler(scene, m).x(); }

double TrueReading(const RulerScene& scene) { return RulerXAt(scene, scene.centre); }

Vector2d ImageOf(const RulerScene& scene, const Vector2d& p_R) {
  const Vector3d p_C = scene.X_RC.inverse() * Vector3d(p_R.x(), p_R.y(), 0);
  const Vector2d x = p_C.head<2>() / p_C.z();
  const double r2 = x.squaredNorm();
  return scene.centre + scene.focal * (1 + scene.k1 * r2 + scene.k2 * r2 * r2) * x;
}

Vector2d WithoutDistortion(const RulerScene& scene, const Vector2d& m) {
  return scene.centre + scene.focal * WithoutBrown(scene, (m - scene.centre) / scene.focal);
}

std::vector<float> Render(const RulerScene& scene, int samples) {
  std::vector<float> image;
  image.reserve(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  Rng rng(scene.seed);
  // What of the pixel's square the rays do not sample themselves.
  const double sigma = std::sqrt(scene.blur * scene.blur + 1.0 / (12.0 * samples * samples));
  for (int v = 0; v < scene.height; ++v) {
    for (int u = 0; u < scene.width; ++u) {
      double sum = 0;
      for (int k = 0; k < samples * samples; ++k) {
        const Vector2d m(u + (k % samples + 0.5) / samples - 0.5,
                         v + (k / samples + 0.5) / samples - 0.5);
        const Vector2d p = OnRuler(scene, m);
        if (p.y() < scene.body_low - 1 || p.y() > scene.body_high + 1) {  // far off the ruler [mm]
          sum += scene.ground;
          continue;
        }
        const Vector2d by_u = OnRuler(scene, m + Vector2d(0.01, 0)) - p;
        const Vector2d by_v = OnRuler(scene, m + Vector2d(0, 0.01)) - p;
        const Vector2d blur = sigma * 100 * (by_u.cwiseAbs2() + by_v.cwiseAbs2()).cwiseSqrt();
        sum += Brightness(scene, p, blur);
      }
      const double light = Light(scene, {static_cast<double>(u), static_cast<double>(v)});
      image.push_back(
          static_cast<float>(sum / (samples * samples) * light + scene.noise * rng.Normal()));
    }
  }
  return image;
}

Eigen::Isometry3d CameraOver(double x, double y, double stand_off, const Vector3d& tilt) {
  Eigen::Isometry3d X_RC = Eigen::Isometry3d::Identity();
  // Looking down: x stays, y and z turn over.
  const Eigen::Matrix3d down = Vector3d(1, -1, -1).asDiagonal();
  X_RC.linear() = down * (Eigen::AngleAxisd(tilt.z(), Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(tilt.y(), Vector3d::UnitY()) *
                          Eigen::AngleAxisd(tilt.x(), Vector3d::UnitX()))
                             .toRotationMatrix();
  const Vector3d sight = X_RC.linear().col(2);
  X_RC.translation() = Vector3d(x, y, 0) + sight * (stand_off / sight.z());
  return X_RC;
}

RulerScene RandomScene(const SceneFamily& family, std::uint64_t seed) {
  Rng rng(seed);
  RulerScene scene;
  scene.seed = seed + 1000003;
  scene.focal = rng.Uniform(800, 1300);
  scene.centre += Vector2d(rng.Uniform(-8, 8), rng.Uniform(-8, 8));
  scene.k1 = rng.Uniform(-family.distortion, family.distortion);
  scene.k2 = rng.Uniform(-0.5, 0.5) * family.distortion;
  scene.blur = rng.Uniform(0.5, family.largest_blur);
  scene.noise = rng.Uniform(0, family.largest_noise);
  scene.line = rng.Uniform(0.2, 0.45);
  scene.high = rng.Uniform(3, 8);
  scene.low = -rng.Uniform(3, 8);
  scene.body_low = scene.low - 2;
  scene.body_high = scene.high + 2;
  scene.light_u = rng.Uniform(-0.5, 0.5);
  scene.light_v = rng.Uniform(-0.5, 0.5);
  scene.light_r = rng.Uniform(0, 0.6);
  const double x = rng.Uniform(50, 450), stand_off = rng.Uniform(55, 90);
  const auto tilt = [&] { return rng.Uniform(-family.tilt, family.tilt); };
  const Vector3d tilts(tilt(), tilt(), tilt());
  scene.X_RC = CameraOver(x, rng.Uniform(-2, 2), stand_off, tilts);
  if (family.dirt) AddDirt(family, x, 0.4 * stand_off * scene.width / scene.focal, &scene, &rng);
  return scene;
}

}  // namespace dhcal
