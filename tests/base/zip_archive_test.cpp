// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/zip_archive.h"

#include <gtest/gtest.h>

#include "support/zip_maker.h"

namespace geomend::test {
namespace {

Result<ZipArchive> archive_of(std::string bytes) { return ZipArchive::open(Input::from_memory(std::move(bytes), "a.zip")); }

std::string refused(std::string bytes) {
    const auto archive = archive_of(std::move(bytes));
    return archive ? "was read" : archive.why().error.code;
}

std::string changed(std::string bytes, std::size_t at, std::string_view by) { return bytes.replace(at, by.size(), by); }

const std::string long_text(5000, 'x');

TEST(ZipArchive, GivesBackTheBytesOfItsFiles) {
    for (const bool compressed : {true, false}) {
        const auto archive = archive_of(zip_of({{"b/two.txt", long_text}, {"a.txt", "one"}, {"empty", ""}}, compressed));
        ASSERT_TRUE(archive.ok());
        EXPECT_EQ(archive->entries().size(), 3u);
        ASSERT_NE(archive->find("b/two.txt"), nullptr);
        EXPECT_EQ(*archive->bytes(*archive->find("b/two.txt")), long_text);
        EXPECT_EQ(*archive->bytes(*archive->find("a.txt")), "one");
        EXPECT_EQ(*archive->bytes(*archive->find("empty")), "");
        EXPECT_EQ(archive->find("two.txt"), nullptr);
    }
}

TEST(ZipArchive, ACommentMayFollow) {
    std::string bytes = zip_of({{"a", "one"}});
    bytes = changed(bytes, bytes.size() - 2, little(5, 2)) + "hello";
    ASSERT_TRUE(archive_of(bytes).ok());
    EXPECT_EQ(refused(bytes + "!"), "F004");
}

TEST(ZipArchive, DamageShowsInTheCheckSum) {
    std::string bytes = zip_of({{"a", "one"}}, false);
    bytes[bytes.find("one")] = 'O';
    const auto archive = archive_of(bytes);
    ASSERT_TRUE(archive.ok());
    EXPECT_EQ(archive->bytes(archive->entries()[0]).why().error.code, "F015");
}

TEST(ZipArchive, SizesThatAreNotSoAreDamage) {
    const std::string bytes = zip_of({{"a", long_text}});
    const std::size_t record = bytes.find("PK\1\2");
    for (const std::size_t size : {long_text.size() - 1, long_text.size() + 1}) {
        const auto archive = archive_of(changed(bytes, record + 24, little(size, 4)));
        ASSERT_TRUE(archive.ok());
        EXPECT_EQ(archive->bytes(archive->entries()[0]).why().error.code, "F015");
    }
}

TEST(ZipArchive, WhatIsNotReadIsNamed) {
    const std::string bytes = zip_of({{"a", "one"}});
    const std::size_t record = bytes.find("PK\1\2"), end = bytes.find("PK\5\6");
    EXPECT_EQ(refused(changed(bytes, record + 8, little(1, 2))), "F013");        // encrypted
    EXPECT_EQ(refused(changed(bytes, record + 10, little(12, 2))), "F013");      // another compression
    EXPECT_EQ(refused(changed(bytes, end + 10, little(0xffff, 2))), "F013");     // ZIP64
    EXPECT_EQ(refused(changed(bytes, end + 4, little(1, 2))), "F013");           // several parts
    EXPECT_EQ(refused(changed(bytes, end + 16, little(100000, 4))), "F012");     // a directory elsewhere
    EXPECT_EQ(refused(changed(bytes, record + 42, little(100000, 4))), "F012");  // a file elsewhere
    EXPECT_EQ(refused(changed(bytes, record, "PKxx")), "F012");
    EXPECT_EQ(refused(zip_of({{"a", "one"}, {"a", "two"}})), "F009");
}

TEST(ZipArchive, FilesThatShareBytesAreRefused) {
    // Both records name the first file's bytes, as archives do that grow without end.
    std::string bytes = zip_of({{"a", long_text}, {"b", long_text}});
    const std::size_t first = bytes.find("PK\1\2"), second = bytes.find("PK\1\2", first + 1);
    EXPECT_EQ(refused(changed(bytes, second + 42, little(0, 4))), "F012");
}

TEST(ZipArchive, FilesThatGrowBeyondAnyModelAreRefusedBeforeTheyDo) {
    const std::string bytes = zip_of({{"a", long_text}});
    EXPECT_EQ(refused(changed(bytes, bytes.find("PK\1\2") + 24, little(4000000000u, 4))), "F014");
}

}  // namespace
}  // namespace geomend::test
