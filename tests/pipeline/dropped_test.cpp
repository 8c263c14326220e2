// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/dropped.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/codes.h"
#include "pipeline/load.h"

namespace geomend {
namespace {

/// Loads a file of some text.
Dataset loaded(const std::string& name, const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() / ("dropped_" + name);
    std::ofstream(path) << text;
    auto data = load(path.string(), {});
    std::filesystem::remove(path);
    EXPECT_TRUE(data) << name;
    return data ? std::move(data).value() : Dataset{};
}

const std::string frame = "HEADER {\nname:s\n}\n";

TEST(WhatIsDropped, IsInTheListOfLosses) {
    const std::vector<std::pair<std::string, std::string>> files = {
        {"a.ts", "GOCAD TSurf 1\n" + frame + "TFACE\nPVRTX 1 0 0 0 7\nPVRTX 2 1 0 0 8\nPVRTX 3 0 1 0 9\nTRGL 1 2 3\nEND\n"},
        {"a.vs", "GOCAD VSet 1\n" + frame + "PVRTX 1 0 0 0 7\nPVRTX 2 1 0 0 8\nEND\n"},
        {"a.msh",
         "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n"
         "$EndElements\n$NodeData\n1\n\"v\"\n0\n3\n0\n1\n2\n1 5\n1 6\n$EndNodeData\n"},
    };
    for (const auto& [name, text] : files) {
        const Dataset data = loaded(name, text);
        ASSERT_EQ(std::ranges::count(data.findings, "F107", &Finding::code), 1) << name;
        const auto substance = std::ranges::count(data.losses, LossClass::substance, &Loss::loss_class);
        EXPECT_EQ(substance, 1) << name;
    }
}

TEST(WhatIsDropped, IsEveryFindingThatSaysSo) {
    for (const CodeInfo& row : code_catalogue()) {
        if (row.code.front() != 'F' || row.meaning.find("the rest is not used") == std::string_view::npos) continue;
        EXPECT_TRUE(loss_of_finding(row.code, "value")) << row.code;
    }
}

TEST(WhatIsDropped, NothingOfASoundFile) {
    const Dataset data = loaded("b.ts", "GOCAD TSurf 1\n" + frame + "TFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n");
    EXPECT_TRUE(data.losses.empty());
}

}  // namespace
}  // namespace geomend
