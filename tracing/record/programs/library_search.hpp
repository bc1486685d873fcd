// SPDX-License-Identifier: Apache-2.0
// Which file the dynamic linker takes for a library that a program needs, or that a library of it needs (ld.so(8)).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tracing/record/programs/elf_file.hpp"

namespace tracing {

class LibrarySearch {
 public:
  using Variables = std::map<std::string, std::string>;

  // The path of the library of this name that a start of the program in this environment would load; "" if it needs
  // none, or there is none. Libraries that the program opens itself (dlopen) do not count. Libraries of the system are
  // looked up in the folders that ld.so.conf names, in their order, instead of in its cache.
  std::string library_of(const std::string& program, const std::string& name, const Variables& environment);

  // Files that were read are kept, and mapped: do not keep this for long, or a file that is written anew ends the
  // process (SIGBUS). Null if it is none of ELF.
  const ElfFile* file(const std::string& path);

 private:
  struct Loaded {
    std::string path;
    const ElfFile* file;
    int loader;  // the number of what needed it first; -1: nobody
  };

  std::string find(const std::string& name, const std::vector<Loaded>& loaded, int needer, const std::string& given);
  std::string find_in(const std::string& folders, const std::string& name, const Loaded& origin);

  std::map<std::string, std::unique_ptr<ElfFile>> files_;
};

}  // namespace tracing
