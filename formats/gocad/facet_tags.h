// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/output.h"
#include "model/objects.h"

// `# CTETRA region e1 e2 e3 e4` behind a TETRA: e_i speaks of the facet opposite to the i-th node and is `none`, or a
// sign, `(boundary)` where the surface ends inside a region, and the name of the surface (quoted if it holds blanks).
// `+`: the tetrahedron lies behind the surface's triangles, `-`: in front.

namespace geomend::gocad {

/// Reads what stands behind `# CTETRA`. Names are views into the file, which has to stay.
class FacetTagReader {
public:
    struct Line {
        std::string_view region;
        std::array<CellMesh::FacetTag, 4> facets;
    };

    /// \param text from behind CTETRA to the end of the line
    /// \return nullptr, or where in the text something else than expected stands
    const char* read(std::string_view text, Line& line);

    std::vector<std::string> take_names();

private:
    std::uint32_t name_index(std::string_view name);

    std::vector<std::string_view> names_;
    std::unordered_map<std::string_view, std::uint32_t> index_;
    std::string_view last_name_;
    std::uint32_t last_index_ = no_index;
};

/// Appends " e1 e2 e3 e4".
void append_facet_tags(std::string& out, const CellMesh::FacetTag* facets, const std::vector<std::string>& written_names);

}  // namespace geomend::gocad
