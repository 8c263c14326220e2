// SPDX-License-Identifier: AGPL-3.0-or-later
// Outputs that are no plain files: links, devices, pipes. Devices are nodes of our own, never those under /dev.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "base/output.h"
#include "support/temporary_folder.h"

namespace geomend {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::TemporaryFolder;
using test::write_file;

Result<void> write_output(const fs::path& path, std::string_view text, const Monitor* monitor = nullptr) {
    OutputSet set(path);
    set.main_file() << text;
    return set.commit(monitor);
}

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// A node of a device of memory: 3 takes everything, 7 is always full. False where this process may not make it or use it.
bool make_device(const fs::path& path, unsigned minor) {
    if (::mknod(path.c_str(), S_IFCHR | 0666, makedev(1, minor)) != 0) return false;
    const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd >= 0) ::close(fd);
    return fd >= 0;
}

std::string read_pipe(const fs::path& path, std::size_t most = static_cast<std::size_t>(-1)) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    std::string text;
    char block[4096];
    for (ssize_t got = 0; text.size() < most && (got = ::read(fd, block, sizeof block)) > 0;)
        text.append(block, static_cast<std::size_t>(got));
    ::close(fd);
    return text;
}

TEST(OutputPlaces, ADeviceIsWrittenIntoAndStaysADevice) {
    const TemporaryFolder folder;
    if (!make_device(folder / "null.ts", 3)) GTEST_SKIP() << "device nodes cannot be made here";
    EXPECT_TRUE(write_output(folder / "null.ts", "text"));
    EXPECT_EQ(fs::status(folder / "null.ts").type(), fs::file_type::character);
    fs::create_symlink("null.ts", folder / "link.ts");
    EXPECT_TRUE(write_output(folder / "link.ts", "text"));
    EXPECT_EQ(fs::status(folder / "null.ts").type(), fs::file_type::character);
    EXPECT_TRUE(fs::is_symlink(folder / "link.ts"));
    EXPECT_EQ(entries(folder.path()), 2u);
}

TEST(OutputPlaces, ADeviceThatIsFullIsAFailureThatNamesIt) {
    const TemporaryFolder folder;
    if (!make_device(folder / "full", 7)) GTEST_SKIP() << "device nodes cannot be made here";
    const auto written = write_output(folder / "full", "text");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.why().kind, FailureKind::unwritable);
    EXPECT_EQ(written.why().error.code, "F020");
    EXPECT_EQ(written.why().error.where.file, (folder / "full").string());
    EXPECT_EQ(fs::status(folder / "full").type(), fs::file_type::character);
}

TEST(OutputPlaces, CompanionsAreAsTheyWereWhereTheDeviceIsFull) {
    const TemporaryFolder folder;
    if (!make_device(folder / "full", 7)) GTEST_SKIP() << "device nodes cannot be made here";
    write_file(folder / "old", "old");
    {
        OutputSet set(folder / "main");
        set.main_file() << "main";
        set.companion("old") << "new";
        set.companion("full") << "text";
        EXPECT_FALSE(set.commit());
    }
    EXPECT_EQ(read_file(folder / "old"), "old");
    EXPECT_EQ(entries(folder.path()), 2u) << "nothing but the device and the old file";
}

TEST(OutputPlaces, ADeviceAndAPipeHaveNoPlaceForCompanions) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_symlink("pipe", folder / "link");
    EXPECT_TRUE(OutputSet("-").is_stream());
    EXPECT_TRUE(OutputSet(folder / "pipe").is_stream());
    EXPECT_TRUE(OutputSet(folder / "link").is_stream());
    EXPECT_FALSE(OutputSet(folder / "none").is_stream());
    EXPECT_EQ(OutputSet(folder / "pipe").stem(), "");
    EXPECT_EQ(OutputSet(folder / "a.ts.gz").stem(), "a");
}

TEST(OutputPlaces, APipeIsWrittenIntoForItsReader) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const std::string text(1'000'000, 'x');
    std::string seen;
    std::jthread reader([&] { seen = read_pipe(folder / "pipe"); });
    EXPECT_TRUE(write_output(folder / "pipe", text));
    reader.join();
    EXPECT_TRUE(seen == text);
    EXPECT_EQ(fs::status(folder / "pipe").type(), fs::file_type::fifo);
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(OutputPlaces, AReaderThatGoesIsAFailureAndNoSignal) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::jthread reader([&] { read_pipe(folder / "pipe", 1); });
    const auto written = write_output(folder / "pipe", std::string(1'000'000, 'x'));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.why().kind, FailureKind::unwritable);
}

TEST(OutputPlaces, WaitingForAReaderEndsWhenStopped) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::atomic<bool> stop{false};
    const Monitor monitor{&stop, {}};
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        stop = true;
    });
    const auto written = write_output(folder / "pipe", "text", &monitor);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.why().kind, FailureKind::cancelled);
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(OutputPlaces, LinksAreFollowedToTheirEndAndStay) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "far");
    write_file(folder / "far/target", "old");
    fs::create_symlink("far/two", folder / "one");
    fs::create_symlink("target", folder / "far/two");
    ASSERT_TRUE(write_output(folder / "one", "new"));
    EXPECT_EQ(read_file(folder / "far/target"), "new");
    EXPECT_TRUE(fs::is_symlink(folder / "one"));
    EXPECT_TRUE(fs::is_symlink(folder / "far/two"));
    EXPECT_FALSE(fs::is_symlink(folder / "far/target"));
    EXPECT_EQ(entries(folder / "far"), 2u);
}

