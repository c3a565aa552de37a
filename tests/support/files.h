// Paths of the repository and of scratch folders, for tests.
#ifndef DHCAL_TESTS_SUPPORT_FILES_H_
#define DHCAL_TESTS_SUPPORT_FILES_H_

#include <string>

namespace dhcal {

/// Path of a file of the repository, "problems/cases/kr15.yaml".
std::string SourcePath(const std::string& relative);

/// Folder of the real recordings (environment variable DHCAL_DATA), or "".
std::string DataDir();

/// Folder of the cases recorded elsewhere (environment variable DHCAL_SHARED), or "".
std::string SharedDir();

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_FILES_H_
