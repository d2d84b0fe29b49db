#include "bench/run/result_file.hpp"

#include <array>
#include <csignal>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

class ResultFile : public tests::InTemporaryFolder {
 protected:
  [[nodiscard]] long entries() const {
    return std::distance(std::filesystem::directory_iterator(folder()), std::filesystem::directory_iterator());
  }
};

/// While it lives, files cannot grow beyond a size: writing fails half way, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(ResultFile, ComesBackAsWritten) {
  const std::string content("a,b\n1,\0\xff\r\n", 10);
  write_file(folder() / "table.csv", content);
  EXPECT_EQ(read_file(folder() / "table.csv"), content);
  EXPECT_EQ(entries(), 1);
}

TEST_F(ResultFile, ReplacesAnOlderOne) {
  write_file(folder() / "table.csv", "a long first version\n");
  write_file(folder() / "table.csv", "short\n");
  EXPECT_EQ(read_file(folder() / "table.csv"), "short\n");
  EXPECT_EQ(entries(), 1);
}

TEST_F(ResultFile, OnAFullDiskTheOlderOneStaysAndNothingElse) {
  write_file(folder() / "table.csv", "older\n");
  {
    const FullDisk disk(4096);
    expect_error_naming({"cannot write", "table.csv"},
                        [&] { write_file(folder() / "table.csv", std::string(1 << 20, 'x')); });
  }
  EXPECT_EQ(read_file(folder() / "table.csv"), "older\n");
  EXPECT_EQ(entries(), 1);
}

TEST_F(ResultFile, GrowsByWholeLines) {
  write_file(folder() / "table.csv", "a,b\n");
  append_to_file(folder() / "table.csv", "1,2\n");
  append_to_file(folder() / "table.csv", "3,4\n");
  EXPECT_EQ(read_file(folder() / "table.csv"), "a,b\n1,2\n3,4\n");
  expect_error_naming({"cannot write", "none.csv"}, [&] { append_to_file(folder() / "none.csv", "1,2\n"); });
  EXPECT_EQ(entries(), 1);
}

TEST_F(ResultFile, OnAFullDiskALineIsWrittenWholeOrNotAtAll) {
  write_file(folder() / "table.csv", "a,b\n");
  {
    const FullDisk disk(10);
    expect_error_naming({"cannot write", "table.csv"},
                        [&] { append_to_file(folder() / "table.csv", "a long line,2\n"); });
  }
  EXPECT_EQ(read_file(folder() / "table.csv"), "a,b\n");
}

TEST_F(ResultFile, InAFolderThatIsNotThereIsRefused) {
  expect_error_naming({"cannot write", "table.csv"}, [&] { write_file(folder() / "none" / "table.csv", "a\n"); });
  EXPECT_EQ(entries(), 0);
}

TEST_F(ResultFile, OntoAFolderIsRefusedAndLeavesNothing) {
  std::filesystem::create_directories(folder() / "table.csv" / "inner");
  expect_error_naming({"cannot write", "table.csv"}, [&] { write_file(folder() / "table.csv", "a\n"); });
  EXPECT_EQ(entries(), 1);
}

TEST_F(ResultFile, ThatIsNotThereOrIsAFolderCannotBeRead) {
  expect_error_naming({"cannot read", "none.csv"}, [&] { static_cast<void>(read_file(folder() / "none.csv")); });
  expect_error_naming({"cannot read", folder().string()}, [&] { static_cast<void>(read_file(folder())); });
}

TEST_F(ResultFile, ALinkStaysOneAndItsTargetIsReplaced) {
  write_file(folder() / "table.csv", "older\n");
  std::filesystem::create_symlink("table.csv", folder() / "link.csv");
  write_file(folder() / "link.csv", "newer\n");
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link.csv"));
  EXPECT_EQ(read_file(folder() / "table.csv"), "newer\n");
  EXPECT_EQ(entries(), 2);
}

TEST_F(ResultFile, APipeIsWrittenIntoAndStaysOne) {
  const std::filesystem::path pipe = folder() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_error_naming({"cannot write", "pipe"}, [&] { write_file(pipe, "nobody reads\n"); });
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // NOLINT(*-pro-type-vararg): as POSIX declares it
  write_file(pipe, "some\n");
  std::array<char, 16> read{};
  EXPECT_EQ(::read(reader, read.data(), read.size()), 5);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  ::close(reader);
  EXPECT_EQ(entries(), 1);
}

