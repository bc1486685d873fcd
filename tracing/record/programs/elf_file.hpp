// SPDX-License-Identifier: Apache-2.0
// A program or a shared library, as the dynamic linker sees it (elf(5)).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tracing {

// Files of 64 bits in the byte order of this machine; of others only the header is read. The file is mapped, so what is
// not looked at costs nothing. Damaged files have less of everything.
class ElfFile {
 public:
  // Nothing if the file cannot be read or is none of ELF.
  static std::optional<ElfFile> read(const std::string& path);
  ElfFile(ElfFile&& other) noexcept;
  ElfFile& operator=(ElfFile&&) = delete;
  ~ElfFile();

  bool is_foreign = false;    // not of 64 bits, or of another byte order
  std::uint16_t machine = 0;  // EM_X86_64
  bool is_dynamic = false;    // has a section for the dynamic linker
  std::vector<std::string> needed = {};
  std::optional<std::string> rpath = {};  // as they are written, with $ORIGIN
  std::optional<std::string> runpath = {};

  // The functions and objects that the file offers to others; of the other table, those of a program that were not
  // stripped.
  std::set<std::string> exported_symbols() const;
  bool defines(std::string_view symbol) const;
  // Whether the bytes are anywhere in the file.
  bool contains(std::string_view text) const;

 private:
  ElfFile(const char* bytes, std::size_t size) : bytes_(bytes, size) {}
  template <typename Value>
  std::optional<Value> value_at(std::uint64_t place) const;
  std::string text_at(std::uint64_t place) const;
  void read_header();
  void read_dynamic_section();
  // Calls `use(name, value, type)` for each symbol that the file defines, in the tables of one type.
  template <typename Use>
  void for_each_symbol(std::uint32_t table_type, Use use) const;

  std::string_view bytes_;
};

}  // namespace tracing
