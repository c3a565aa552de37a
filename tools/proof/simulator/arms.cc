#include "tools/proof/simulator/arms.h"

#include <vector>

#include "core/base/units.h"

namespace dhcal::concealed {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd Degrees(const std::vector<double>& values) {
  VectorXd radians(static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    radians[static_cast<Eigen::Index>(k)] = values[k] * kDegree;
  }
  return radians;
}

/// A row of a data sheet.
struct SheetRow {
  double theta_deg, d, a, alpha_deg;
};

DrawnLink Link(const SheetRow& row, double mass, const Vector3d& com) {
  DrawnLink link;
  link.theta = row.theta_deg * kDegree;
  link.d = row.d;
  link.a = row.a;
  link.alpha = row.alpha_deg * kDegree;
  link.mass = mass;
  link.com = com;
  return link;
}

}  // namespace

Arm KukaKr15() {
  Arm arm;
  arm.name = "kr15";
  arm.title = "KUKA KR 15/2";
  arm.links = {Link({0, 0.675, 0.3, 90}, 60, {-0.2, 0.1, 0}),
               Link({0, 0, 0.65, 0}, 40, {-0.35, 0, 0.05}),
               Link({0, 0, 0.155, 90}, 35, {-0.02, 0, 0.1}),
               Link({0, 0.6, 0, -90}, 15, {0, 0.15, 0}),
               Link({0, 0, 0, 90}, 8, {0, 0, 0.03}),
               Link({0, 0.14, 0, 0}, 3, {0, 0, -0.03})};
  arm.tool.translation() = Vector3d(0.06, 0.02, 0.2);
  arm.payload = 10;
  arm.payload_com = Vector3d(0.05, 0, 0.12);
  arm.middle = Degrees({0, 60, 10, 0, 40, 0});
  arm.wide = Degrees({170, 60, 80, 170, 100, 170});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm UniversalUr10() {
  Arm arm;
  arm.name = "ur10";
  arm.title = "Universal Robots UR10";
  arm.links = {Link({0, 0.1273, 0, 90}, 7.778, {0, -0.04, 0}),
               Link({0, 0, -0.612, 0}, 12.93, {0.3, 0, 0.15}),
               Link({0, 0, -0.5723, 0}, 3.87, {0.27, 0, 0.06}),
               Link({0, 0.163941, 0, 90}, 1.96, {0, -0.02, 0.01}),
               Link({0, 0.1157, 0, -90}, 1.96, {0, 0.02, 0.01}),
               Link({0, 0.0922, 0, 0}, 0.202, {0, 0, -0.03})};
  arm.tool.translation() = Vector3d(0.03, 0.06, 0.11);
  arm.payload = 5;
  arm.payload_com = Vector3d(0.03, 0, 0.1);
  arm.main_compliance = 15e-6;
  arm.wrist_compliance = 60e-6;
  arm.base_compliance = 1e-6;
  arm.middle = Degrees({0, -70, 80, -90, -80, 0});
  arm.wide = Degrees({170, 70, 90, 150, 100, 170});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm SmallArm() {
  Arm arm;
  arm.name = "small";
  arm.title = "Small arm of 0.6 m reach";
  arm.links = {Link({0, 0.29, 0, -90}, 3.07, {0, 0.04, 0}),
               Link({-90, 0, 0.27, 0}, 3.91, {-0.17, 0, 0}),
               Link({0, 0, 0.07, -90}, 2.94, {-0.01, 0, 0.05}),
               Link({0, 0.302, 0, 90}, 1.33, {0, -0.08, 0}),
               Link({0, 0, 0, -90}, 0.55, {0, 0, 0.01}),
               Link({0, 0.072, 0, 0}, 0.14, {0, 0, -0.01})};
  arm.tool.translation() = Vector3d(0.04, 0.01, 0.1);
  arm.payload = 2;
  arm.payload_com = Vector3d(0.02, 0, 0.06);
  arm.noise = 0.015e-3;
  arm.main_compliance = 20e-6;
  arm.wrist_compliance = 150e-6;
  arm.base_compliance = 2e-6;
  arm.middle = Degrees({0, 20, 10, 0, 40, 0});
  arm.wide = Degrees({160, 70, 60, 155, 100, 170});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm ModifiedSix() {
  Arm arm;
  arm.name = "modified";
  arm.title = "Six joints in modified rows";
  arm.convention = Convention::kModified;
  arm.links = {Link({0, 0.5, 0, 0}, 45, {0.12, 0, -0.05}),
               Link({0, 0, 0.26, -90}, 30, {0.34, 0, 0.04}),
               Link({-90, 0, 0.68, 0}, 22, {0.03, 0, 0.08}),
               Link({0, 0.67, 0.035, -90}, 10, {0, 0.02, -0.15}),
               Link({0, 0, 0, 90}, 5, {0, -0.02, 0.01}),
               Link({0, 0.115, 0, -90}, 2, {0, 0.01, -0.03})};
  arm.tool.translation() = Vector3d(0.03, -0.05, 0.12);
  arm.payload = 6;
  arm.payload_com = Vector3d(0.03, 0, 0.1);
  arm.main_compliance = 4e-6;
  arm.middle = Degrees({0, -10, 5, 0, 0, 0});
  arm.wide = Degrees({150, 70, 85, 150, 100, 150});
  arm.narrow = Degrees({35, 20, 20, 60, 30, 90});
  return arm;
}

Arm SevenAxes() {
  Arm arm;
  arm.name = "seven";
  arm.title = "Seven axes";
  arm.links = {Link({0, 0.36, 0, -90}, 6, {0, 0.05, 0.03}),
               Link({0, 0, 0, 90}, 6, {0.01, 0, 0.1}),
               Link({0, 0.42, 0, 90}, 5, {0, -0.06, 0.04}),
               Link({0, 0, 0, -90}, 5, {0.01, 0.02, 0.1}),
               Link({0, 0.4, 0, -90}, 3, {0, 0.12, 0.02}),
               Link({0, 0, 0, 90}, 2.5, {0, 0.02, 0.02}),
               Link({0, 0.126, 0, 0}, 1, {0.01, 0, -0.04})};
  arm.tool.translation() = Vector3d(0.03, -0.05, 0.12);
  arm.payload = 4;
  arm.payload_com = Vector3d(0.03, 0, 0.1);
  arm.main_compliance = 12e-6;
  arm.wrist_compliance = 50e-6;
  arm.base_compliance = 1e-6;
  arm.middle = Degrees({0, 0, 0, 0, 0, 0, 0});
  arm.wide = Degrees({150, 100, 150, 110, 150, 100, 160});
  arm.narrow = Degrees({35, 20, 40, 20, 60, 30, 90});
  return arm;
}

Arm Scara() {
  Arm arm;
  arm.name = "scara";
  arm.title = "SCARA";
  arm.links = {Link({0, 0.4, 0.4, 0}, 25, {-0.2, 0, 0.02}),
               Link({0, 0, 0.35, 180}, 18, {-0.15, 0, 0.04}),
               Link({0, 0, 0, 0}, 3, {0, 0, -0.05}),
               Link({0, 0.05, 0, 0}, 1, {0.01, 0, -0.02})};
  arm.links[2].slides = true;
  arm.tool.translation() = Vector3d(0.03, -0.05, 0.12);
  arm.payload = 4;
  arm.payload_com = Vector3d(0.02, 0, 0.05);
  arm.middle = Degrees({0, 0, 0, 0});
  arm.wide = Degrees({130, 140, 0, 170});
  arm.narrow = Degrees({35, 30, 0, 90});
  arm.middle[2] = 0.1;
  arm.wide[2] = 0.08;
  arm.narrow[2] = 0.03;
  return arm;
}

}  // namespace dhcal::concealed
