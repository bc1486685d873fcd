// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/machine_questions.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/process_mark.hpp"
#include "launcher/substitution/command_output.hpp"

namespace launch {
namespace {

constexpr std::size_t kLongestFile = kLongestFrame / 2 - 64;

bool is_file(const std::string& path) {
  struct stat facts {};
  return ::stat(path.c_str(), &facts) == 0 && S_ISREG(facts.st_mode);
}

// Throws std::runtime_error. Never blocks: the path may be that of a pipe.
std::string text_of_file(const std::string& path) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat facts {};
  if (!file || ::fstat(file.get(), &facts) != 0) {
    throw std::runtime_error(fmt::format("cannot read '{}': {}", path, ::strerror(errno)));
  }
  if (!S_ISREG(facts.st_mode)) {
    throw std::runtime_error(fmt::format("cannot read '{}': it is no file", path));
  }
  std::string text;
  std::array<char, 65536> bytes;  // not initialised: it is read into
  for (ssize_t count = 0; (count = ::read(file.get(), bytes.data(), bytes.size())) > 0;) {
    text.append(bytes.data(), static_cast<std::size_t>(count));
    if (text.size() > kLongestFile) {
      throw std::runtime_error(fmt::format("'{}' has more than {} bytes", path, kLongestFile));
    }
  }
  return text;
}

}  // namespace

Environment environment_after(const std::string& given) {
  Environment environment = own_environment();
  environment.erase(kMarkVariable);
  if (given.empty()) {
    return environment;
  }
  const auto home = environment.find("HOME");
  const std::string setup =
      given.starts_with("~/") && home != environment.end() ? home->second + given.substr(1) : given;
  if (!is_file(setup)) {
    throw std::runtime_error(fmt::format("the setup file '{}' does not exist there", setup));
  }
  const std::string shell = setup.ends_with(".bash") ? "bash" : (setup.ends_with(".zsh") ? "zsh" : "sh");
  const std::string program = PackageIndex::find_on_path(shell, environment);
  if (program.empty()) {
    throw std::runtime_error(fmt::format("there is no {} for the setup file '{}'", shell, setup));
  }
  const CommandOutput output =
      capture_command(program, {shell, "-c", ". \"$1\" >&2 && exec env -0", shell, setup}, environment, {});
  std::fputs(output.error.c_str(), stderr);
  if (output.status != 0) {
    throw std::runtime_error(
        fmt::format("the setup file '{}' has failed there: {}", setup, describe_status(output.status)));
  }
  Environment::Variables variables;
  for (std::size_t begin = 0; begin < output.text.size();) {
    const std::size_t end = std::min(output.text.find('\0', begin), output.text.size());
    const std::string_view entry = std::string_view(output.text).substr(begin, end - begin);
    if (const std::size_t equals = entry.find('='); equals != std::string_view::npos && equals > 0) {
      variables.emplace(entry.substr(0, equals), entry.substr(equals + 1));
    }
    begin = end + 1;
  }
  for (const char* const of_shell : {"_", "SHLVL", "OLDPWD"}) {
    variables.erase(of_shell);
  }
  return Environment(std::move(variables));
}

AgentHello describe_machine(const Environment& environment) {
  AgentHello hello;
  utsname names{};
  ::uname(&names);
  hello.host = names.nodename;
  hello.architecture = names.machine;
  std::error_code unknown;
  hello.directory = std::filesystem::current_path(unknown).string();
  hello.environment = environment.variables();
  hello.own_prefix = own_prefix();
  PackageIndex packages(hello.own_prefix);
  for (const std::string& name : packages.packages(environment)) {
    try {
      hello.packages.push_back({name, packages.prefix(name, environment), packages.executables(name, environment)});
    } catch (const std::runtime_error&) {
      // It has gone meanwhile, or its name is none.
    }
  }
  return hello;
}

MachineQuestions::MachineQuestions(EventLoop& loop, const Environment& /*environment*/)
    : loop_(loop), packages_(own_prefix()) {}

void MachineQuestions::answer(WireReader& reader, Done done) {
  const auto what = static_cast<AgentQuestion>(reader.u8());
  try {
    switch (what) {
      case AgentQuestion::kFileContent: {
        const std::string path = reader.text();
        reader.end();
        done(true, text_of_file(path));
        return;
      }
      case AgentQuestion::kAreFiles: {
        std::string there;
        for (std::uint32_t left = reader.count(sizeof(std::uint32_t)); left > 0; --left) {
          there += is_file(reader.text()) ? '1' : '0';
        }
        reader.end();
        done(true, there);
        return;
      }
      case AgentQuestion::kFindProgram: {
        const std::string name = reader.text();
        const Environment environment{{"PATH", reader.text()}};
        reader.end();
        done(true, PackageIndex::find_on_path(name, environment));
        return;
      }
      case AgentQuestion::kPackage: {
        const std::string name = reader.text();
        const Environment environment{{"AMENT_PREFIX_PATH", reader.text()}};
        reader.end();
        std::string prefix;
        try {
          prefix = packages_.prefix(name, environment);
        } catch (const std::runtime_error&) {
          // The launcher tells that it is missing.
        }
        done(true, prefix);
        return;
      }
      case AgentQuestion::kProgram: {
        const std::string path = reader.text();
        reader.end();
        done(true, is_file(path) && ::access(path.c_str(), X_OK) == 0 ? "1" : "0");
        return;
      }
      case AgentQuestion::kRun:
        run(reader, std::move(done));
        return;
    }
  } catch (const WireError&) {
    throw;
  } catch (const std::runtime_error& error) {
    done(false, error.what());
    return;
  }
  throw WireError("it asks for something unknown");
}

// A thread waits for the command, so that the processes go on meanwhile.
void MachineQuestions::run(WireReader& reader, Done done) {
  const bool merge_error = reader.flag();
  const std::string program = reader.text();
  std::vector<std::string> words;
  for (std::uint32_t left = reader.count(sizeof(std::uint32_t)); left > 0; --left) {
    words.push_back(reader.text());
  }
  Environment::Variables variables;
  for (std::uint32_t left = reader.count(2 * sizeof(std::uint32_t)); left > 0; --left) {
    std::string name = reader.text();
    variables.insert_or_assign(std::move(name), reader.text());
  }
  reader.end();
  if (words.empty()) {
    throw WireError("a command has no words");
  }
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  std::thread([this, merge_error, program, words = std::move(words), environment = Environment(std::move(variables)),
               done = std::move(done)] {
    std::string text;
    bool well = true;
    try {
      const CommandOutput output =
          capture_command(program, words, environment, {.merge_error = merge_error, .limit = std::nullopt});
      if (output.given_up != CommandOutput::GivenUp::kNot) {
        throw std::runtime_error(fmt::format("it wrote more than {} MiB, and was ended", kLargestCommandOutput >> 20U));
      }
      WireWriter answer;
      answer.i32(output.status).text(output.text).text(output.error);
      text = answer.bytes();
    } catch (const std::runtime_error& error) {
      well = false;
      text = error.what();
    }
    loop_.post([done, well, text = std::move(text)] { done(well, text); });
  }).detach();
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace launch