TEST_F(ResultFile, WhatMightHaveNoEndIsNotRead) {
  const std::filesystem::path pipe = folder() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& endless : {pipe, std::filesystem::path("/dev/zero")}) {
    expect_error_naming({"cannot read", endless.string()}, [&] { static_cast<void>(read_file(endless)); });
  }
  expect_error_naming({"cannot read"}, [&] { static_cast<void>(read_file("/proc/self/mem")); });
}

TEST_F(ResultFile, LeftByAProcessThatIsNoMoreIsRemovedByTheNext) {
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
  const auto named = [&](const std::string& name, pid_t process) {
    std::string written = temporary_name(folder() / name).filename().string();
    return folder() / (written.substr(0, written.rfind('.') + 1) + std::to_string(process));
  };
  for (const char* const name : {"table.csv", "table_part_0.csv", "table.json", "3-of-4.rows"}) {
    write_file(named(name, ended), "");
  }
  write_file(named(named("table_part_0.csv", 1).filename(), ended), "");
  { const OutputFolder next(folder()); }
  EXPECT_EQ(entries(), 0);
  write_file(named("table.csv", ::getppid()), "");                           // somebody is at it
  write_file(folder() / fmt::format(".table.csv.elsewhere.{}", ended), "");  // or on another machine
  write_file(folder() / fmt::format("notes.csv.{}", ended), "");             // not hidden: the user's
  write_file(named("notes", ended), "");
  { const OutputFolder next(folder()); }
  EXPECT_EQ(entries(), 4);
}

TEST_F(ResultFile, OneRunAtATimeHasAName) {
  const std::filesystem::path prefix = folder() / "table";
  {
    const ResultLock first(prefix);
    const ResultLock another(folder() / "another");
    expect_error_naming({"another run", "table"}, [&] { const ResultLock second(prefix); });
  }
  EXPECT_EQ(entries(), 0);
  const ResultLock again(prefix);
}

TEST_F(ResultFile, ThatCannotBeWrittenIsNoticedBeforehand) {
  require_writable(folder() / "table.csv");
  EXPECT_EQ(entries(), 0);
  const std::string long_name(300, 'x');
  for (const std::filesystem::path& path : {folder(), folder() / "none" / "table.csv", folder() / long_name}) {
    expect_error_naming({"cannot write", path.string()}, [&] { require_writable(path); });
  }
}

TEST_F(ResultFile, FoldersAreMadeWithTheirParentsAndGoWhereNothingIsWritten) {
  const std::filesystem::path inner = folder() / "a" / "b";
  {
    const OutputFolder first(inner);
    const OutputFolder second(inner);
    EXPECT_TRUE(std::filesystem::is_directory(inner));
  }
  EXPECT_EQ(entries(), 0);
  {
    const OutputFolder used(inner);
    write_file(inner / "table.csv", "a\n");
  }
  EXPECT_TRUE(std::filesystem::exists(inner / "table.csv"));
  std::filesystem::remove(inner / "table.csv");
  { const OutputFolder found(inner); }
  EXPECT_TRUE(std::filesystem::is_directory(inner)) << "it was there before";
}

TEST_F(ResultFile, ALinkThatLeadsNowhereStaysOne) {
  std::filesystem::create_symlink("nowhere", folder() / "link");
  expect_error_naming({"cannot create", "link"}, [&] { const OutputFolder none(folder() / "link"); });
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link"));
}

TEST_F(ResultFile, NoFolderIsLeftWhereNotAllCanBeMade) {
  expect_error_naming({"cannot create"}, [&] { const OutputFolder none(folder() / "a" / std::string(300, 'x')); });
  EXPECT_EQ(entries(), 0);
}

TEST_F(ResultFile, AFileInTheWayOfAFolderIsNamed) {
  write_file(folder() / "results", "");
  expect_error_naming({"results"}, [&] { const OutputFolder none(folder() / "results"); });
  expect_error_naming({"inner"}, [&] { const OutputFolder none(folder() / "results" / "inner"); });
}

}  // namespace
}  // namespace dmocbench
