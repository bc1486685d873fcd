// SPDX-License-Identifier: Apache-2.0
// Names of what runs, for the completion of commands that ask a launch.
#include <functional>
#include <set>
#include <string>

#include "base/environment/own_environment.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "programs/launch/command_functions.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

// What `take` takes of the processes of the launches that run.
Words of_processes(const std::function<void(const Json& process, std::set<std::string>& words)>& take) {
  std::set<std::string> words;
  for (FoundLaunch& found : find_launches(own_environment())) {
    try {
      const Json answer = ControlClient(std::move(found)).ask("ps");
      for (const Json& process : answer["processes"]) {
        take(process, words);
      }
    } catch (const ControlError&) {
      // Its names are not to be had.
    }
  }
  return {words.begin(), words.end()};
}

void take_names(const Json& process, std::set<std::string>& words) {
  words.insert(process["name"].get<std::string>());
  for (const Json& name : process["names"]) {
    words.insert(name.get<std::string>());
  }
}

void take_groups(const Json& process, std::set<std::string>& words) {
  for (const Json& group : process.value("groups", Json::array())) {
    words.insert(group.get<std::string>());
  }
}

Words names_of_those_with(const char* property) {
  return of_processes([&](const Json& process, std::set<std::string>& words) {
    if (process.value(property, false)) {
      take_names(process, words);
    }
  });
}

}  // namespace

Words process_words(const Words& words) {
  const bool wants_group = words.size() > 1 && words[words.size() - 2] == "--group";
  return of_processes(wants_group ? take_groups : take_names);
}

Words attach_words(const Words& /*words*/) {
  return names_of_those_with("tty");
}

Words scale_words(const Words& words) {
  return words.size() > 2 ? Words{} : names_of_those_with("scalable");
}

Words signal_words(const Words& words) {
  return words.size() > 2 ? signal_names() : process_words(words);
}

}  // namespace launch
