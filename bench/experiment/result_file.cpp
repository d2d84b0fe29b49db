#include "bench/experiment/result_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// A descriptor; negative, with errno set, if the file cannot be opened.
int open_to_write(const std::filesystem::path& path, int flags) {
  constexpr mode_t mode = 0644;
  return ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, mode);  // NOLINT(cppcoreguidelines-pro-type-vararg)
}

/// False, with errno set, if not all could be written or the file is not open.
bool write_all(int descriptor, std::string_view content) {
  if (descriptor < 0) return false;
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string reason() { return std::strerror(errno); }  // NOLINT(concurrency-mt-unsafe): one thread writes

/// Closes a file. If it is not whole, calls `undo` and throws an error with the reason in errno.
void close_or_undo(int descriptor, bool is_whole, const std::filesystem::path& path, const auto& undo) {
  const std::string failure = is_whole ? "" : reason();
  if (descriptor >= 0) ::close(descriptor);
  if (is_whole) return;
  undo();
  throw Error(fmt::format("cannot write {}: {}", path.string(), failure));
}

}  // namespace

void prepare_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw Error(fmt::format("cannot make the output folder {}: {}", folder.string(),
                            error ? error.message() : "a file of that name is in the way"));
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw Error(fmt::format("cannot write to the output folder {}: {}", folder.string(), reason()));
  }
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  const std::filesystem::path temporary =
      path.parent_path() / fmt::format(".{}.{}", path.filename().string(), ::getpid());
  const int descriptor = open_to_write(temporary, O_CREAT | O_TRUNC);
  // A full disk may show itself only when the content is forced out.
  const bool is_whole =
      write_all(descriptor, content) && ::fsync(descriptor) == 0 && ::rename(temporary.c_str(), path.c_str()) == 0;
  close_or_undo(descriptor, is_whole, path, [&] { ::unlink(temporary.c_str()); });
}

void append_to_file(const std::filesystem::path& path, std::string_view line) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  const int descriptor = open_to_write(path, O_APPEND);
  close_or_undo(descriptor, write_all(descriptor, line), path,
                [&] { std::filesystem::resize_file(path, size, ignored); });
}

std::string read_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw Error(fmt::format("cannot read {}: it is a folder", path.string()));
  std::ifstream stream(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw Error(fmt::format("cannot read {}", path.string()));
  return content;
}

}  // namespace dmocbench
