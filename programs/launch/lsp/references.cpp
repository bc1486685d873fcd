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

std::optional<Argument> argument_at_position(const Workspace& workspace, const Reading& reading, const Json& position) {
  const auto found = argument_at(reading, workspace, reading.document.offset(position));
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
  std::set<std::string> files = files_below(folder, argument.file, true);
  for (const auto& [path, text] : workspace.texts()) {
    files.insert(path);
  }
  for (const std::string& path : files) {
    const std::optional<Document> document = workspace.document(path);
    if (!document || document->text().find(argument.name) == std::string::npos) {
      continue;
    }
    const Reading reading = reading_of(path, *document);
    for (const ArgumentPlace& place : argument_places(reading, workspace)) {
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

std::string included_file(const Workspace& workspace, const Reading& reading, int include) {
  std::error_code ignored;
  if (is_python(reading.path)) {
    const PythonFileText file = python_file(workspace, reading);
    const std::string path = file.included(reading.python.brackets[static_cast<std::size_t>(include)]);
    return path.empty() ? path : fs::weakly_canonical(path, ignored).string();
  }
  const std::string_view text = reading.document.text();
  const OutlineElement& element = reading.outline.elements[static_cast<std::size_t>(include)];
  const std::optional<std::string> path =
      workspace.performed(reading.path, reading.outline, value_of(element, "file", text));
  return path ? fs::weakly_canonical(fs::path(reading.path).parent_path() / *path, ignored).string() : std::string();
}

Reading reading_of(const std::string& path, const Document& document) {
  return is_python(path) ? Reading{path, document, {}, python_source_of(document.text())}
                         : Reading{path, document, outline_of(document.text())};
}

bool is_python(const std::string& path) {
  return path.ends_with(".py");
}

PythonFileText python_file(const Workspace& workspace, const Reading& reading) {
  return {[&workspace](const std::string& package) { return workspace.share(package); }, reading.path,
          reading.document.text(), reading.python};
}

std::vector<ArgumentPlace> argument_places(const Reading& reading, const Workspace& workspace) {
  const std::string& text = reading.document.text();
  return is_python(reading.path) ? python_argument_places(python_file(workspace, reading))
                                 : argument_places(reading.outline, text);
}

std::optional<ArgumentPlace> argument_at(const Reading& reading, const Workspace& workspace, std::size_t offset) {
  for (ArgumentPlace& place : argument_places(reading, workspace)) {
    if (place.span.holds(offset)) {
      return std::move(place);
    }
  }
  return std::nullopt;
}

std::set<std::string> files_below(const std::string& folder, const std::string& own, bool python) {
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
    } else if (is_launch_file(at->path()) && (python || !is_python(name))) {
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

Json prepare_rename(const Workspace& workspace, const Reading& reading, const Json& position) {
  const auto found = argument_at(reading, workspace, reading.document.offset(position));
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
  if (name != argument->name && !places_of(workspace, {argument->file, name}, folder).empty()) {
    throw std::invalid_argument("'" + name + "' is the name of another argument or configuration already");
  }
  Json changes = Json::object();
  for (const Place& place : places_of(workspace, *argument, folder)) {
    changes[uri_of(place.file)].push_back({{"range", place.range}, {"newText", name}});
  }
  return {{"changes", std::move(changes)}};
}

}  // namespace launch::lsp
