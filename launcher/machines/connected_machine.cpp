// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/connected_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {
namespace {

constexpr const char* kSearchPath = "AMENT_PREFIX_PATH";

std::string value_of(const Environment& environment, const std::string& name) {
  const auto found = environment.find(name);
  return found == environment.end() ? std::string() : found->second;
}

class PackagesThere final : public PackageIndex {
 public:
  PackagesThere(MachineConnection& connection, const AgentHello& hello)
      : connection_(connection), search_path_(value_of(hello.environment, kSearchPath)) {
    for (const AgentPackage& package : hello.packages) {
      known_.emplace(package.name, package);
    }
  }

  std::string prefix(const std::string& package, const Environment& environment) override {
    if (value_of(environment, kSearchPath) == search_path_) {
      if (const auto found = known_.find(package); found != known_.end()) {
        return found->second.prefix;
      }
    } else if (const std::string& found = look_up(package, environment); !found.empty()) {
      return found;
    }
    throw std::runtime_error(fmt::format("package '{}' not found on machine '{}'", package, connection_.name()));
  }

  std::string executable(const std::string& executable, const std::string& package,
                         const Environment& environment) override {
    const std::string libexec = fmt::format("{}/lib/{}", prefix(package, environment), package);
    const bool is_path = executable.find('/') != std::string::npos;
    std::string path = is_path ? executable : fmt::format("{}/{}", libexec, executable);
    bool is_there = false;
    if (!is_path && value_of(environment, kSearchPath) == search_path_) {
      const std::vector<std::string>& programs = known_.at(package).programs;
      is_there = std::find(programs.begin(), programs.end(), executable) != programs.end();
    } else if (!executable.empty()) {
      is_there = connection_.ask(AgentQuestion::kProgram, WireWriter().text(path)) == "1";
    }
    if (!is_there) {
      throw std::runtime_error(fmt::format("executable '{}' not found on the libexec directory '{}' of machine '{}'",
                                           executable, libexec, connection_.name()));
    }
    return path;
  }

  std::vector<std::string> packages(const Environment& /*environment*/) const override {
    std::vector<std::string> names;
    for (const auto& [name, package] : known_) {
      names.push_back(without_control_characters(name));
    }
    return names;
  }

  std::string help_for_missing(const std::string& package, const Environment& environment) const override {
    const std::string help = did_you_mean(package, packages(environment));
    return help.empty() ? fmt::format(
                              "install it on machine '{}', or name the setup file that has it: "
                              "setup=\"…/setup.bash\" of the <machine>",
                              connection_.name())
                        : help;
  }

  std::vector<std::string> executables(const std::string& package, const Environment& environment) override {
    prefix(package, environment);
    const auto found = known_.find(package);
    return found == known_.end() ? std::vector<std::string>() : found->second.programs;
  }

  std::string find_program(const std::string& name, const Environment& environment) override {
    return connection_.ask(AgentQuestion::kFindProgram, WireWriter().text(name).text(value_of(environment, "PATH")));
  }

 private:
  const std::string& look_up(const std::string& package, const Environment& environment) {
    const std::string path = value_of(environment, kSearchPath);
    const auto [found, is_new] = asked_.try_emplace({package, path});
    if (is_new) {
      found->second = connection_.ask(AgentQuestion::kPackage, WireWriter().text(package).text(path));
    }
    return found->second;
  }

  MachineConnection& connection_;
  std::string search_path_;
  std::map<std::string, AgentPackage> known_;
  std::map<std::pair<std::string, std::string>, std::string> asked_;
};

class ConnectedMachine final : public MachineView {
 public:
  ConnectedMachine(MachineConnection& connection, const AgentHello& hello)
      : connection_(connection),
        environment_(hello.environment),
        packages_(std::make_shared<PackagesThere>(connection, hello)) {}

  const std::string& name() const override { return connection_.name(); }
  bool is_connected() const override { return true; }
  const Environment& environment() const override { return environment_; }
  std::shared_ptr<PackageIndex> packages() override { return packages_; }

  std::vector<bool> are_files(const std::vector<std::string>& paths) override {
    WireWriter question;
    question.u32(static_cast<std::uint32_t>(paths.size()));
    for (const std::string& path : paths) {
      question.text(path);
    }
    const std::string answer = connection_.ask(AgentQuestion::kAreFiles, question);
    std::vector<bool> are(paths.size(), false);
    for (std::size_t i = 0; i < paths.size() && i < answer.size(); ++i) {
      are[i] = answer[i] == '1';
    }
    return are;
  }

  std::string read_file(const std::string& path) override {
    return connection_.ask(AgentQuestion::kFileContent, WireWriter().text(path));
  }

  CommandOutput run(const std::string& program, const std::vector<std::string>& words, const Environment& environment,
                    bool merge_error) override {
    WireWriter question;
    question.flag(merge_error).text(program).u32(static_cast<std::uint32_t>(words.size()));
    for (const std::string& word : words) {
      question.text(word);
    }
    question.u32(static_cast<std::uint32_t>(environment.size()));
    for (const auto& [name, value] : environment) {
      question.text(name).text(value);
    }
    const std::string answer = connection_.ask(AgentQuestion::kRun, question);
    try {
      WireReader reader(answer);
      CommandOutput output;
      output.status = reader.i32();
      output.text = reader.text();
      output.error = reader.text();
      reader.end();
      return output;
    } catch (const WireError& error) {
      throw std::runtime_error(error.what());
    }
  }

 private:
  MachineConnection& connection_;
  Environment environment_;
  std::shared_ptr<PackageIndex> packages_;
};

}  // namespace

std::shared_ptr<MachineView> make_connected_machine(MachineConnection& connection, const AgentHello& hello) {
  return std::make_shared<ConnectedMachine>(connection, hello);
}

}  // namespace launch
