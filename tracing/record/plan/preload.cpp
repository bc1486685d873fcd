// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/preload.hpp"

#include <fmt/core.h>
#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tracing/record/plan/event_rule.hpp"

namespace tracing {

namespace {

constexpr const char* kLinkerConfiguration = "/etc/ld.so.conf";
constexpr int kDeepestInclude = 8;  // a file that includes itself must end

void append_configuration(const std::string& file, int depth, std::vector<std::string>& directories);

void append_included(const std::string& pattern, const std::string& from, int depth,
                     std::vector<std::string>& directories) {
  const std::filesystem::path absolute = std::filesystem::path(from).parent_path() / pattern;
  glob_t found{};
  if (glob(absolute.c_str(), 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
      append_configuration(found.gl_pathv[i], depth, directories);
    }
  }
  globfree(&found);
}

void append_configuration(const std::string& file, int depth, std::vector<std::string>& directories) {
  if (depth > kDeepestInclude) {
    return;
  }
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string first;
    if (!(words >> first)) {
      continue;
    }
    if (first != "include") {
      directories.push_back(first);
      continue;
    }
    for (std::string pattern; words >> pattern;) {
      append_included(pattern, file, depth + 1, directories);
    }
  }
}

std::vector<std::string> linker_directories() {
  std::vector<std::string> directories;
  if (const char* given = std::getenv("LD_LIBRARY_PATH")) {
    std::istringstream items(given);
    for (std::string item; std::getline(items, item, ':');) {
      if (!item.empty()) {
        directories.push_back(item);
      }
    }
  }
  for (std::string& directory : standard_library_folders()) {
    directories.push_back(std::move(directory));
  }
  return directories;
}

struct PreloadRule {
  const char* provider;
  std::vector<const char*> events;
  const char* library;
};

constexpr const char* kFastProfile = "liblttng-ust-cyg-profile-fast.so";
constexpr const char* kProfile = "liblttng-ust-cyg-profile.so";
// A helper library brings LTTng-UST and its threads into programs that know nothing of it, a shell for one. What such a
// program forks would inherit the locks that these threads hold, and wait for them for ever when it exits.
constexpr const char* kFork = "liblttng-ust-fork.so";
constexpr const char* kInterfaceVersion = ".1";  // of LTTng-UST 2.13 and later

// In the order of preloading. Source: tracetools_trace of ros2_tracing.
const std::vector<PreloadRule>& preload_rules() {
  static const std::vector<PreloadRule> rules = {
      {"lttng_ust_libc",
       {"malloc", "calloc", "realloc", "free", "memalign", "posix_memalign"},
       "liblttng-ust-libc-wrapper.so"},
      {"lttng_ust_pthread",
       {"pthread_mutex_lock_req", "pthread_mutex_lock_acq", "pthread_mutex_trylock", "pthread_mutex_unlock"},
       "liblttng-ust-pthread-wrapper.so"},
      {"lttng_ust_dl", {"dlopen", "dlmopen", "dlclose", "debug_link", "build_id"}, "liblttng-ust-dl.so"},
      {"lttng_ust_cyg_profile_fast", {"func_entry", "func_exit"}, kFastProfile},
      {"lttng_ust_cyg_profile", {"func_entry", "func_exit"}, kProfile},
  };
  return rules;
}

bool matches(const PreloadRule& rule, const std::string& pattern) {
  return std::any_of(rule.events.begin(), rule.events.end(), [&](const char* event) {
    return fnmatch(pattern.c_str(), fmt::format("{}:{}", rule.provider, event).c_str(), 0) == 0;
  });
}

}  // namespace

std::vector<std::string> read_linker_configuration(const std::string& file) {
  std::vector<std::string> directories;
  append_configuration(file, 0, directories);
  return directories;
}

std::vector<std::string> standard_library_folders() {
  std::vector<std::string> folders = read_linker_configuration(kLinkerConfiguration);
  folders.insert(folders.end(), {"/lib64", "/usr/lib64", "/lib", "/usr/lib"});
  return folders;
}

std::string find_shared_library(const std::string& file_name) {
  for (const std::string& directory : linker_directories()) {
    const std::filesystem::path path = std::filesystem::path(directory) / file_name;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) {
      return std::filesystem::absolute(path).string();
    }
  }
  return {};
}

PreloadPlan plan_preload(const std::vector<std::string>& events_ust) {
  return plan_preload(events_ust, &find_shared_library);
}

PreloadPlan plan_preload(const std::vector<std::string>& events_ust, std::string (*find_library)(const std::string&)) {
  PreloadPlan plan;
  std::vector<std::string> wanted;
  const std::vector<std::string> patterns = event_patterns(events_ust);
  for (const PreloadRule& rule : preload_rules()) {
    if (std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) { return matches(rule, pattern); })) {
      wanted.emplace_back(rule.library);
    }
  }
  const auto wants = [&](const char* library) {
    return std::find(wanted.begin(), wanted.end(), library) != wanted.end();
  };
  if (wants(kFastProfile) && wants(kProfile)) {
    plan.warnings.push_back(fmt::format(
        "events of both function profilers are enabled: the fast one ({}) is used, its exit events carry no address",
        kFastProfile));
  }
  if (!wanted.empty()) {
    wanted.emplace_back(kFork);
  }
  for (const std::string& library : wanted) {
    // The plain name comes with the development package only.
    std::string path = find_library(library);
    if (path.empty()) {
      path = find_library(library + kInterfaceVersion);
    }
    if (path.empty()) {
      plan.warnings.push_back(fmt::format("{} is not installed: {} (package liblttng-ust1)", library,
                                          library == kFork ? "processes that traced processes fork may hang"
                                                           : "the events that it provides will be missing"));
    } else {
      plan.libraries.push_back(std::move(path));
    }
  }
  return plan;
}

std::string append_preload(const std::string& current, const std::vector<std::string>& libraries) {
  std::vector<std::string> known;
  std::string separated = current;
  std::replace(separated.begin(), separated.end(), ' ', ':');  // ld.so(8) takes both
  std::istringstream items(separated);
  for (std::string item; std::getline(items, item, ':');) {
    known.push_back(item);
  }

  std::string result = current;
  for (const std::string& library : libraries) {
    if (std::find(known.begin(), known.end(), library) != known.end()) {
      continue;
    }
    if (!result.empty()) {
      result += ':';
    }
    result += library;
    known.push_back(library);
  }
  return result;
}

}  // namespace tracing
