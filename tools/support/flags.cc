#include "tools/support/flags.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "core/base/quiet_log.h"

namespace dhcal {
namespace {

constexpr int kFlagsDone = 0, kFault = 1, kFlagsWrong = 2;

template <typename T>
T* Named(const std::vector<std::pair<std::string, T*>>& entries, const std::string& name) {
  const auto found = std::find_if(
      entries.begin(), entries.end(), [&](const auto& entry) { return name == entry.first; });
  return found == entries.end() ? nullptr : found->second;
}

int TakeFlagsAndRun(int argc, char** argv, const FlagProgram& program) {
  if (std::any_of(argv + 1, argv + argc, [](const std::string& a) { return a == "--help"; })) {
    std::cout << program.help;
    return kFlagsDone;
  }
  if (const char* const data = std::getenv("DHCAL_DATA")) *program.data_dir = data;
  const std::string wrong = TakeFlags(argc, argv, program.flags);
  if (wrong.empty()) return program.run();
  std::cerr << program.name << ": '" << wrong << "' is no flag or lacks its value; see --help\n";
  return kFlagsWrong;
}

}  // namespace

std::string TakeFlags(int argc, char** argv, const Flags& flags) {
  for (int k = 1; k < argc; ++k) {
    std::string argument = argv[k];
    if (argument.rfind("--", 0) != 0) {
      if (flags.words == nullptr) return argument;
      flags.words->push_back(argument);
      continue;
    }
    const std::size_t equals = argument.find('=');
    std::string name = argument.substr(0, equals).substr(2);
    std::replace(name.begin(), name.end(), '-', '_');
    if (bool* const on = Named(flags.switches, name); on != nullptr) {
      if (equals != std::string::npos) return argument;
      *on = true;
      continue;
    }
    std::string* const text = Named(flags.texts, name);
    const bool is_next = equals == std::string::npos;
    if (text == nullptr || (is_next && k + 1 == argc)) return argument;
    *text = is_next ? argv[++k] : argument.substr(equals + 1);
  }
  return "";
}

int RunFlagProgram(int argc, char** argv, const FlagProgram& program) {
  StartQuietLog(argv[0]);
  try {
    return TakeFlagsAndRun(argc, argv, program);
  } catch (const std::exception& error) {
    std::cerr << program.name << ": internal error: " << error.what() << "\n";
    return kFault;
  }
}

}  // namespace dhcal
