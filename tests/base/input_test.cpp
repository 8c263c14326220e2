// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/input.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <thread>

#include "support/temporary_folder.h"

namespace geomend {
namespace {

using test::TemporaryFolder;
using test::write_file;

void write_gzip(const std::filesystem::path& path, const std::string& text) {
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
}

TEST(Input, MapsAFile) {
    const TemporaryFolder folder;
    write_file(folder / "a.ts", "GOCAD");
    const auto input = Input::open((folder / "a.ts").string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->bytes(), "GOCAD");
    EXPECT_EQ(input->base_name(), "a.ts");
}

TEST(Input, RefusesFoldersAndMissingFiles) {
    const TemporaryFolder folder;
    for (const auto& path : {folder.path(), folder / "none"}) {
        const auto input = Input::open(path.string());
        ASSERT_FALSE(input);
        EXPECT_EQ(input.why().error.code, "F001");
        EXPECT_EQ(input.why().kind, FailureKind::unreadable);
    }
}

TEST(Input, ReadsAPipe) {
    const TemporaryFolder folder;
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { write_file(pipe, std::string(3'000'000, 'x')); });
    const auto input = Input::open(pipe.string());
    writer.join();
    ASSERT_TRUE(input);
    EXPECT_EQ(input->bytes().size(), 3'000'000u);
}

TEST(Input, InflatesGzipToldByItsBytes) {
    const TemporaryFolder folder;
    const std::string text(2'500'000, 'z');
    write_gzip(folder / "a.ts.gz", text);
    const auto input = Input::open((folder / "a.ts.gz").string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->bytes(), text);
    EXPECT_EQ(input->base_name(), "a.ts");
    EXPECT_LT(input->stored_size(), text.size());
}

TEST(Input, EndsLinesOfOldTextsByLineFeeds) {
    const TemporaryFolder folder;
    const auto read = [&](const std::string& bytes) {
        write_file(folder / "a", bytes);
        return std::string(Input::open((folder / "a").string())->bytes());
    };
    EXPECT_EQ(read("a b\r\rc\r"), "a b\n\nc\n");
    for (const std::string& other : {std::string("a\r\nb\r"), std::string("a\rb\0", 4), std::string("ab\r\x01")})
        EXPECT_EQ(read(other), other);
}

TEST(Input, TheEndMarkOfDosIsNoPartOfAText) {
    const TemporaryFolder folder;
    const auto bytes_of = [&](const std::string& content) {
        write_file(folder / "f", content);
        return std::string(Input::open((folder / "f").string())->bytes());
    };
    EXPECT_EQ(bytes_of("1 2 3\r\n\x1a"), "1 2 3\r\n");
    EXPECT_EQ(bytes_of("1 2 3\x1a\x1a"), "1 2 3");
    EXPECT_EQ(bytes_of("1 2 3\n\x1a\r\n"), "1 2 3\n");
    EXPECT_EQ(bytes_of(std::string("1 2 3\n\x1a\0\0\0", 10)), "1 2 3\n") << "filled up";
    EXPECT_EQ(bytes_of("1 2\x1a 3\n"), "1 2\x1a 3\n") << "not at the end";
    EXPECT_EQ(bytes_of(std::string("\0\x10 1\x1a", 5)), std::string("\0\x10 1\x1a", 5)) << "binary";
    const std::string long_text(10000, 'a'), binary_end = long_text + std::string(1, '\0') + "\x1a";
    EXPECT_EQ(bytes_of(long_text + "\x1a"), long_text);
    EXPECT_EQ(bytes_of(binary_end), binary_end);
}

TEST(Input, RefusesUtf16) {
    const TemporaryFolder folder;
    for (const std::string& bytes : {std::string("\xff\xfeS\0", 4), std::string("\xfe\xff\0S", 4)}) {
        write_file(folder / "a", bytes);
        const auto input = Input::open((folder / "a").string());
        ASSERT_FALSE(input);
        EXPECT_EQ(input.why().error.code, "F013");
    }
}

TEST(Input, JoinsGzipMembers) {
    const TemporaryFolder folder;
    write_gzip(folder / "1", "one ");
    write_gzip(folder / "2", "two");
    write_file(folder / "both.gz", test::read_file(folder / "1") + test::read_file(folder / "2"));
    const auto input = Input::open((folder / "both.gz").string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->bytes(), "one two");
}

TEST(Input, TellsDamagedGzip) {
    const TemporaryFolder folder;
    write_gzip(folder / "whole.gz", std::string(100'000, 'q') + "end");
    const std::string bytes = test::read_file(folder / "whole.gz");
    for (const std::size_t keep : {std::size_t{5}, bytes.size() / 2, bytes.size() - 1}) {
        write_file(folder / "cut.gz", bytes.substr(0, keep));
        const auto input = Input::open((folder / "cut.gz").string());
        ASSERT_FALSE(input) << keep;
        EXPECT_EQ(input.why().error.code, "F015");
    }
    std::string changed = bytes;
    changed[changed.size() - 6] ^= 1;  // in the checksum
    write_file(folder / "changed.gz", changed);
    EXPECT_FALSE(Input::open((folder / "changed.gz").string()));
}

TEST(Input, FindsCompanionsBesideItself) {
    const TemporaryFolder folder;
    write_file(folder / "a.vo", "head");
    write_file(folder / "a_p@@", "data");
    const auto input = Input::open((folder / "a.vo").string());
    ASSERT_TRUE(input);
    EXPECT_TRUE(input->has_companion("a_p@@"));
    EXPECT_EQ(input->companion("a_p@@")->bytes(), "data");
    const auto missing = input->companion("gone@@");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.why().error.code, "F010");
    EXPECT_NE(missing.why().error.message.find((folder / "gone@@").string()), std::string::npos);
}

}  // namespace
}  // namespace geomend
