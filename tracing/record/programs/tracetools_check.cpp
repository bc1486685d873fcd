// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/programs/tracetools_check.hpp"

#include <fmt/core.h>
#include <sys/stat.h>
#include <sys/xattr.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/small_file.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using Kind = TracetoolsFinding::Kind;

constexpr const char* kLibrary = "libtracetools.so";
// Every tracetools has this function. Only that of this stack has the other one.
constexpr const char* kTheirFunction = "ros_trace_rcl_init";
constexpr const char* kOurFunction = "ros_trace_ext_rcl_node_fini";

// From which version on a library stands in. Versions in between were never in a distribution, or differ from both.
struct StandIn {
  std::pair<int, int> from;
  std::pair<int, int> to;
  const char* folder;
};
constexpr StandIn kStandIns[] = {{.from = {4, 0}, .to = {4, 9}, .folder = "4.0"},
                                 {.from = {5, 1}, .to = {7, 9}, .folder = "5.1"},
                                 {.from = {8, 1}, .to = {8, 3}, .folder = "8.1"},
                                 {.from = {8, 4}, .to = {8, 10}, .folder = "8.4"}};
constexpr std::pair<int, int> kOldest = kStandIns[0].from;
constexpr std::pair<int, int> kNewest = std::end(kStandIns)[-1].to;

// LTTng keeps the parameters of an event as a text. From 8.0 on this is a part of those of rmw_publish.
constexpr const char* kParameterOfAnyVersion = "context_handle_arg";
constexpr const char* kParameterSince8 = "int64_t, timestamp_arg";
constexpr int kMajorOfParameter = 8;

// The functions that others may call; the rest is the library's own.
bool is_of_interface(const std::string& symbol) {
  return symbol.starts_with("ros_trace_") || symbol.starts_with("_ZN10tracetools") ||
         symbol.starts_with("_ZNK10tracetools");
}

// The dynamic linker preloads nothing into a program that has more rights than its user.
bool has_rights_of_its_own(const std::string& program) {
  struct stat status {};
  return (::stat(program.c_str(), &status) == 0 && (status.st_mode & (S_ISUID | S_ISGID)) != 0) ||
         ::getxattr(program.c_str(), "security.capability", nullptr, 0) > 0;
}

// package.xml of the prefix in whose folder of libraries, or below it, the library is.
std::optional<TracetoolsVersion> version_of_library(const std::string& library) {
  std::error_code failed;
  const fs::path real = fs::canonical(library, failed);
  fs::path folder = real.parent_path();
  for (int i = 0; !failed && i < 3; ++i) {
    folder = folder.parent_path();
    if (const auto text = launch::read_small_file((folder / "share/tracetools/package.xml").string())) {
      return version_of_package(*text);
    }
  }
  return std::nullopt;
}

std::string unknown_version(const TracetoolsVersion& version) {
  const std::pair number(version.major, version.minor);
  if (number < kOldest) {
    return fmt::format("version {} of tracetools is older than {}.{}", version.text, kOldest.first, kOldest.second);
  }
  if (number > kNewest) {
    return fmt::format("version {} of tracetools is newer than {}.{}", version.text, kNewest.first, kNewest.second);
  }
  return fmt::format("version {} of tracetools was in no ROS 2", version.text);
}

// The program that executes a script, by its first line; "" if it is none.
std::string interpreter_of(const std::string& program) {
  char begin[256] = {};  // the kernel reads no more either
  std::ifstream(program).read(begin, sizeof begin - 1);
  const std::string_view text = begin;
  if (!text.starts_with("#!")) {
    return {};
  }
  std::istringstream words(std::string(text.substr(2, text.find('\n') - 2)));
  std::string word;
  words >> word;
  if (fs::path(word).filename() == "env") {
    words >> word;
  }
  return word;
}

// A node in Python. It loads the libraries of its ROS 2 later, which no file tells. Other scripts may use none of them.
bool is_python_node(const fs::path& program) {
  const fs::path folder = program.parent_path();  // PREFIX/lib/PACKAGE
  std::error_code failed;
  return fs::path(interpreter_of(program.string())).filename().string().starts_with("python") &&
         fs::exists(folder.parent_path().parent_path() / "share" / folder.filename() / "package.xml", failed);
}

std::string library_in_path(const LibrarySearch::Variables& environment) {
  const auto variable = environment.find("LD_LIBRARY_PATH");
  std::istringstream folders(variable == environment.end() ? std::string() : variable->second);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code failed;
    if (const fs::path path = fs::path(folder) / kLibrary; !folder.empty() && fs::exists(path, failed)) {
      return path.string();
    }
  }
  return {};
}

TracetoolsFinding stays(TracetoolsFinding finding, std::string reason) {
  finding.kind = Kind::kTheirs;
  finding.library.clear();
  finding.reason = std::move(reason);
  return finding;
}

}  // namespace

