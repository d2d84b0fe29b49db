#include "bench/experiment/result_file.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

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
  FullDisk(FullDisk&&) = delete;
  FullDisk& operator=(FullDisk&&) = delete;
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

TEST_F(ResultFile, FoldersAreMadeWithTheirParents) {
  prepare_folder(folder() / "a" / "b");
  prepare_folder(folder() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder() / "a" / "b"));
}

TEST_F(ResultFile, AFileInTheWayOfAFolderIsNamed) {
  write_file(folder() / "results", "");
  expect_error_naming({"results"}, [&] { prepare_folder(folder() / "results"); });
  expect_error_naming({"inner"}, [&] { prepare_folder(folder() / "results" / "inner"); });
}

}  // namespace
}  // namespace dmocbench
