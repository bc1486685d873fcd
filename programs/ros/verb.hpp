// SPDX-License-Identifier: Apache-2.0
// The commands of launch-ros-command: `launch topic echo` is the verb `echo` of the command `topic`.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "launcher/message_types/interface_library.hpp"

namespace CLI {
class App;
}

namespace launch {

// Makes the command end with exit code 1 and "launch topic echo: error: MESSAGE".
class CommandError : public std::runtime_error {
 public:
  explicit CommandError(const std::string& message, std::string help = {})
      : std::runtime_error(message), help_(std::move(help)) {}
  const std::string& help() const { return help_; }

 private:
  std::string help_;
};

class Verb {
 public:
  virtual ~Verb() = default;
  // Adds options and words to the command line, to be kept in members.
  virtual void declare(CLI::App& app) = 0;
  // Returns the exit code. May throw.
  virtual int run() = 0;
  // What may come next behind these words, for the shell's completion. May throw.
  virtual std::vector<std::string> complete(const std::vector<std::string>& words) {
    (void)words;
    return {};
  }
};

struct CommandOfVerbs {
  std::string name;  // "topic"
  std::string help;
};

const std::vector<CommandOfVerbs>& all_commands();

struct VerbInfo {
  std::string command;  // "topic"
  std::string name;     // "echo"; empty: the command itself, which has no verbs
  std::string help;
  std::unique_ptr<Verb> (*make)();
};

template <typename V, typename... Arguments>
std::unique_ptr<Verb> make_verb(const Arguments&... arguments) {
  return std::make_unique<V>(arguments...);
}

// Those of a command in the order of their names.
const std::vector<VerbInfo>& all_verbs();

// The interfaces that this process finds.
InterfaceLibrary& installed_interfaces();

// A text of the command line, of which errors show the line and a caret. `what` stands where errors of files have their
// path.
LocatedText word_of_command_line(const std::string& what, const std::string& text);

// "/chatter" for "chatter". Throws CommandError for a name that ROS 2 does not allow.
std::string full_name(const std::string& name);

// Whether a part of the name begins with "_".
bool is_hidden(std::string_view name);

// Writes to standard output at once.
void put(std::string_view text);

// The verbs that a file has.
std::vector<VerbInfo> action_verbs();
std::vector<VerbInfo> clock_verbs();
std::vector<VerbInfo> component_verbs();
std::vector<VerbInfo> component_standalone_verbs();
std::vector<VerbInfo> event_echo_verbs();
std::vector<VerbInfo> graph_name_verbs();
std::vector<VerbInfo> interface_verbs();
std::vector<VerbInfo> lifecycle_verbs();
std::vector<VerbInfo> loglevel_verbs();
std::vector<VerbInfo> node_verbs();
std::vector<VerbInfo> param_file_verbs();
std::vector<VerbInfo> param_verbs();
std::vector<VerbInfo> service_verbs();
std::vector<VerbInfo> topic_echo_verbs();
std::vector<VerbInfo> topic_info_verbs();
std::vector<VerbInfo> topic_pub_verbs();
std::vector<VerbInfo> topic_rate_verbs();

}  // namespace launch
