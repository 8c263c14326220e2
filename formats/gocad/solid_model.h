// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/gocad/node_table.h"
#include "formats/gocad/object_scanner.h"

namespace geomend::gocad {

/// The MODEL section of a solid: SURFACE, TFACE, KEYVERTICES, TRGL and MODEL_REGION records over its nodes.
class SolidModelReader {
public:
    SolidModelReader(ObjectScanner& scanner, NodeTable& nodes) : scanner_(scanner), nodes_(nodes) {}

    /// Takes a record of the section. \return false when it is not one
    bool take(std::string_view keyword, TextCursor& line);
    /// The short way for TRGL lines. \return the start of the next line, or nullptr
    const char* scan_triangle(const char* p, const char* end, std::uint64_t line);

    bool any() const { return seen_; }
    std::size_t triangle_count() const { return corners_.size() / 3; }

    /// After the last line: adds one entity of dimension 2 per TFACE and all triangles to the mesh, whose tetrahedra
    /// are there already, and makes the stated model. \pre nodes are finished
    void finish(CellMesh& mesh, StatedModel& model);

private:
    struct Face {
        std::int64_t number = 0;
        std::string surface;
        std::array<std::int64_t, 3> key{};
        bool has_key = false;
        std::uint64_t line = 0;
        std::size_t first_triangle = 0;
    };
    struct Side {
        std::string region;
        std::int64_t face = 0;  ///< with its sign
        std::uint64_t line = 0;
    };
    struct Reference {
        std::size_t corner;
        std::int64_t id;
        std::uint64_t line;
    };

    void new_face(std::int64_t number, std::uint64_t line);
    void add_triangle(const std::array<std::int64_t, 3>& ids, std::uint64_t line);
    bool read_ids(TextCursor& line, std::array<std::int64_t, 3>& ids, std::string_view what);
    void read_region(TextCursor& line);
    void settle_references();
    void check_numbers();
    void add_faces(CellMesh& mesh, StatedModel& model) const;
    void add_regions(const CellMesh& mesh, StatedModel& model) const;

    ObjectScanner& scanner_;
    NodeTable& nodes_;
    bool seen_ = false;
    std::string surface_;
    std::vector<Face> faces_;
    std::vector<Side> sides_;
    std::vector<std::uint32_t> corners_;  ///< of triangles, three each
    std::vector<Reference> later_;
};

/// A name that takes the rest of a line: quoted or bare, in which case it may hold blanks.
std::string name_to_line_end(TextCursor& line);

}  // namespace geomend::gocad
