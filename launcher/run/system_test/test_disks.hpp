// SPDX-License-Identifier: Apache-2.0
// The disks of a test with faults of disks: each directory that a fault names is a disk of its own, in memory
// (memory_disk.hpp). The launcher and all processes of the test share them; nobody else sees them.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/isolation/memory_disk.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

class TestDisks {
 public:
  struct Places {
    std::string own;                  // the directory of the test: what is written below stays when it ends
    std::string logs;                 // that of a fault without a directory
    std::vector<std::string> traces;  // which LTTng's daemons write, from outside
  };

  // Must be made while there is one thread; this process then sees the disks. Throws LaunchError at a fault that is not
  // possible.
  TestDisks(const std::vector<DiskFault>& faults, const Places& places);
  // Writes what is on disks of the test's own directory to the directory itself. All processes must have ended.
  ~TestDisks();
  TestDisks(const TestDisks&) = delete;
  TestDisks& operator=(const TestDisks&) = delete;

  // The disk is full from now on, for the fault of this number, until make_room(). Throw std::system_error.
  void fill(std::size_t number, const DiskFault& fault);
  void make_room(std::size_t number);

 private:
  struct Disk {
    MemoryDisk disk;
    bool is_kept;                             // at the end
    std::map<std::size_t, std::size_t> full;  // by the number of a fault: the bytes for which there is room
  };

  static void apply(Disk& disk);
  Disk& mount(const std::string& directory, const DiskFault& fault, const Places& places);

  std::list<Disk> disks_;
  std::map<std::string, Disk*> named_;  // by the directory of a fault
};

}  // namespace launch
