// SPDX-License-Identifier: Apache-2.0
// Whether our tracetools can stand in for the one that a program of another ROS 2 would load: whether every call that
// such a program may make means the same to ours (docs/tracetools.md, "Versions of the interface").
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "tracing/record/programs/library_search.hpp"

namespace tracing {

// A version of ROS 2's package tracetools.
struct TracetoolsVersion {
  int major = 0;
  int minor = 0;
  std::string text = {};  // "8.2.3"
};

// From a package.xml: the text in its element <version>.
std::optional<TracetoolsVersion> version_of_package(const std::string& package_xml);

// The folder of the library that stands in for a version: "5.1" has the functions of 5.1 and of what follows. "" if
// there is none.
std::string stand_in_for(const TracetoolsVersion& version);

// What a program has of tracetools, and what can be done.
struct TracetoolsFinding {
  enum class Kind {
    kNone,     // it uses no tracetools, as far as its file tells
    kOurs,     // that of this stack
    kStandIn,  // that of another ROS 2, and `library` can be preloaded
    kTheirs    // that of another ROS 2, which has to stay
  };
  Kind kind = Kind::kNone;
  std::string theirs = {};   // the path of the library that it would load; "" if it is part of the program
  std::string version = {};  // of theirs, if that is known
  std::string library = {};  // the path of ours
  std::string reason = {};   // why theirs has to stay: the rest of a sentence, "it is linked statically"
};

class TracetoolsCheck {
 public:
  // `prefix`: of this installation.
  explicit TracetoolsCheck(std::string prefix) : prefix_(std::move(prefix)) {}

  // `program`: the path of a program, or of a node in Python. Reads some tens of files, and keeps what it has found for
  // the next process of the same program.
  const TracetoolsFinding& check(const std::string& program, const LibrarySearch::Variables& environment);

 private:
  TracetoolsFinding find(const std::string& program, const LibrarySearch::Variables& environment);
  TracetoolsFinding compare(const std::string& theirs) const;

  std::string prefix_;
  std::map<std::string, TracetoolsFinding> of_program_;  // by its path and LD_LIBRARY_PATH
  std::map<std::string, TracetoolsFinding> of_library_;
};

}  // namespace tracing
