// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/remote/on_option.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "programs/command_line/subcommand.hpp"

namespace launch {

void describe_on_option(Subcommand& command) {
  static std::string unused;
  command.take_text("--on", unused,
                    "ask on another machine, through a command such as 'ssh robot'; default: LAUNCH_ON");
}

OnOption take_on_option(const std::vector<std::string>& words, const Environment& environment) {
  constexpr std::string_view kName = "--on";
  OnOption option;
  if (const auto found = environment.find("LAUNCH_ON"); found != environment.end()) {
    option.connect = found->second;
  }
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (*word == "--") {
      std::copy(word, words.end(), std::back_inserter(option.words));
      break;
    }
    if (*word == kName) {
      if (std::next(word) == words.end()) {
        option.lacks_value = true;
        break;
      }
      option.connect = *++word;
    } else if (word->starts_with(kName) && word->substr(kName.size()).starts_with('=')) {
      option.connect = word->substr(kName.size() + 1);
    } else {
      option.words.push_back(*word);
    }
  }
  // The help is the same everywhere.
  if (std::any_of(option.words.begin(), option.words.end(),
                  [](const std::string& word) { return word == "--help" || word == "-h"; })) {
    option.connect.clear();
  }
  return option;
}

}  // namespace launch
