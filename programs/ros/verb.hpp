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

std::unique_ptr<Verb> make_clock();
std::unique_ptr<Verb> make_topic_list();
std::unique_ptr<Verb> make_topic_info();
std::unique_ptr<Verb> make_topic_type();
std::unique_ptr<Verb> make_topic_find();
std::unique_ptr<Verb> make_topic_echo();
std::unique_ptr<Verb> make_topic_hz();
std::unique_ptr<Verb> make_topic_bw();
std::unique_ptr<Verb> make_topic_delay();
std::unique_ptr<Verb> make_topic_pub();
std::unique_ptr<Verb> make_node_info();
std::unique_ptr<Verb> make_node_list();
std::unique_ptr<Verb> make_service_call();
std::unique_ptr<Verb> make_service_find();
std::unique_ptr<Verb> make_service_info();
std::unique_ptr<Verb> make_service_list();
std::unique_ptr<Verb> make_service_type();
std::unique_ptr<Verb> make_param_delete();
std::unique_ptr<Verb> make_param_describe();
std::unique_ptr<Verb> make_param_dump();
std::unique_ptr<Verb> make_param_get();
std::unique_ptr<Verb> make_param_list();
std::unique_ptr<Verb> make_param_load();
std::unique_ptr<Verb> make_param_set();
std::unique_ptr<Verb> make_action_info();
std::unique_ptr<Verb> make_action_list();
std::unique_ptr<Verb> make_action_send_goal();
std::unique_ptr<Verb> make_action_type();
std::unique_ptr<Verb> make_loglevel();
std::unique_ptr<Verb> make_lifecycle_get();
std::unique_ptr<Verb> make_lifecycle_list();
std::unique_ptr<Verb> make_lifecycle_nodes();
std::unique_ptr<Verb> make_lifecycle_set();
std::unique_ptr<Verb> make_component_list();
std::unique_ptr<Verb> make_component_load();
std::unique_ptr<Verb> make_component_types();
std::unique_ptr<Verb> make_component_unload();
std::unique_ptr<Verb> make_interface_list();
std::unique_ptr<Verb> make_interface_package();
std::unique_ptr<Verb> make_interface_packages();
std::unique_ptr<Verb> make_interface_proto();
std::unique_ptr<Verb> make_interface_show();

}  // namespace launch
