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

/// False, with errno set, if not all could be written.
bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// An open file that is closed, and removed unless kept, at the end of its scope.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path path)
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): open is one
      : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!kept_) ::unlink(path_.c_str());
  }

  /// False, with errno set, if anything went wrong.
  [[nodiscard]] bool write(std::string_view content) const {
    // A full disk may show itself only when the content is forced out.
    return descriptor_ >= 0 && write_all(descriptor_, content) && ::fsync(descriptor_) == 0;
  }

  [[nodiscard]] bool rename_to(const std::filesystem::path& target) {
    kept_ = ::rename(path_.c_str(), target.c_str()) == 0;
    return kept_;
  }

 private:
  std::filesystem::path path_;
  int descriptor_;
  bool kept_ = false;
};

std::string reason() { return std::strerror(errno); }  // NOLINT(concurrency-mt-unsafe): one thread writes

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
  TemporaryFile file(path.parent_path() / fmt::format(".{}.{}", path.filename().string(), ::getpid()));
  if (!file.write(content) || !file.rename_to(path)) {
    throw Error(fmt::format("cannot write {}: {}", path.string(), reason()));
  }
}

void append_to_file(const std::filesystem::path& path, std::string_view line) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): open is one
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  const bool is_whole = descriptor >= 0 && write_all(descriptor, line);
  const std::string failure = is_whole ? "" : reason();
  if (descriptor >= 0) ::close(descriptor);
  if (is_whole) return;
  if (descriptor >= 0) std::filesystem::resize_file(path, size, ignored);
  throw Error(fmt::format("cannot write {}: {}", path.string(), failure));
}

std::string read_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw Error(fmt::format("cannot read {}: it is a folder", path.string()));
  std::ifstream stream(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw Error(fmt::format("cannot read {}", path.string()));
  return content;
}

}  // namespace dmocbench