std::optional<TracetoolsVersion> version_of_package(const std::string& package_xml) {
  const std::size_t element = package_xml.find("<version");
  const std::size_t begin = element == std::string::npos ? element : package_xml.find('>', element);
  const std::size_t end = begin == std::string::npos ? begin : package_xml.find('<', begin);
  if (end == std::string::npos) {
    return std::nullopt;
  }
  TracetoolsVersion version;
  std::istringstream(package_xml.substr(begin + 1, end - begin - 1)) >> version.text;
  const char* const last = version.text.data() + version.text.size();
  const auto major = std::from_chars(version.text.data(), last, version.major);
  if (major.ec != std::errc() || major.ptr == last || *major.ptr != '.' ||
      std::from_chars(major.ptr + 1, last, version.minor).ec != std::errc()) {
    return std::nullopt;
  }
  return version;
}

std::string stand_in_for(const TracetoolsVersion& version) {
  const std::pair number(version.major, version.minor);
  for (const StandIn& each : kStandIns) {
    if (each.from <= number && number <= each.to) {
      return each.folder;
    }
  }
  return {};
}

const TracetoolsFinding& TracetoolsCheck::check(const std::string& program,
                                                const LibrarySearch::Variables& environment) {
  const auto variable = environment.find("LD_LIBRARY_PATH");
  const std::string key = program + '\n' + (variable == environment.end() ? "" : variable->second);
  const auto known = of_program_.find(key);
  return known != of_program_.end() ? known->second
                                    : of_program_.emplace(key, find(program, environment)).first->second;
}

TracetoolsFinding TracetoolsCheck::find(const std::string& program, const LibrarySearch::Variables& environment) {
  LibrarySearch search;
  const ElfFile* const file = search.file(program);
  std::string theirs;
  if (file == nullptr) {
    theirs = is_python_node(program) ? library_in_path(environment) : "";
  } else if (file->is_foreign) {
    return {};  // its libraries cannot be read
  } else if (file->is_dynamic) {
    theirs = search.library_of(program, kLibrary, environment);
  }
  if (theirs.empty()) {
    return file != nullptr && file->defines(kTheirFunction) && !file->defines(kOurFunction)
               ? stays({}, "it is linked statically")
               : TracetoolsFinding();
  }
  const auto known = of_library_.find(theirs);
  const TracetoolsFinding finding =
      known != of_library_.end() ? known->second : of_library_.emplace(theirs, compare(theirs)).first->second;
  return finding.kind == Kind::kStandIn && has_rights_of_its_own(program)
             ? stays(finding, "it has rights that its user does not have, so nothing is preloaded")
             : finding;
}

TracetoolsFinding TracetoolsCheck::compare(const std::string& theirs) const {
  TracetoolsFinding finding;
  const std::optional<ElfFile> file = ElfFile::read(theirs);
  if (!file) {
    return finding;
  }
  if (file->defines(kOurFunction)) {
    finding.kind = Kind::kOurs;
    return finding;
  }
  finding.theirs = theirs;
  const std::optional<TracetoolsVersion> version = version_of_library(theirs);
  if (!version) {
    return stays(finding, fmt::format("the version of {} is unknown: share/tracetools/package.xml is missing", theirs));
  }
  finding.version = version->text;
  const std::string folder = stand_in_for(*version);
  if (folder.empty()) {
    return stays(finding, unknown_version(*version));
  }
  finding.library = fmt::format("{}/lib/tracetools/stand_ins/{}/{}", prefix_, folder, kLibrary);
  const std::optional<ElfFile> ours = ElfFile::read(finding.library);
  if (!ours) {
    return stays(finding, fmt::format("{} is not installed", finding.library));
  }
  if (ours->machine != file->machine) {
    return stays(finding, "it is built for another processor");
  }
  const std::set<std::string> offered = ours->exported_symbols();
  std::vector<std::string> missing;
  for (const std::string& symbol : file->exported_symbols()) {
    if (is_of_interface(symbol) && !offered.contains(symbol)) {
      missing.push_back(symbol);
    }
  }
  if (!missing.empty()) {
    return stays(finding,
                 fmt::format("its tracetools has {}{}, which ours lacks", missing.front(),
                             missing.size() == 1 ? "" : fmt::format(" and {} more functions", missing.size() - 1)));
  }
  if (file->contains(kParameterOfAnyVersion) &&
      file->contains(kParameterSince8) != (version->major >= kMajorOfParameter)) {
    return stays(finding,
                 fmt::format("rmw_publish of its tracetools has not the parameters of version {}", version->text));
  }
  finding.kind = Kind::kStandIn;
  return finding;
}

}  // namespace tracing
