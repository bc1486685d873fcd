// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/programs/library_search.hpp"

#include <filesystem>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "tracing/record/plan/preload.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

std::string folder_of(const std::string& path) {
  std::error_code failed;
  const fs::path real = fs::canonical(path, failed);
  return (failed ? fs::path(path) : real).parent_path().string();
}

std::string joined(const std::vector<std::string>& folders) {
  std::string text;
  for (const std::string& folder : folders) {
    text += folder + ':';
  }
  return text;
}

}  // namespace

const ElfFile* LibrarySearch::file(const std::string& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) {
    return known->second.get();
  }
  std::optional<ElfFile> read = ElfFile::read(path);
  return files_.emplace(path, read ? std::make_unique<ElfFile>(std::move(*read)) : nullptr).first->second.get();
}

std::string LibrarySearch::find_in(const std::string& folders, const std::string& name, const Loaded& origin) {
  std::istringstream items(folders);
  for (std::string folder; std::getline(items, folder, ':');) {
    if (folder.empty()) {
      continue;
    }
    if (folder.find('$') != std::string::npos) {
      for (const char* const token : {"$ORIGIN", "${ORIGIN}"}) {
        replace_all(folder, token, folder_of(origin.path));
      }
    }
    std::string path = folder + '/' + name;
    const ElfFile* const found = file(path);
    if (found != nullptr && !found->is_foreign && found->machine == origin.file->machine) {
      return path;
    }
  }
  return {};
}

std::string LibrarySearch::find(const std::string& name, const std::vector<Loaded>& loaded, int needer,
                                const std::string& given) {
  const Loaded& origin = loaded[static_cast<std::size_t>(needer)];
  if (name.find('/') != std::string::npos) {
    return file(name) != nullptr ? name : std::string();
  }
  if (!origin.file->runpath) {
    for (int i = needer; i >= 0; i = loaded[static_cast<std::size_t>(i)].loader) {
      const Loaded& each = loaded[static_cast<std::size_t>(i)];
      if (each.file->runpath || !each.file->rpath) {
        continue;
      }
      if (std::string path = find_in(*each.file->rpath, name, each); !path.empty()) {
        return path;
      }
    }
  }
  if (std::string path = find_in(given, name, origin); !path.empty()) {
    return path;
  }
  if (origin.file->runpath) {
    if (std::string path = find_in(*origin.file->runpath, name, origin); !path.empty()) {
      return path;
    }
  }
  static const std::string standard = joined(standard_library_folders());
  return find_in(standard, name, origin);
}

std::string LibrarySearch::library_of(const std::string& program, const std::string& name,
                                      const Variables& environment) {
  const ElfFile* const start = file(program);
  if (start == nullptr || start->is_foreign) {
    return {};
  }
  const auto variable = environment.find("LD_LIBRARY_PATH");
  const std::string given = variable == environment.end() ? std::string() : variable->second;
  std::vector<Loaded> loaded = {{program, start, -1}};
  std::set<std::string> seen;
  // In the order in which the linker loads them: what the program needs, then what these need.
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    for (const std::string& needed : loaded[i].file->needed) {
      if (!seen.insert(needed).second) {
        continue;
      }
      std::string path = find(needed, loaded, static_cast<int>(i), given);
      if (needed == name) {
        return path;
      }
      if (!path.empty()) {
        loaded.push_back({path, file(path), static_cast<int>(i)});
      }
    }
  }
  return {};
}

}  // namespace tracing
