#include "problems/formats/recording/column_words.h"

#include <cstddef>
#include <map>
#include <vector>

#include "core/base/text.h"

namespace dhcal {

namespace {

using Words = std::vector<std::string>;

/// Words that mean a quantity of ours, by its own words.
const std::map<std::string, std::string>& Synonyms() {
  static const std::map<std::string, std::string> synonyms = [] {
    std::map<std::string, std::string> words = {{"time", "t"},
                                                {"temp", "temperature"},
                                                {"rpy_roll", "roll"},
                                                {"rpy_pitch", "pitch"},
                                                {"rpy_yaw", "yaw"},
                                                {"rpy_x", "roll"},
                                                {"rpy_y", "pitch"},
                                                {"rpy_z", "yaw"}};
    for (const std::string axis : {"w", "x", "y", "z"}) {
      for (const char* const before : {"q_", "quat_", "quaternion_", "orientation_"}) {
        words[before + axis] = "q" + axis;
      }
      if (axis == "w") continue;
      for (const char* const before :
           {"measurement_", "measured_", "meas_", "pos_", "position_", "tracker_"}) {
        words[before + axis] = axis;
      }
      for (const char* const behind : {"_measured", "_meas", "_pos", "_position"}) {
        words[axis + behind] = axis;
      }
      words["rotation_vector_" + axis] = "rotvec_" + axis;
      words["rot_vec_" + axis] = "rotvec_" + axis;
      words["axis_angle_" + axis] = "rotvec_" + axis;
    }
    return words;
  }();
  return synonyms;
}

/// The components of matrices, "xyz_mm(1)", by the matrix' words; MATLAB's quaternions begin with
/// w.
const std::map<std::string, Words>& Matrices() {
  static const std::map<std::string, Words> matrices = {
      {"xyz", {"x", "y", "z"}},
      {"p", {"x", "y", "z"}},
      {"pos", {"x", "y", "z"}},
      {"position", {"x", "y", "z"}},
      {"dxyz", {"dx", "dy", "dz"}},
      {"quat", {"qw", "qx", "qy", "qz"}},
      {"quat_wxyz", {"qw", "qx", "qy", "qz"}},
      {"quat_xyzw", {"qx", "qy", "qz", "qw"}},
      {"rotvec", {"rotvec_x", "rotvec_y", "rotvec_z"}},
      {"rpy", {"roll", "pitch", "yaw"}},
      {"abc", {"a", "b", "c"}},
      {"euler_xyz", {"euler_xyz_x", "euler_xyz_y", "euler_xyz_z"}}};
  return matrices;
}

}  // namespace

std::string OurWords(const std::string& words) {
  const auto synonym = Synonyms().find(words);
  return synonym == Synonyms().end() ? words : synonym->second;
}

ColumnSpelling ComponentOf(std::string_view name, ColumnSpelling spelling) {
  const auto matrix = Matrices().find(spelling.words);
  if (!spelling.number || matrix == Matrices().end() || !EndsWith(name, ")")) return spelling;
  const auto index = static_cast<std::size_t>(*spelling.number - 1);  // 0 is none
  if (index >= matrix->second.size()) return spelling;
  spelling.words = matrix->second[index];
  spelling.number.reset();
  return spelling;
}

}  // namespace dhcal