TEST(OutputPlaces, ALinkToNothingMakesItsTarget) {
    const TemporaryFolder folder;
    fs::create_symlink("target", folder / "link");
    ASSERT_TRUE(write_output(folder / "link", "new"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(folder / "target"), "new");
}

TEST(OutputPlaces, LinksToAFolderOrInARingAreRefused) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "folder");
    fs::create_symlink("folder", folder / "link");
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    EXPECT_FALSE(write_output(folder / "link", "x"));
    EXPECT_FALSE(write_output(folder / "a", "x"));
    EXPECT_TRUE(fs::is_symlink(folder / "a"));
    EXPECT_EQ(entries(folder / "folder"), 0u);
}

TEST(OutputPlaces, CompanionsThatAreLinksAreFollowedToo) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "disk");
    fs::create_directory_symlink("disk", folder / "parts");
    fs::create_symlink("disk/data", folder / "data");
    OutputSet set(folder / "main");
    set.main_file() << "main";
    set.companion("parts/0") << "piece";
    set.companion("data") << "values";
    ASSERT_TRUE(set.commit());
    EXPECT_EQ(read_file(folder / "disk/0"), "piece");
    EXPECT_EQ(read_file(folder / "disk/data"), "values");
    EXPECT_TRUE(fs::is_symlink(folder / "data"));
}

TEST(OutputPlaces, AFileThatIsReplacedKeepsItsPermissionsAndOwner) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    ASSERT_EQ(::chmod((folder / "a").c_str(), 0640), 0);
    const bool root = ::chown((folder / "a").c_str(), 12345, 54321) == 0;
    ASSERT_TRUE(write_output(folder / "a", "new"));
    struct stat about {};
    ASSERT_EQ(::stat((folder / "a").c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 07777, 0640u);
    EXPECT_EQ(read_file(folder / "a"), "new");
    if (root) {
        EXPECT_EQ(about.st_uid, 12345u);
        EXPECT_EQ(about.st_gid, 54321u);
    }
}

TEST(OutputPlaces, ANewFileHasThePermissionsThatTheUserGivesNewFiles) {
    const TemporaryFolder folder;
    const mode_t before = ::umask(027);
    const auto written = write_output(folder / "a", "new");
    ::umask(before);
    ASSERT_TRUE(written);
    EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0640));
}

TEST(OutputPlaces, AReadOnlyFolderIsRefused) {
    constexpr uid_t nobody = 65534;
    const TemporaryFolder folder;
    const bool root = ::geteuid() == 0;  // root may write everywhere
    if (root) {
        ASSERT_EQ(::chown(folder.path().c_str(), nobody, nobody), 0);
    }
    if (root) {
        ASSERT_EQ(::seteuid(nobody), 0);
    }
    fs::create_directory(folder / "closed");
    ::chmod((folder / "closed").c_str(), 0500);
    write_file(folder / "kept", "old");
    ::chmod((folder / "kept").c_str(), 0400);
    const bool into_closed = write_output(folder / "closed/a", "x").ok(), over_kept = write_output(folder / "kept", "x").ok();
    if (root) {
        ASSERT_EQ(::seteuid(0), 0);
    }
    EXPECT_FALSE(into_closed);
    EXPECT_FALSE(over_kept) << "a file that may not be written is not replaced either";
    EXPECT_EQ(read_file(folder / "kept"), "old");
    EXPECT_EQ(entries(folder.path()), 2u);
}

TEST(OutputPlaces, ADescriptorIsWrittenWhereItStands) {
    const TemporaryFolder folder;
    const int fd = ::open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    ASSERT_GE(fd, 0);
    ASSERT_TRUE(write_output("/dev/fd/" + std::to_string(fd), "one,"));
    ASSERT_TRUE(write_output("/proc/self/fd/" + std::to_string(fd), "two"));
    ::close(fd);
    EXPECT_EQ(read_file(folder / "log"), "one,two");
}

TEST(OutputPlaces, ANameAsLongAsNamesMayBeIsWritten) {
    const TemporaryFolder folder;
    const std::string name(255, 'n');
    ASSERT_TRUE(write_output(folder / name, "x"));
    EXPECT_EQ(read_file(folder / name), "x");
}

TEST(OutputPlaces, WhatBecameAPipeMeanwhileIsNotReplaced) {
    const TemporaryFolder folder;
    OutputSet set(folder / "a");
    set.main_file() << "x";
    ASSERT_EQ(::mkfifo((folder / "a").c_str(), 0600), 0);
    EXPECT_FALSE(set.commit());
    EXPECT_EQ(fs::status(folder / "a").type(), fs::file_type::fifo);
}

}  // namespace
}  // namespace geomend
