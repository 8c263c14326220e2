// SPDX-License-Identifier: AGPL-3.0-or-later
#include <random>
#include <set>

#include "gmsh_support.h"

namespace geomend::test {
namespace {

TEST(MshHostile, EveryCutIsAnErrorUnlessOnlyWholeSectionsAreGone) {
    for (const char* whole : {two_tets_22(), two_tets_41()}) {
        const std::string text = whole;
        for (std::size_t size = 0; size < text.size() - 1; ++size) {
            const std::string cut = text.substr(0, size);
            const auto d = read_text(cut);
            if (!d.ok()) {
                EXPECT_FALSE(d.why().error.message.empty());
                EXPECT_EQ(d.why().kind, FailureKind::unreadable);
                continue;
            }
            // What stands between two sections cannot be told from a whole file, but that no elements are there can.
            EXPECT_TRUE(cut.find("$EndNodes") != std::string::npos && cut.find("$Elements") == std::string::npos) << size;
            EXPECT_FALSE(d->findings.empty()) << size;
        }
    }
}

TEST(MshHostile, EveryCutOfABinaryFileIsAnError) {
    const auto d = read_text(two_tets_41());
    for (const char* version : {"2.2", "4.1"}) {
        const std::string bytes = write_text(*d, {{"version", version}, {"binary", "yes"}}).bytes;
        const std::size_t elements = bytes.find("$EndElements");
        for (std::size_t size = bytes.find("$Elements") + 1; size < elements + 11; ++size)
            EXPECT_FALSE(read_text(bytes.substr(0, size)).ok()) << size;
    }
}

TEST(MshHostile, CountsThatLieAreRefusedBeforeMemoryIsTaken) {
    const std::string huge = "1000000000000000000";
    EXPECT_EQ(failure_of(replaced(two_tets_22(), "$Nodes\n5", "$Nodes\n" + huge)).code, "F014");
    EXPECT_EQ(failure_of(replaced(two_tets_22(), "$Elements\n5", "$Elements\n" + huge)).code, "F014");
    EXPECT_EQ(failure_of(replaced(two_tets_41(), "3 2 4 1\n", "3 2 4 " + huge + "\n")).code, "F014");
    EXPECT_EQ(failure_of(replaced(two_tets_41(), "$Entities\n1 1 1 2", "$Entities\n1 1 1 " + huge)).code, "F014");
    EXPECT_EQ(failure_of(replaced(two_tets_22(), "$PhysicalNames\n3", "$PhysicalNames\n" + huge)).code, "F014");
}

TEST(MshHostile, CountsThatAreOffByOneAreRefused) {
    for (const char* n : {"4", "6"}) {
        EXPECT_FALSE(read_text(replaced(two_tets_22(), "$Nodes\n5", std::string("$Nodes\n") + n)).ok());
        EXPECT_FALSE(read_text(replaced(two_tets_22(), "$Elements\n5", std::string("$Elements\n") + n)).ok());
    }
    EXPECT_FALSE(read_text(replaced(two_tets_41(), "$Elements\n5 5", "$Elements\n5 4")).ok());
    EXPECT_FALSE(read_text(replaced(two_tets_41(), "$Nodes\n5 5", "$Nodes\n5 4")).ok());
}

TEST(MshHostile, ErrorsTellLineAndColumn) {
    Finding f = failure_of(replaced(two_tets_22(), "3 0 1 0", "3 0 x 0"));
    EXPECT_EQ(f.code, "F005");
    EXPECT_EQ(to_string(f.where), "box.msh:14:5");
    f = failure_of(replaced(two_tets_22(), "4 0 0 -1.5", "4 0 0 nan"));
    EXPECT_EQ(f.code, "F006");
    EXPECT_EQ(f.where.line, 15u);
    f = failure_of(replaced(two_tets_22(), "5 4 2 2 2 1 2 3 5", "5 4 2 2 2 1 2 3 99"));
    EXPECT_EQ(f.code, "F007");
    EXPECT_EQ(to_string(f.where), "box.msh:24:17");
    f = failure_of(replaced(two_tets_22(), "5 4 2 2 2 1 2 3 5", "5 200 2 2 2 1 2 3 5"));
    EXPECT_EQ(to_string(f.where), "box.msh:24:3");
    f = failure_of(replaced(two_tets_22(), "5 0 0 1e-1", "2 0 0 1e-1"));
    EXPECT_EQ(f.code, "F009");
    EXPECT_EQ(f.where.line, 16u);
    EXPECT_EQ(failure_of(replaced(two_tets_22(), "2.2 0 8", "3.5 0 8")).code, "F013");
    EXPECT_EQ(failure_of(replaced(two_tets_22(), "$EndNodes\n", "")).code, "F004");
    EXPECT_EQ(failure_of("").code, "F002");
    EXPECT_EQ(failure_of("hello\n").code, "F003");
}

Finding only_finding(const std::string& text) {
    const auto data = read_text(text);
    if (!data || data->findings.size() != 1) {
        ADD_FAILURE() << (data ? std::to_string(data->findings.size()) + " findings" : data.why().error.message);
        return {};
    }
    EXPECT_EQ(mesh_of(*data).points.size(), 5u);
    EXPECT_EQ(mesh_of(*data).cell_count(), 5u);
    return data->findings[0];
}

// The blocks of MSH 4 say themselves how many nodes and elements they hold, and Gmsh goes by that.
TEST(MshHostile, MoreNodesOrElementsThanTheBlocksHoldAreReported) {
    for (const std::string n : {"6", "1000", "1000000000000000000"}) {
        EXPECT_EQ(only_finding(replaced(two_tets_41(), "$Nodes\n5 5", "$Nodes\n5 " + n)).code, "F113");
        const Finding f = only_finding(replaced(two_tets_41(), "$Elements\n5 5", "$Elements\n5 " + n));
        EXPECT_EQ(f.code, "F113");
        EXPECT_NE(f.message.find("announces " + n + " elements, but its blocks hold 5"), std::string::npos) << f.message;
    }
}

TEST(MshHostile, ElementsWithTheTagOfOthersAreNumberedAnew) {
    for (const std::string& text :
         {replaced(two_tets_22(), "5 4 2 2 2 1", "4 4 2 2 2 1"), replaced(two_tets_41(), "5 1 2 3 5\n", "1 1 2 3 5\n")}) {
        const Finding f = only_finding(text);
        EXPECT_EQ(f.code, "F164");
        EXPECT_EQ(f.count, 1u);
        EXPECT_EQ(f.index, (std::vector<std::int64_t>{4}));
        const auto data = read_text(text);
        std::set<std::int64_t> tags;
        for (std::size_t i = 0; i < 5; ++i) tags.insert(mesh_of(*data).cell_labels[i]);
        EXPECT_EQ(tags.size(), 5u);
    }
}

TEST(MshHostile, WithoutEntitiesThoseOfANumberTakeItsPhysicalName) {
    std::string text = two_tets_41();
    const std::size_t begin = text.find("$Entities"), end = text.find("$Nodes");
    text.erase(begin, end - begin);
    EXPECT_EQ(only_finding(text).code, "F113");
    const auto data = read_text(text);
    std::set<std::string> names;
    for (const auto& entity : mesh_of(*data).entities) names.insert(entity.name);
    EXPECT_TRUE(names.contains("lower"));
    EXPECT_TRUE(names.contains("upper \"B\""));
}

// Gmsh saves only entities of physical groups and leaves their bounds as they are.
TEST(MshHostile, BoundsThatAreNotInTheFileAreLeftOutAndReported) {
    const auto data = read_text(replaced(two_tets_41(), "1 2 1 -4", "1 2 1 -5"));
    ASSERT_TRUE(data.ok());
    ASSERT_EQ(data->findings.size(), 1u);
    EXPECT_EQ(data->findings[0].code, "F109");
    EXPECT_NE(data->findings[0].message.find(" names surface -5"), std::string::npos) << data->findings[0].message;
    ASSERT_EQ(data->losses.size(), 1u);
    EXPECT_EQ(data->losses[0].loss_class, LossClass::identity);
    std::size_t bounds = 0, before = 0;
    for (const auto& entity : mesh_of(*data).entities) bounds += entity.boundary.size();
    for (const auto& entity : mesh_of(*read_text(std::string(two_tets_41()))).entities) before += entity.boundary.size();
    EXPECT_EQ(bounds + 1, before);
}

TEST(MshHostile, DataForWhatIsNotThereAreRefused) {
    const std::string head = std::string(two_tets_22()) + "$ElementData\n1\n\"a\"\n1\n0\n3\n0\n";
    EXPECT_EQ(failure_of(head + "1\n1\n88 1\n$EndElementData\n").code, "F007");
    EXPECT_EQ(failure_of(head + "1\n2\n5 1           \n$EndElementData\n").code, "F008");
    EXPECT_EQ(failure_of(head + "1000000\n1\n5 1\n$EndElementData\n").code, "F012");
    EXPECT_EQ(failure_of(head + "1\n1000000000000\n5 1\n$EndElementData\n").code, "F014");
}

TEST(MshHostile, ChangedBytesNeverCrash) {
    const auto d = read_text(two_tets_41());
    std::vector<std::string> seeds = {two_tets_22(), two_tets_41()};
    for (const char* version : {"2.2", "4.1"}) seeds.push_back(write_text(*d, {{"version", version}, {"binary", "yes"}}).bytes);
    std::mt19937 random(7);
    for (const std::string& seed : seeds) {
        for (int round = 0; round < 2000; ++round) {
            std::string bytes = seed;
            for (int k = 0; k < 1 + round % 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
            const auto result = read_text(bytes);
            if (!result.ok()) {
                EXPECT_FALSE(result.why().error.code.empty());
            }
        }
    }
}

}  // namespace
}  // namespace geomend::test
