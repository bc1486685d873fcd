// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/python_places.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/read_source_file.hpp"

namespace launch {

SourceRange PythonPlaces::range(const python::Place& place) {
  std::shared_ptr<const SourceFile> file = file_;
  if (place.line != 0 && place.file != file_->path()) {
    const auto [known, added] = modules_.try_emplace(place.file);
    if (added) {
      try {
        known->second = read_source_file(place.file, file_->included_from());
      } catch (const LaunchError&) {
        // The code comes from no file.
      }
    }
    file = known->second;
  }
  if (place.line == 0 || file == nullptr) {
    return {file_, 0, 0};
  }
  const std::string_view line = file->line(place.line);
  if (line.data() == nullptr) {
    return {file, 0, 0};
  }
  const std::size_t start = static_cast<std::size_t>(line.data() - file->text().data());
  std::size_t begin = std::min<std::size_t>(place.begin, line.size());
  std::size_t end = std::min<std::size_t>(place.end, line.size());
  if (end <= begin) {
    begin = std::min(line.find_first_not_of(" \t"), line.size());
    end = line.size();
  }
  return {std::move(file), static_cast<std::uint32_t>(start + begin), static_cast<std::uint32_t>(start + end)};
}

void PythonPlaces::fail(const python::Error& error) {
  if (error.cause != nullptr) {
    try {
      std::rethrow_exception(error.cause);
    } catch (const LaunchError&) {
      throw;
    } catch (const python::Error& inner) {
      fail(inner);
    } catch (const std::exception&) {
      // Only LaunchError has a place: told as Python's error, at the place of the call.
    }
  }
  std::string help = error.help;
  if (!error.traceback.empty()) {
    help += (help.empty() ? "" : "\n") + error.traceback;
  }
  throw LaunchError(error.what(), range(error.where), std::move(help), Finding::kPython);
}

}  // namespace launch
