#include "dspm/session/modules/elf_section.h"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace dspm {
namespace {

#if defined(__x86_64__)
constexpr int kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr int kMachine = EM_AARCH64;
#endif

/// Refuses to read beyond the end of the file.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (!in_ || error) throw std::runtime_error("it cannot be read");
  }

  std::string bytes(std::uint64_t offset, std::uint64_t count) {
    if (offset > size_ || count > size_ - offset) throw std::runtime_error("it is truncated or damaged");
    std::string result(count, '\0');
    in_.seekg(static_cast<std::streamoff>(offset));
    if (!in_.read(result.data(), static_cast<std::streamsize>(count))) throw std::runtime_error("it cannot be read");
    return result;
  }

  template <class T>
  T at(std::uint64_t offset) {
    T value;
    std::memcpy(&value, bytes(offset, sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::uint64_t size() const { return size_; }

 private:
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

Elf64_Ehdr read_header(ElfFile& file) {
  constexpr const char* kWrong = "it is not a shared library";
  if (file.size() < sizeof(Elf64_Ehdr)) throw std::runtime_error(kWrong);
  const auto header = file.at<Elf64_Ehdr>(0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_type != ET_DYN) throw std::runtime_error(kWrong);
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_machine != kMachine)
    throw std::runtime_error("it is a shared library for another kind of machine");
  if (header.e_shentsize != sizeof(Elf64_Shdr)) throw std::runtime_error("it has no section headers");
  return header;
}

}  // namespace

std::optional<std::string> elf_section(const std::filesystem::path& path, std::string_view name) {
  ElfFile file(path);
  const Elf64_Ehdr header = read_header(file);
  const auto section = [&](std::uint64_t i) { return file.at<Elf64_Shdr>(header.e_shoff + i * sizeof(Elf64_Shdr)); };
  const Elf64_Shdr names = section(header.e_shstrndx);
  const std::string all_names = file.bytes(names.sh_offset, names.sh_size);
  for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
    const Elf64_Shdr found = section(i);
    if (found.sh_name >= all_names.size() || found.sh_type == SHT_NOBITS) continue;
    if (std::string_view(all_names.c_str() + found.sh_name) == name) return file.bytes(found.sh_offset, found.sh_size);
  }
  return std::nullopt;
}

}  // namespace dspm
