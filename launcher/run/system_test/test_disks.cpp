// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/test_disks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

// The same directory counts.
bool is_below(const fs::path& path, const fs::path& directory) {
  return std::mismatch(directory.begin(), directory.end(), path.begin(), path.end()).first == directory.end();
}

[[noreturn]] void refuse(const std::string& why, const DiskFault& fault, const std::string& help = {}) {
  throw LaunchError("a full disk is not possible here: " + why, fault.where, help);
}

// The canonical path. Throws LaunchError for a directory that can't be a disk.
std::string checked_directory(const DiskFault& fault, const TestDisks::Places& places) {
  const std::string& given = fault.directory.empty() ? places.logs : fault.directory;
  std::error_code error;
  if (is_below(given, places.own)) {
    fs::create_directories(given, error);
  }
  const fs::path directory = fs::canonical(given, error);
  if (error || !fs::is_directory(directory)) {
    refuse(fmt::format("'{}' is no directory", given), fault, "a directory must be there when the test begins");
  }
  if (is_below(fs::canonical(places.own), directory)) {
    refuse(fmt::format("'{}' holds the files of the test", given), fault,
           "without path, the disk of the logs is full; launch test --directory puts the files elsewhere");
  }
  for (const std::string& trace : places.traces) {
    const fs::path written = fs::weakly_canonical(trace);
    if (is_below(written, directory) || is_below(directory, written)) {
      refuse(fmt::format("'{}' has a trace", given), fault,
             "LTTng's daemons write it, and they do not see the disks of a test");
    }
  }
  return directory.string();
}

}  // namespace

TestDisks::TestDisks(const std::vector<DiskFault>& faults, const Places& places) {
  try {
    enter_own_mounts();
  } catch (const std::system_error& error) {
    refuse(error.what(), faults.front(), "it needs a mount namespace, as root or with user namespaces");
  }
  // In this order, an outer directory comes first. Its disk would cover those that are below it.
  std::map<std::string, std::vector<const DiskFault*>> wanted;
  for (const DiskFault& fault : faults) {
    wanted[checked_directory(fault, places)].push_back(&fault);
  }
  for (const auto& [directory, same] : wanted) {
    Disk& disk = mount(directory, *same.front(), places);
    for (const DiskFault* const fault : same) {
      named_.emplace(fault->directory, &disk);
    }
  }
  // A working directory that a disk covers would be the covered one.
  std::error_code ignored;
  fs::current_path(fs::current_path(ignored), ignored);
}

TestDisks::Disk& TestDisks::mount(const std::string& directory, const DiskFault& fault, const Places& places) {
  try {
    return disks_.emplace_back(Disk{MemoryDisk(directory), is_below(directory, fs::canonical(places.own)), {}});
  } catch (const std::system_error& error) {
    if (error.code().value() == EFBIG) {
      refuse(fmt::format("'{}' holds more than {} MiB", directory, MemoryDisk::kMostCopied >> 20U), fault,
             "a test works on a copy of the directory, in memory");
    }
    refuse(error.what(), fault);
  }
}

TestDisks::~TestDisks() {
  for (auto disk = disks_.rbegin(); disk != disks_.rend(); ++disk) {  // an inner one to the outer one
    try {
      if (disk->is_kept) {
        disk->disk.save();
      }
    } catch (const std::system_error& error) {
      fmt::print(stderr, "the files of '{}' are lost: {}\n", disk->disk.directory(), error.what());
    }
  }
}

void TestDisks::fill(std::size_t number, const DiskFault& fault) {
  const auto found = named_.find(fault.directory);
  if (found == named_.end()) {
    throw std::system_error(ENOENT, std::system_category(), fault.directory);
  }
  found->second->full.emplace(number, fault.free);
  apply(*found->second);
}

void TestDisks::make_room(std::size_t number) {
  for (Disk& disk : disks_) {
    if (disk.full.erase(number) > 0) {
      apply(disk);
    }
  }
}

void TestDisks::apply(Disk& disk) {
  std::optional<std::uint64_t> room;
  for (const auto& [number, free] : disk.full) {
    room = std::min<std::uint64_t>(room.value_or(free), free);
  }
  disk.disk.leave(room);
}

}  // namespace launch
