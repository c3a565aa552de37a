#include "core/io/process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/base/text.h"

namespace dhcal {
namespace {

// Files, not pipes: a program that prints while it still reads blocks on neither.
using ScratchFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

ScratchFile NewScratchFile() { return {std::tmpfile(), &std::fclose}; }

/// Pointers to the words, and the null that ends them.
std::vector<char*> AsPointers(std::vector<std::string>* words) {
  std::vector<char*> pointers;
  for (std::string& word : *words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// This process' environment, in the C locale.
std::vector<std::string> CLocaleEnvironment() {
  std::vector<std::string> variables = {"LC_ALL=C.UTF-8"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!StartsWith(*variable, "LC_ALL=")) variables.emplace_back(*variable);
  }
  return variables;
}

/// 0 and the child's number, or an errno value.
int Spawn(std::vector<std::string>* words, std::FILE* input, std::FILE* output, pid_t* child) {
  std::vector<std::string> variables = CLocaleEnvironment();
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, fileno(output), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawnp(child,
                                 words->front().c_str(),
                                 &files,
                                 nullptr,
                                 AsPointers(words).data(),
                                 AsPointers(&variables).data());
  posix_spawn_file_actions_destroy(&files);
  return error;
}

/// The child's wait status, or nothing when it had to be ended.
std::optional<int> WaitFor(pid_t child, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kGlance(2);
  const auto until = std::chrono::steady_clock::now() + patience;
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return std::nullopt;
    if (std::chrono::steady_clock::now() > until) break;
    std::this_thread::sleep_for(kGlance);
  }
  kill(child, SIGKILL);
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return std::nullopt;
}

std::string ContentOf(std::FILE* file) {
  std::string content;
  std::rewind(file);
  char buffer[1 << 16];
  for (;;) {
    const std::size_t count = std::fread(buffer, 1, sizeof(buffer), file);
    if (count == 0) return content;
    content.append(buffer, count);
  }
}

}  // namespace

ProcessOutput RunForOutput(std::vector<std::string> words,
                           const std::string& input,
                           std::chrono::milliseconds patience) {
  using End = ProcessOutput::End;
  const ScratchFile from = NewScratchFile(), to = NewScratchFile();
  if (!from || !to) return {};
  const bool written = std::fwrite(input.data(), 1, input.size(), from.get()) == input.size();
  if (!written || std::fflush(from.get()) != 0) return {};
  std::rewind(from.get());
  pid_t child = 0;
  const int error = Spawn(&words, from.get(), to.get(), &child);
  if (error != 0) return {error == ENOENT ? End::kNotFound : End::kFailed, ""};
  const std::optional<int> status = WaitFor(child, patience);
  if (!status) return {End::kTimeOut, ""};
  if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0) return {};
  return {End::kDone, ContentOf(to.get())};
}

}  // namespace dhcal
