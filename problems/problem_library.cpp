#include "problems/problem_library.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>

#include <dlfcn.h>
#include <elf.h>

#include "methods/error.hpp"
#include "problems/build_tag.hpp"

namespace dmocbench {

namespace {

constexpr std::string_view begin_of_tags = "dmocbench problems: ";

std::string content_of(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) {
    throw Error("there is no library {}", file.string());
  }
  std::ifstream stream(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw Error("cannot read the library {}", file.string());
  return content;
}

/// Throws `Error` unless the content is a whole shared library: the system would notice too late that a file was cut
/// short, when it reads beyond its end.
void require_whole(const std::filesystem::path& file, std::string_view content) {
  Elf64_Ehdr header{};
  if (!content.starts_with(ELFMAG) || content.size() < sizeof header) {
    throw Error("{} is not a shared library", file.string());
  }
  std::memcpy(&header, content.data(), sizeof header);
  const std::uint64_t end = header.e_shoff + std::uint64_t{header.e_shentsize} * header.e_shnum;  // of the last part
  if (header.e_ident[EI_CLASS] == ELFCLASS64 && end > content.size()) {
    throw Error("{} is truncated; build it again", file.string());
  }
}

/// The tag in the content of a library, which ends it by a zero.
std::string_view tag_in(const std::filesystem::path& file, std::string_view content) {
  const std::size_t begin = content.find(begin_of_tags);
  if (begin == std::string_view::npos) {
    throw Error("{} contains no problems; build it with dmocbench_add_problems in CMake", file.string());
  }
  const std::size_t end = std::min(content.find('\0', begin), content.size());
  return content.substr(begin, end - begin);
}

/// Takes "name=value" off the front of a tag.
std::string_view take_entry(std::string_view& tag) {
  const std::size_t end = std::min(tag.find(';'), tag.size());
  const std::string_view entry = tag.substr(0, end);
  tag.remove_prefix(std::min(end + 1, tag.size()));
  return entry;
}

/// The error message of `dlopen` or `dlsym`.
std::string reason_of_loader() {
  const char* const reason = ::dlerror();  // NOLINT(concurrency-mt-unsafe): glibc's belongs to the thread
  return reason == nullptr ? "no reason was reported" : reason;
}

using AddProblems = void (*)(Registry&);

/// Lets libraries find the functions that they call also in a module that a program, such as Python, has loaded for
/// itself alone.
void offer_own_functions() {
  Dl_info own{};
  if (::dladdr(reinterpret_cast<const void*>(&tag_of_this_build), &own) == 0) return;  // NOLINT(*-reinterpret-cast)
  ::dlopen(own.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL);  // null of a program, which offers them anyway
}

AddProblems entry_of(const std::filesystem::path& file) {
  offer_own_functions();
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw Error("the library cannot be loaded: {}", reason_of_loader());
  void* const entry = ::dlsym(library, "dmocbench_add_problems_to");
  if (entry == nullptr) throw Error("{} does not add its problems: {}", file.string(), reason_of_loader());
  return reinterpret_cast<AddProblems>(entry);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast): as POSIX has it
}

}  // namespace

std::string_view tag_of_this_build() noexcept { return DMOCBENCH_BUILD_TAG; }

void require_same_build(const std::string& who, std::string_view tag) {
  std::string_view wanted = tag_of_this_build();
  if (tag == wanted) return;
  tag.remove_prefix(std::min(begin_of_tags.size(), tag.size()));
  wanted.remove_prefix(begin_of_tags.size());
  std::string_view its_entry;
  std::string_view our_entry;
  while (its_entry == our_entry && !(tag.empty() && wanted.empty())) {
    its_entry = take_entry(tag);
    our_entry = take_entry(wanted);
  }
  throw Error("{} was built for another build of dmocbench: {}, here {}; build it again with this one", who,
              its_entry.empty() ? "nothing" : its_entry, our_entry.empty() ? "nothing" : our_entry);
}

void load_problem_library(const std::filesystem::path& file, Registry& registry) {
  const std::string content = content_of(file);
  const std::filesystem::path path = std::filesystem::canonical(file);
  require_whole(path, content);
  require_same_build(path.string(), tag_in(path, content));
  Registry problems(Registry::Faults::kept);
  try {
    entry_of(path)(problems);
  } catch (const std::exception& error) {
    throw Error("a problem in {} cannot be constructed: {}", path.string(), error.what());
  } catch (...) {
    throw Error("a problem in {} cannot be constructed: it threw an object that is not a std::exception",
                path.string());
  }
  const std::size_t known = registry.names().size();
  const std::size_t refused = registry.refused().size();
  registry.add_all(problems, path.string());
  if (registry.names().size() > known) return;
  if (registry.refused().size() > refused) throw Error(registry.refused()[refused].reason);
  throw Error("{} contains no problems", path.string());
}

}  // namespace dmocbench
