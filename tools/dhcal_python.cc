// The compiled part of the Python module dhcal; tools/python/dhcal/__init__.py makes it pleasant.

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/base/diagnostics.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/formats/problem/effects_reader.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/result/result_writer.h"
#include "problems/recording_of.h"
#include "tools/compensate/compensate.h"
#include "tools/compensate/real_arm.h"

namespace dhcal {
namespace {

namespace py = pybind11;

/// Becomes dhcal.InputError in Python.
class InputError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

void ThrowErrors(const Diagnostics& diagnostics) {
  if (!diagnostics.ok()) throw InputError(diagnostics.ToString());
}

ProblemSpec ReadSpec(const std::string& file, const std::string& data_dir) {
  Diagnostics diagnostics;
  std::optional<ProblemSpec> spec = ReadProblemFile(file, data_dir, &diagnostics);
  ThrowErrors(diagnostics);
  return std::move(*spec);
}

/// A calibration that ran, with what it needs to be stored.
struct Calibration {
  ProblemSpec spec;
  Recording recording;
  Result result;

  std::string Json() const { return ResultToJson(result); }
  bool usable() const { return result.best() != nullptr; }
  void Save(const std::string& folder) const {
    Diagnostics diagnostics;
    CheckResultDirectory(folder, &diagnostics);
    ThrowErrors(diagnostics);
    WriteResult(spec, recording, result, folder, &diagnostics);
    ThrowErrors(diagnostics);
  }
};

class Problem {
 public:
  /// `recording`, when not empty, takes the place of the file's recording or simulation.
  Problem(const std::string& file, const std::string& recording, const std::string& data_dir)
      : spec_(ReadSpec(file, data_dir)) {
    if (recording.empty()) return;
    spec_.recording = recording;
    spec_.simulate.reset();
  }

  int num_joints() const { return spec_.robot.num_joints(); }

  /// As ceres_dhcal does it; `diagnosis`: auto, always, never, or empty for the file's.
  std::unique_ptr<Calibration> Identify(const std::string& diagnosis) const {
    auto calibration = std::make_unique<Calibration>();
    calibration->spec = spec_;
    if (!diagnosis.empty() && !ParseDiagnosisRun(diagnosis, &calibration->spec.diagnosis)) {
      throw InputError("diagnosis is '" + diagnosis + "': expected auto, always or never");
    }
    Diagnostics diagnostics;
    std::optional<Recording> recording = RecordingOf(calibration->spec, &diagnostics);
    ThrowErrors(diagnostics);
    calibration->recording = std::move(*recording);
    calibration->result = Calibrate(calibration->spec, calibration->recording, Watch());
    return calibration;
  }

  /// X_WQ of each row of `q` (rows x joints) [rad or m], effects of the file included.
  std::vector<Eigen::Matrix4d> Forward(const Eigen::MatrixXd& q) const {
    CheckJoints(q);
    const Recording rows = Rows(q);
    const ProblemSpec spec = OneBase();
    const RealArm arm = ArmOf(spec, rows);
    const Eigen::MatrixXd deltas = arm.Deltas(q);
    std::vector<Eigen::Matrix4d> poses;
    for (int row = 0; row < rows.num_rows(); ++row) {
      poses.push_back(arm.Pose(q, deltas, row).matrix());
    }
    return poses;
  }

  /// Joint coordinates (rows x joints) [rad or m] for poses X_WQ, each near the one before.
  Eigen::MatrixXd Inverse(const std::vector<Eigen::Matrix4d>& poses,
                          const Eigen::VectorXd& seed) const {
    const Eigen::MatrixXd seeds =
        seed.transpose().replicate(static_cast<Eigen::Index>(poses.size()), 1);
    CheckJoints(seeds);
    const Recording rows = Rows(seeds);
    const ProblemSpec spec = OneBase();
    const RealArm arm = ArmOf(spec, rows);
    std::vector<Eigen::Isometry3d> wanted;
    for (const Eigen::Matrix4d& pose : poses) wanted.emplace_back(pose);
    const std::vector<Command> commands = Compensate(arm, wanted, {seeds, true});
    Eigen::MatrixXd q(seeds.rows(), seeds.cols());
    for (std::size_t row = 0; row < commands.size(); ++row) {
      if (!commands[row].refusal.empty()) {
        throw InputError(fmt::format("pose {}: {}", row, commands[row].refusal));
      }
      q.row(static_cast<Eigen::Index>(row)) = commands[row].q.transpose();
    }
    return q;
  }

 private:
  void CheckJoints(const Eigen::MatrixXd& q) const {
    if (q.cols() != num_joints() || !q.allFinite()) {
      throw InputError(fmt::format(
          "expected {} finite joint coordinates per row, not {}", num_joints(), q.cols()));
    }
  }

  static Recording Rows(const Eigen::MatrixXd& q) {
    Recording rows;
    rows.q = q;
    return rows;
  }

  /// Where no edge is at hand the base of the file is the only one.
  ProblemSpec OneBase() const {
    ProblemSpec spec = spec_;
    spec.robot.base_per_edge = false;
    spec.robot.edges.clear();
    return spec;
  }

  static RealArm ArmOf(const ProblemSpec& spec, const Recording& rows) {
    Diagnostics diagnostics;
    RealArm arm(spec, rows, &diagnostics);
    ThrowErrors(diagnostics);
    return arm;
  }

  ProblemSpec spec_;
};

}  // namespace

PYBIND11_MODULE(_dhcal, module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  module.attr("version") = DHCAL_VERSION;
  py::class_<Calibration>(module, "Calibration")
      .def_property_readonly("usable", &Calibration::usable)
      .def("json", &Calibration::Json)
      .def("save", &Calibration::Save, py::call_guard<py::gil_scoped_release>());
  py::class_<Problem>(module, "Problem")
      .def(py::init<const std::string&, const std::string&, const std::string&>())
      .def_property_readonly("num_joints", &Problem::num_joints)
      .def("identify", &Problem::Identify, py::call_guard<py::gil_scoped_release>())
      .def("forward", &Problem::Forward)
      .def("inverse", &Problem::Inverse);
}

}  // namespace dhcal
