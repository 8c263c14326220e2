// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/gmsh/read_msh.h"
#include "formats/gmsh/write_msh.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline Result<Dataset> read_text(std::string bytes) { return gmsh::read_msh(Input::from_memory(std::move(bytes), "box.msh"), {}); }

inline const CellMesh& mesh_of(const Dataset& dataset) { return std::get<CellMesh>(dataset.objects.at(0)); }

/// The failure of a text that must not be read.
inline Finding failure_of(const std::string& bytes) {
    const auto result = read_text(bytes);
    EXPECT_FALSE(result.ok()) << "was read:\n" << bytes.substr(0, 400);
    return result.ok() ? Finding{} : result.why().error;
}

struct Written {
    std::string bytes;
    std::vector<Loss> losses;
};

inline Written write_text(const Dataset& dataset, const FormatOptions& options) {
    const TemporaryFolder folder;
    OutputSet outputs(folder / "out.msh");
    WriteOptions write_options;
    write_options.options = options;
    auto losses = gmsh::write_msh(dataset, outputs, write_options);
    EXPECT_TRUE(losses.ok()) << (losses.ok() ? "" : losses.why().error.message);
    if (!losses.ok()) return {};
    EXPECT_TRUE(outputs.commit().ok());
    return {read_file(folder / "out.msh"), *losses};
}

/// Two tetrahedra in two volumes with a triangle between them, a line and a point.
inline const char* two_tets_22() {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
           "$PhysicalNames\n3\n2 7 \"fault\"\n3 1 \"lower\"\n3 2 \"upper \"B\"\"\n$EndPhysicalNames\n"
           "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 -1.5\n5 0 0 1e-1\n$EndNodes\n"
           "$Elements\n5\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 2 2 7 4 1 2 3\n4 4 2 1 1 1 3 2 4\n5 4 2 2 2 1 2 3 5\n$EndElements\n";
}

/// The same as MSH 4.1, with boundaries.
inline const char* two_tets_41() {
    return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
           "$PhysicalNames\n3\n2 7 \"fault\"\n3 1 \"lower\"\n3 2 \"upper \"B\"\"\n$EndPhysicalNames\n"
           "$Entities\n1 1 1 2\n1 0 0 0 0\n1 0 0 0 1 0 0 0 1 1\n4 0 0 0 1 1 0 1 7 1 1\n"
           "1 0 0 -1.5 1 1 0 1 1 1 4\n2 0 0 0 1 1 0.1 1 2 1 -4\n$EndEntities\n"
           "$Nodes\n5 5 1 5\n0 1 0 1\n1\n0 0 0\n1 1 0 1\n2\n1 0 0\n2 4 0 1\n3\n0 1 0\n3 1 0 1\n4\n0 0 -1.5\n3 2 0 1\n5\n0 0 "
           "1e-1\n$EndNodes\n"
           "$Elements\n5 5 1 5\n0 1 15 1\n1 1\n1 1 1 1\n2 1 2\n2 4 2 1\n3 1 2 3\n3 1 4 1\n4 1 3 2 4\n3 2 4 1\n5 1 2 3 5\n$EndElements\n";
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

}  // namespace geomend::test
