// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/death_in_python.hpp"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "base/files/unique_fd.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {
namespace {

constexpr std::size_t kLongestLine = 100;  // of a file, as it is shown

std::string traces_of(int records) {
  std::string text(kPythonTraces, '\0');
  const ssize_t count = ::pread(records, text.data(), text.size(), kGuardianPythonTraces);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text.substr(0, text.find('\0'));
}

// A file below the working directory is named from there.
std::string shown(const std::string& path) {
  std::array<char, 4096> buffer{};
  if (::getcwd(buffer.data(), buffer.size()) == nullptr) {
    return path;
  }
  const std::string directory = std::string(buffer.data()) + "/";
  return path.compare(0, directory.size(), directory) == 0 ? path.substr(directory.size()) : path;
}

// The file up to the end of the line with this number, from 1.
std::string read_lines(const std::string& path, std::uint32_t number) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::string text;
  std::array<char, 4096> buffer;  // not initialised: it is read into
  for (ssize_t count = 0; file && std::count(text.begin(), text.end(), '\n') < static_cast<std::ptrdiff_t>(number) &&
                          (count = ::read(file.get(), buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

std::string line_of(const std::string& path, std::uint32_t number) {
  const std::string text = read_lines(path, number);
  std::size_t begin = 0;
  for (std::uint32_t i = 1; i < number; ++i) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) {
      return {};
    }
    begin = end + 1;
  }
  std::string line = text.substr(begin, text.find('\n', begin) - begin);
  // Control characters would steer the terminal.
  std::replace_if(
      line.begin(), line.end(), [](unsigned char byte) { return byte < ' ' || byte == 0x7F; }, ' ');
  return line.size() > kLongestLine ? line.substr(0, kLongestLine) + "..." : line;
}

// "a.launch.py:4:5: error: …", the line, and what leads to it. Without a column the first word of the line is meant.
std::string error_at(const std::string& path, std::uint32_t number, std::uint32_t column, const std::string& message,
                     const std::string& help) {
  const std::string line = line_of(path, number);
  const std::size_t begin = column > 0 ? column - 1 : std::min(line.find_first_not_of(' '), line.size());
  std::string gutter = std::to_string(number);
  gutter.insert(0, gutter.size() < 5 ? 5 - gutter.size() : 0, ' ');
  std::string text = shown(path) + ":" + std::to_string(number) + ":" + std::to_string(begin + 1) +
                     ": error: " + message + "\n" + gutter + " | " + line + "\n      | " + std::string(begin, ' ') +
                     "^";
  if (column == 0 && line.size() > begin + 1) {
    text += std::string(line.size() - begin - 1, '~');
  }
  text += "\n";
  return help.empty() ? text : text + "      = help: " + help + "\n";
}

bool is_of_python(int signal) {
  return signal == SIGSEGV || signal == SIGABRT || signal == SIGBUS || signal == SIGFPE || signal == SIGILL ||
         signal == SIGSYS;
}

std::string reason_of(const PythonAtWork& python, int status) {
  if (python.cause == PythonAtWork::Cause::kOutOfTime) {
    return "Python runs here for more than " + std::to_string(python.seconds) + " s, and was ended";
  }
  if (python.cause == PythonAtWork::Cause::kClosedDescriptors) {
    return "this file closes descriptors of the launcher, which can't go on without them";
  }
  if (WIFEXITED(status)) {
    return "Python ends the launch here, with exit code " + std::to_string(WEXITSTATUS(status));
  }
  const char* const name = ::sigabbrev_np(WTERMSIG(status));
  return std::string("Python ends the launch here by SIG") + (name == nullptr ? "?" : name);
}

}  // namespace

std::optional<DeathInPython> death_in_python(int records, int status) {
  PythonAtWork python{};
  if (::pread(records, &python, sizeof python, kGuardianPython) != sizeof python || python.used == 0 ||
      python.ended != 0 || (WIFSIGNALED(status) && !is_of_python(WTERMSIG(status)))) {
    return std::nullopt;
  }
  const std::string traces = traces_of(records);
  python.file.back() = '\0';
  std::string file = python.running != 0 ? python.file.data() : "";
  if (file.empty()) {
    file = file_in_python_traces(traces);  // a thread that Python has started
  }
  if (file.empty()) {
    return std::nullopt;
  }
  const bool by_launcher = python.cause != PythonAtWork::Cause::kNone;
  const std::uint32_t line = python.line != 0 ? python.line : line_in_python_traces(traces, file);
  return DeathInPython{
      error_at(file, std::max(line, 1U), python.line != 0 ? python.column : 0, reason_of(python, status),
               python.cause == PythonAtWork::Cause::kOutOfTime ? "--python-seconds gives it more time" : ""),
      by_launcher};
}

}  // namespace launch
