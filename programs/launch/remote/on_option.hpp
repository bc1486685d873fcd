// SPDX-License-Identifier: Apache-2.0
// `--on COMMAND`: a command that asks running launches does it on another machine, or in a container. The command leads
// there, such as `ssh robot` or `docker exec -i robot`; LAUNCH_ON is its default.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/environment/environment.hpp"

namespace launch {

class Subcommand;

// Adds the option to the help of a command. The command never sees a value: take_on_option() has taken it before.
void describe_on_option(Subcommand& command);

struct OnOption {
  std::string connect;             // the connecting command; "": here
  std::vector<std::string> words;  // the others
  bool lacks_value = false;
};

// Takes the option out of the words behind the name of a command. An empty value means here, whatever LAUNCH_ON says.
OnOption take_on_option(const std::vector<std::string>& words, const Environment& environment);

// What a command gets there that wants a terminal.
enum class OtherTerminal {
  kNone,
  kOfCommand,  // a terminal, if there is one here
  kOfProcess   // so it does, and all keys but those that detach are for a process behind it
};

// Runs `launch` with these words through the connecting command, and returns its exit code there, or kNoConnection.
// `command` is "launch ps", for errors.
constexpr int kNoConnection = 255;  // as ssh(1)
int run_on_other_side(const std::string& command, const std::string& connect, std::vector<std::string> words,
                      OtherTerminal terminal);

// `launch remote-side`: the other side, which the connecting command starts there.
int remote_side_command(const std::vector<std::string>& words);

}  // namespace launch
