// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "formats/format.h"
#include "formats/gmsh/text_pieces.h"
#include "formats/gmsh/write_plan.h"

namespace geomend::gmsh {

/// What the parts of the writer share.
struct Writing {
    const WritePlan& plan;
    OutputFile& out;
    bool binary = false;
    bool v41 = true;
    const Monitor* monitor = nullptr;
    bool stopped() const { return monitor != nullptr && monitor->stopped(); }
};

inline constexpr std::size_t lines_per_piece = 4096;

/// $Entities, $Nodes and $Elements of MSH 4.1.
void write_mesh_41(const Writing& w);
/// $Nodes and $Elements of MSH 2.2.
void write_mesh_22(const Writing& w);
/// $NodeData, $ElementData and $ElementNodeData: the attributes of `mesh`, under the names of `described`, which
/// describes them as they will be read back (see describe_attributes).
void write_data(const Writing& w, const CellMesh& mesh, const std::vector<Attribute>& described);
/// $Periodic of the annotations "gmsh.periodic"; what does not fit any more is added to `losses`.
void write_periodic(const Writing& w, const CellMesh& mesh, std::vector<Loss>& losses);

/// The attributes as they go out, without values: unique names that MSH can hold, and annotations ("geomend.name",
/// "geomend.type", "geomend.components") that say what they were. `components` is that of the file. Attributes that
/// cannot go out have no components, and are added to `losses`.
std::vector<Attribute> describe_attributes(const CellMesh& mesh, std::vector<Loss>& losses);

/// Puts back what describe_attributes noted: called after the text of the $Geomend section was applied.
void restore_attributes(std::vector<Attribute>& attributes);

/// A text between double quotes cannot hold one, nor a line end; clients cut names after 127 bytes.
std::string quotable(std::string_view name);

}  // namespace geomend::gmsh
