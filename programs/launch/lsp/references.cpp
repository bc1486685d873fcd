// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "launcher/invocation/find_launch_file.hpp"
#include "programs/launch/lsp/argument_places.hpp"
#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

namespace {

namespace fs = std::filesystem;

// An argument of one launch file.
struct Argument {
  std::string file;
  std::string name;
};

struct Place {
  std::string file;
  Json range;
};

std::string included_file(const Workspace& workspace, const Reading& reading, int include) {
  const std::string_view text = reading.document.text();
  const OutlineElement& element = reading.outline.elements[static_cast<std::size_t>(include)];
  const std::optional<std::string> path =
      workspace.performed(reading.path, reading.outline, value_of(element, "file", text));
  std::error_code ignored;
  return path ? fs::weakly_canonical(fs::path(reading.path).parent_path() / *path, ignored).string() : std::string();
}

std::optional<Argument> argument_at_position(const Workspace& workspace, const Reading& reading, const Json& position) {
  const auto found = argument_at(reading.outline, reading.document.text(), reading.document.offset(position));
  if (!found) {
    return std::nullopt;
  }
  if (found->kind != ArgumentPlace::Kind::kGiven) {
    return Argument{reading.path, found->name};
  }
  std::string file = included_file(workspace, reading, found->include);
  return file.empty() ? std::nullopt : std::optional(Argument{std::move(file), found->name});
}

std::vector<Place> places_of(const Workspace& workspace, const Argument& argument, const std::string& folder) {
  std::vector<Place> places;
  std::set<std::string> files = files_below(folder, argument.file);
  for (const auto& [path, text] : workspace.texts()) {
    files.insert(path);
  }
  for (const std::string& path : files) {
    const std::optional<Document> document = workspace.document(path);
    if (!document || document->text().find(argument.name) == std::string::npos) {
      continue;
    }
    const Reading reading = {path, *document, outline_of(document->text())};
    for (const ArgumentPlace& place : argument_places(reading.outline, document->text())) {
      const bool is_it =
          place.name == argument.name &&
          (place.kind == ArgumentPlace::Kind::kGiven ? included_file(workspace, reading, place.include) == argument.file
                                                     : path == argument.file);
      if (is_it) {
        places.push_back({path, document->range(place.span.begin, place.span.end)});
      }
    }
  }
  return places;
}

}  // namespace

std::set<std::string> files_below(const std::string& folder, const std::string& own) {
  std::set<std::string> files = {own};
  std::error_code unreadable;
  constexpr std::size_t kMost = 10'000;
  if (folder.empty()) {
    return files;
  }
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, unreadable), end;
       at != end && files.size() < kMost; at.increment(unreadable)) {
    const std::string name = at->path().filename().string();
    if (at->is_directory(unreadable) &&
        (name.starts_with('.') || name == "build" || name == "install" || name == "log")) {
      at.disable_recursion_pending();
    } else if (is_launch_file(at->path()) && !name.ends_with(".py")) {
      files.insert(at->path().string());
    }
  }
  return files;
}

Json references(const Workspace& workspace, const Reading& reading, const Json& position, const std::string& folder) {
  const std::optional<Argument> argument = argument_at_position(workspace, reading, position);
  if (!argument) {
    return {};
  }
  Json found = Json::array();
  for (const Place& place : places_of(workspace, *argument, folder)) {
    found.push_back({{"uri", uri_of(place.file)}, {"range", place.range}});
  }
  return found;
}

Json prepare_rename(const Reading& reading, const Json& position) {
  const auto found = argument_at(reading.outline, reading.document.text(), reading.document.offset(position));
  return found ? reading.document.range(found->span.begin, found->span.end) : Json();
}

Json rename(const Workspace& workspace, const Reading& reading, const Json& position, const std::string& name,
            const std::string& folder) {
  if (name.empty() || name.find_first_of(" \t\r\n()$'\"<>&") != std::string::npos) {
    throw std::invalid_argument("'" + name + "' can't be the name of an argument");
  }
  const std::optional<Argument> argument = argument_at_position(workspace, reading, position);
  if (!argument) {
    return {};
  }
  Json changes = Json::object();
  for (const Place& place : places_of(workspace, *argument, folder)) {
    changes[uri_of(place.file)].push_back({{"range", place.range}, {"newText", name}});
  }
  return {{"changes", std::move(changes)}};
}

}  // namespace launch::lsp
