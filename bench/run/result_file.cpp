#include "bench/run/result_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

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
  throw Error("cannot write {}: {}", path.string(), failure);
}

/// True if both are the same file.
bool is_same(const std::filesystem::path& path, int descriptor) {
  struct stat named {};
  struct stat open {};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 && named.st_dev == open.st_dev &&
         named.st_ino == open.st_ino;
}

/// True if a file at this path would be written into, not replaced.
bool is_special(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_other(path, ignored) || is_same(path, STDOUT_FILENO);
}

void write_into(const std::filesystem::path& path, std::string_view content) {
  std::fflush(stdout);  // earlier output comes first
  const bool is_own_output = is_same(path, STDOUT_FILENO);
  const int descriptor = is_own_output ? ::dup(STDOUT_FILENO) : open_to_write(path, O_NONBLOCK);
  // A pipe without a reader was not waited for; one with a reader is.
  if (!is_own_output && descriptor >= 0) ::fcntl(descriptor, F_SETFL, 0);  // NOLINT(*-pro-type-vararg): POSIX
  close_or_undo(descriptor, write_all(descriptor, content), path, [] {});
}

/// Removes ".NAME.csv.HOST.123" and the like where process 123 of this machine has ended.
void remove_leftovers(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    std::filesystem::path name = entry.path().filename();
    const auto number = [&name] {
      const bool is_of_this_host = name.stem().extension() == "." + host_name();
      return is_of_this_host ? parsed<pid_t>(name.extension().string().erase(0, 1)) : std::nullopt;
    };
    const pid_t process = number().value_or(0);
    while (number()) name = name.stem().stem();  // a process may have been rewriting another's leftover
    const std::string kind = name.extension().string();
    if (!name.string().starts_with('.') || (kind != ".csv" && kind != ".json" && kind != ".md" && kind != ".rows"))
      continue;
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace

// Delegates to the other constructor, so that created folders are removed also if this one throws.
OutputFolder::OutputFolder(const std::filesystem::path& folder, bool leftovers_stay) : OutputFolder() {
  std::error_code error;
  const auto is_missing = [](const std::filesystem::path& part) {  // a link that leads nowhere is not
    std::error_code none;
    return std::filesystem::symlink_status(part, none).type() == std::filesystem::file_type::not_found;
  };
  for (auto part = std::filesystem::absolute(folder, error); !error && is_missing(part); part = part.parent_path()) {
    made_.push_back(part);
  }
  error.clear();
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw Error("cannot create the output folder {}: {}", folder.string(),
                error ? error.message() : "a file with this name exists");
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw Error("cannot write to the output folder {}: {}", folder.string(), reason());
  }
  if (!leftovers_stay) remove_leftovers(folder);
}

OutputFolder::~OutputFolder() {
  std::error_code none;  // one that holds something stays
  for (const std::filesystem::path& folder : made_) std::filesystem::remove(folder, none);
}

void require_name_of_table(const std::string& name) {
  constexpr std::size_t longest = 100;  // since names of files begin with it
  const auto does_not_fit = [](unsigned char letter) { return letter == '/' || std::iscntrl(letter) != 0; };
  if (name.empty() || name.starts_with('.') || name.starts_with('-') || std::ranges::any_of(name, does_not_fit)) {
    throw Error(
        "--name \"{}\" must be a plain file name that does not begin with a dot or a dash; --out names the folder",
        name);
  }
  if (name.size() > longest) {
    throw Error("--name takes at most {} characters, not {}", longest, name.size());
  }
}

const std::string& host_name() {
  static const std::string name = [] {
    std::array<char, 64> letters{};
    ::gethostname(letters.data(), letters.size() - 1);
    std::string text = letters.data();
    std::ranges::replace_if(
        text, [](unsigned char letter) { return std::isalnum(letter) == 0 && letter != '-'; }, '-');
    return text.empty() ? std::string("host") : text;
  }();
  return name;
}

std::filesystem::path temporary_name(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".{}.{}.{}", file.filename().string(), host_name(), ::getpid());
}

void require_writable(const std::filesystem::path& path) {
  std::error_code none;  // a failed lookup shows when the file is written
  if (std::filesystem::is_directory(path, none)) {
    throw Error("cannot write {}: it is a folder; name a file in it", path.string());
  }
  if (is_special(path)) return;
  const std::filesystem::path probe = temporary_name(path);
  const int descriptor = open_to_write(probe, O_CREAT);
  close_or_undo(descriptor, descriptor >= 0, path, [] {});
  ::unlink(probe.c_str());
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  if (is_special(path)) return write_into(path, content);
  std::error_code ignored;
  const bool is_link = std::filesystem::is_symlink(path, ignored);
  const std::filesystem::path target = is_link ? std::filesystem::weakly_canonical(path, ignored) : path;
  const std::filesystem::path temporary = temporary_name(target);
  const int descriptor = open_to_write(temporary, O_CREAT | O_TRUNC);
  // A full disk may show itself only when the content is forced out.
  const bool is_whole =
      write_all(descriptor, content) && ::fsync(descriptor) == 0 && ::rename(temporary.c_str(), target.c_str()) == 0;
  close_or_undo(descriptor, is_whole, target, [&] { ::unlink(temporary.c_str()); });
}

void append_to_file(const std::filesystem::path& path, std::string_view line) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  const int descriptor = open_to_write(path, O_APPEND);
  close_or_undo(descriptor, write_all(descriptor, line), path,
                [&] { std::filesystem::resize_file(path, size, ignored); });
}

void force_to_disk(const std::filesystem::path& path) {
  const int descriptor = open_to_write(path, O_APPEND);
  close_or_undo(descriptor, descriptor >= 0 && ::fsync(descriptor) == 0, path, [] {});
}

std::uint32_t crc_32(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

std::string checksum_of(std::string_view text) { return fmt::format("{:08x}", crc_32(text)); }

ResultLock::ResultLock(const std::filesystem::path& prefix)
    : file_(prefix.parent_path() / fmt::format(".{}.lock", prefix.filename().string())) {
  // Another run removes its file when it ends; who was given that one by then has to ask for the new one.
  while (descriptor_ < 0 || !is_same(file_, descriptor_)) {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = open_to_write(file_, O_CREAT);
    if (descriptor_ < 0) throw Error("cannot write {}: {}", file_.string(), reason());
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) continue;
    ::close(descriptor_);
    throw Error("another run is writing {} now; wait until it ends, or choose another --name or --out",
                prefix.string());
  }
}

ResultLock::~ResultLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace dmocbench
