// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/engine.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/environment/own_prefix.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

// Two hexadecimal digits for each byte.
std::string as_word(const std::string& text) {
  std::string word;
  for (const unsigned char byte : text) {
    word += fmt::format("{:02x}", byte);
  }
  return word;
}

std::string from_word(const std::string& word) {
  std::string text;
  for (std::size_t i = 0; i + 1 < word.size(); i += 2) {
    text += static_cast<char>(std::stoi(word.substr(i, 2), nullptr, 16));
  }
  return text;
}

}  // namespace

EngineTask task_of(const std::string& word) {
  const Json json = Json::parse(from_word(word));
  EngineTask task{json.at("file"),      json.at("name"),
                  json.at("number"),    json.at("arguments").get<LaunchArguments>(),
                  json.at("directory"), json.at("seed").get<std::uint64_t>()};
  if (json.contains("faults")) {
    task.faults = json.at("faults").get<std::set<std::size_t>>();
  }
  return task;
}

pid_t start_in_engine(const std::vector<std::string>& engine, const EngineTask& task) {
  Json json = {{"file", fs::absolute(task.file).string()},
               {"name", task.name},
               {"number", task.number},
               {"arguments", task.arguments},
               {"directory", task.directory},
               {"seed", task.seed}};
  if (task.faults) {
    json["faults"] = *task.faults;
  }
  std::vector<std::string> words = engine;
  words.insert(words.end(), {own_prefix() + "/bin/launch", "test", "--task", as_word(json.dump())});
  const std::string path = task.directory + "/engine.txt";
  const UniqueFd output(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644));
  const UniqueFd errors(output ? ::fcntl(output.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1) : -1);
  if (!errors) {
    throw std::system_error(errno, std::system_category(), "cannot write '" + path + "'");
  }
  return spawn({.program = words.front(),
                .argv = words,
                .search_path = words.front().find('/') == std::string::npos,
                .descriptors = {{STDIN_FILENO, kDevNull}, {STDOUT_FILENO, output.get()}, {STDERR_FILENO, errors.get()}},
                .group = ChildGroup::kOwn,
                .signals = ChildSignals::kFresh});
}

std::optional<TestResult> result_of_engine(const std::string& directory) {
  std::ifstream file(directory + "/engine.txt");
  std::optional<TestResult> last;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("{")) {
      if (std::optional<TestResult> result = from_json(line)) {
        last = std::move(result);
      }
    }
  }
  return last;
}

}  // namespace launch
