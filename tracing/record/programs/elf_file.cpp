// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/programs/elf_file.hpp"

#include <elf.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <utility>

#include "base/files/unique_fd.hpp"

namespace tracing {
namespace {

constexpr unsigned char kByteOrder = std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;

}  // namespace

std::optional<ElfFile> ElfFile::read(const std::string& path) {
  const launch::UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<std::uint64_t>(status.st_size) < sizeof(Elf64_Ehdr)) {
    return std::nullopt;
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (memory == MAP_FAILED) {
    return std::nullopt;
  }
  ElfFile elf(static_cast<const char*>(memory), size);
  if (elf.bytes_.substr(0, SELFMAG) != std::string_view(ELFMAG, SELFMAG)) {
    return std::nullopt;
  }
  elf.read_header();
  return elf;
}

ElfFile::ElfFile(ElfFile&& other) noexcept
    : is_foreign(other.is_foreign),
      machine(other.machine),
      is_dynamic(other.is_dynamic),
      needed(std::move(other.needed)),
      rpath(std::move(other.rpath)),
      runpath(std::move(other.runpath)),
      bytes_(std::exchange(other.bytes_, {})) {}

ElfFile::~ElfFile() {
  if (!bytes_.empty()) {
    ::munmap(const_cast<char*>(bytes_.data()), bytes_.size());
  }
}

template <typename Value>
std::optional<Value> ElfFile::value_at(std::uint64_t place) const {
  if (place > bytes_.size() || bytes_.size() - place < sizeof(Value)) {
    return std::nullopt;
  }
  Value value;
  std::memcpy(&value, bytes_.data() + place, sizeof value);
  return value;
}

std::string ElfFile::text_at(std::uint64_t place) const {
  if (place >= bytes_.size()) {
    return {};
  }
  const std::string_view rest = bytes_.substr(place);
  return std::string(rest.substr(0, rest.find('\0')));
}

void ElfFile::read_header() {
  const Elf64_Ehdr header = *value_at<Elf64_Ehdr>(0);
  machine = header.e_machine;
  is_foreign = header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != kByteOrder;
  if (!is_foreign) {
    read_dynamic_section();
  }
}

void ElfFile::read_dynamic_section() {
  const Elf64_Ehdr header = *value_at<Elf64_Ehdr>(0);
  std::vector<Elf64_Phdr> loaded;
  std::optional<Elf64_Phdr> dynamic;
  for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
    const auto segment = value_at<Elf64_Phdr>(header.e_phoff + i * sizeof(Elf64_Phdr));
    if (!segment) {
      return;
    }
    if (segment->p_type == PT_LOAD) {
      loaded.push_back(*segment);
    } else if (segment->p_type == PT_DYNAMIC) {
      dynamic = segment;
    }
  }
  if (!dynamic) {
    return;
  }
  is_dynamic = true;
  std::vector<Elf64_Dyn> texts;
  std::uint64_t strings = 0;
  for (std::uint64_t i = 0; i < dynamic->p_filesz / sizeof(Elf64_Dyn); ++i) {
    const auto entry = value_at<Elf64_Dyn>(dynamic->p_offset + i * sizeof(Elf64_Dyn));
    if (!entry || entry->d_tag == DT_NULL) {
      break;
    }
    if (entry->d_tag == DT_STRTAB) {
      strings = entry->d_un.d_ptr;
    } else {
      texts.push_back(*entry);
    }
  }
  // The table is given by its address in memory.
  const auto segment = std::find_if(loaded.begin(), loaded.end(), [&](const Elf64_Phdr& each) {
    return strings >= each.p_vaddr && strings - each.p_vaddr < each.p_filesz;
  });
  if (segment == loaded.end()) {
    return;
  }
  const std::uint64_t table = strings - segment->p_vaddr + segment->p_offset;
  for (const Elf64_Dyn& entry : texts) {
    if (entry.d_tag == DT_NEEDED) {
      needed.push_back(text_at(table + entry.d_un.d_val));
    } else if (entry.d_tag == DT_RPATH) {
      rpath = text_at(table + entry.d_un.d_val);
    } else if (entry.d_tag == DT_RUNPATH) {
      runpath = text_at(table + entry.d_un.d_val);
    }
  }
}

template <typename Use>
void ElfFile::for_each_symbol(std::uint32_t table_type, Use use) const {
  const auto header = value_at<Elf64_Ehdr>(0);
  if (is_foreign || !header) {
    return;
  }
  const auto section_at = [&](std::uint64_t i) {
    return value_at<Elf64_Shdr>(header->e_shoff + i * sizeof(Elf64_Shdr));
  };
  for (std::uint64_t i = 0; i < header->e_shnum; ++i) {
    const auto table = section_at(i);
    const auto strings = table && table->sh_type == table_type ? section_at(table->sh_link) : std::nullopt;
    for (std::uint64_t j = 0; strings && j < table->sh_size / sizeof(Elf64_Sym); ++j) {
      const auto symbol = value_at<Elf64_Sym>(table->sh_offset + j * sizeof(Elf64_Sym));
      if (!symbol) {
        break;
      }
      if (symbol->st_shndx != SHN_UNDEF && ELF64_ST_BIND(symbol->st_info) != STB_LOCAL) {
        use(text_at(strings->sh_offset + symbol->st_name));
      }
    }
  }
}

std::set<std::string> ElfFile::exported_symbols() const {
  std::set<std::string> names;
  for_each_symbol(SHT_DYNSYM, [&](std::string name) { names.insert(std::move(name)); });
  return names;
}

bool ElfFile::defines(std::string_view wanted) const {
  bool found = false;
  for (const std::uint32_t table : {SHT_DYNSYM, SHT_SYMTAB}) {
    for_each_symbol(table, [&](const std::string& name) { found = found || name == wanted; });
  }
  return found;
}

bool ElfFile::contains(std::string_view text) const {
  return std::search(bytes_.begin(), bytes_.end(), std::boyer_moore_horspool_searcher(text.begin(), text.end())) !=
         bytes_.end();
}

}  // namespace tracing
