// Values as Python source has them.
#ifndef DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_VALUES_H_
#define DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_VALUES_H_

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

namespace dhcal {

/// A string in quotes that Python reads back as the same text; bytes that are not UTF-8 as they
/// are in Latin-1.
std::string PythonText(std::string_view text);

/// The shortest digits that read back as the same double. Only of finite numbers.
std::string PythonNumber(double value);

std::string PythonValue(const Eigen::Vector3d& vector);
/// Four rows.
std::string PythonValue(const Eigen::Isometry3d& X);
std::string PythonValue(const std::map<std::string, double>& numbers);
/// "[a, b]" of values that are written already, each on a line of its own.
std::string PythonList(const std::vector<std::string>& values);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RESULT_PYTHON_VALUES_H_
