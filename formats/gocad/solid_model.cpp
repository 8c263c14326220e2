// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/solid_model.h"

#include <algorithm>
#include <unordered_map>

#include "formats/gocad/number_scan.h"

namespace geomend::gocad {

std::string name_to_line_end(TextCursor& line) {
    if (line.at_line_end()) return {};
    if (line.peek_rest().front() == '"') return std::string(line.quoted_token());
    return std::string(line.rest());
}

bool SolidModelReader::take(std::string_view keyword, TextCursor& line) {
    const auto is = [&](std::string_view word) { return same_word(keyword, word); };
    if (is("TRGL")) {
        std::array<std::int64_t, 3> ids{};
        if (read_ids(line, ids, "TRGL")) add_triangle(ids, line.line());
    } else if (is("MODEL")) {
        seen_ = true;
    } else if (is("SURFACE")) {
        surface_ = name_to_line_end(line);
        seen_ = true;
    } else if (is("TFACE")) {
        std::int64_t number = 0;
        const std::uint32_t column = line.column();
        if (line.integer(number) != NumberStatus::ok || number < 1 || number > largest_id) {
            scanner_.log.add("F012", line.line(), column, "TFACE: expected its number");
            number = static_cast<std::int64_t>(faces_.size()) + 1;
        }
        new_face(number, line.line());
    } else if (is("KEYVERTICES")) {
        std::array<std::int64_t, 3> ids{};
        if (!read_ids(line, ids, "KEYVERTICES")) return true;
        if (faces_.empty()) new_face(1, line.line());
        faces_.back().key = ids;
        faces_.back().has_key = true;
    } else if (is("MODEL_REGION")) {
        read_region(line);
    } else return false;
    return true;
}

void SolidModelReader::new_face(std::int64_t number, std::uint64_t line) {
    seen_ = true;
    faces_.push_back({number, surface_, {}, false, line, triangle_count()});
}

bool SolidModelReader::read_ids(TextCursor& line, std::array<std::int64_t, 3>& ids, std::string_view what) {
    for (std::int64_t& id : ids) {
        line.at_line_end();
        const std::uint32_t column = line.column();
        if (line.integer(id) == NumberStatus::ok && id <= largest_id && id >= -largest_id) continue;
        scanner_.log.add(
            "F012", line.line(), column,
            [&] { return std::string(what) + ": expected three node ids, found '" + std::string(trimmed(line.line_text())) + "'"; }, what);
        return false;
    }
    return true;
}

const char* SolidModelReader::scan_triangle(const char* p, const char* end, std::uint64_t line) {
    std::array<std::int64_t, 3> ids;
    if (!scan_id(p, end, ids[0]) || !scan_id(p, end, ids[1]) || !scan_id(p, end, ids[2])) return nullptr;
    p = scan_line_end(p, end);
    if (p != nullptr) add_triangle(ids, line);
    return p;
}

void SolidModelReader::add_triangle(const std::array<std::int64_t, 3>& ids, std::uint64_t line) {
    if (faces_.empty()) {
        scanner_.log.add("F118", line, 1, "a TRGL stands before the first TFACE");
        new_face(1, line);
    }
    for (const std::int64_t id : ids) {
        const std::uint32_t node = nodes_.find(id);
        if (node == no_index) later_.push_back({corners_.size(), id, line});
        corners_.push_back(node);
    }
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0]) {
        const auto number = static_cast<std::int64_t>(triangle_count());
        scanner_.log.add(
            "F103", line, 0, [&] { return "triangle " + std::to_string(number) + " has the same node twice"; }, "TRGL", number);
    }
}

// `MODEL_REGION name +n`: the number is the last word; the name may hold blanks without quotes.
void SolidModelReader::read_region(TextCursor& line) {
    seen_ = true;
    const std::uint32_t column = line.column();
    const std::string_view rest = line.rest();
    const std::size_t blank = rest.find_last_of(" \t");
    Side side;
    side.line = line.line();
    if (blank == std::string_view::npos || parse_integer(rest.substr(blank + 1), side.face) != NumberStatus::ok || side.face == 0 ||
        side.face < -largest_id || side.face > largest_id) {
        scanner_.log.add("F012", line.line(), column, [&] {
            return "MODEL_REGION: expected a name and a TFACE number with its sign, found '" + std::string(rest) + "'";
        });
        return;
    }
    TextCursor name(rest.substr(0, blank));
    name.next_line();
    side.region = name_to_line_end(name);
    sides_.push_back(std::move(side));
}

void SolidModelReader::settle_references() {
    for (const Reference& r : later_) {
        corners_[r.corner] = nodes_.find(r.id);
        if (corners_[r.corner] != no_index) continue;
        scanner_.log.add(
            "F007", r.line, 0, [&] { return "TRGL: node " + std::to_string(r.id) + " is not defined"; }, "TRGL", r.id);
    }
    for (const Face& face : faces_) {
        if (!face.has_key) continue;
        for (const std::int64_t id : face.key) {
            if (nodes_.find(id) != no_index) continue;
            scanner_.log.add(
                "F007", face.line, 0, [&] { return "KEYVERTICES: node " + std::to_string(id) + " is not defined"; }, "KEYVERTICES", id);
        }
    }
}

void SolidModelReader::check_numbers() {
    std::vector<std::int64_t> numbers;
    for (const Face& face : faces_) numbers.push_back(face.number);
    std::ranges::sort(numbers);
    const auto twice = std::ranges::adjacent_find(numbers);
    if (twice == numbers.end()) return;
    const auto second = std::ranges::find(faces_.rbegin(), faces_.rend(), *twice, &Face::number);
    scanner_.log.add("F009", second->line, 0, [&] { return "TFACE " + std::to_string(*twice) + " is defined twice"; });
}

void SolidModelReader::add_faces(CellMesh& mesh, StatedModel& model) const {
    const auto first_entity = static_cast<std::uint32_t>(mesh.entities.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const Face& face = faces_[f];
        CellMesh::Entity entity;
        entity.dimension = 2;
        entity.tag = face.number;
        entity.name = face.surface;
        mesh.entities.push_back(std::move(entity));

        StatedModel::Face stated;
        stated.number = face.number;
        stated.object = 0;
        stated.part = first_entity + static_cast<std::uint32_t>(f);
        stated.interface_name = face.surface;
        if (face.has_key) {
            std::array<Vec3, 3> key{};
            for (std::size_t i = 0; i < 3; ++i) key[i] = mesh.points[nodes_.find(face.key[i])];
            stated.key = key;
        }
        model.faces.push_back(std::move(stated));

        const std::size_t last = f + 1 < faces_.size() ? faces_[f + 1].first_triangle : triangle_count();
        for (std::size_t t = face.first_triangle; t < last; ++t) {
            mesh.add_cell(CellType::triangle, {corners_.data() + 3 * t, 3});
            mesh.cell_entity.push_back(first_entity + static_cast<std::uint32_t>(f));
        }
        if (last == face.first_triangle) {
            scanner_.log.add(
                "F119", face.line, 0, [&] { return "TFACE " + std::to_string(face.number) + " has no triangle"; }, "TFACE", face.number);
        }
    }
}

void SolidModelReader::add_regions(const CellMesh& mesh, StatedModel& model) const {
    std::unordered_map<std::int64_t, std::uint32_t> face_of_number;
    for (std::size_t f = 0; f < faces_.size(); ++f) face_of_number.emplace(faces_[f].number, static_cast<std::uint32_t>(f));
    std::unordered_map<std::string, std::int64_t> tag_of_name;
    for (const CellMesh::Entity& e : mesh.entities) {
        if (e.dimension == 3) tag_of_name.emplace(e.name, e.tag);
    }
    std::unordered_map<std::string, std::size_t> region_of_name;
    for (const Side& side : sides_) {
        const auto face = face_of_number.find(side.face < 0 ? -side.face : side.face);
        if (face == face_of_number.end()) {
            scanner_.log.add(
                "F109", side.line, 0, [&] { return "MODEL_REGION " + side.region + ": there is no TFACE " + std::to_string(side.face); },
                "MODEL_REGION", side.face);
            continue;
        }
        const auto [at, is_new] = region_of_name.try_emplace(side.region, model.regions.size());
        if (is_new) {
            StatedModel::Region region;
            region.name = side.region;
            region.universe = same_word(side.region, "Universe");
            const auto tag = tag_of_name.find(side.region);
            if (tag != tag_of_name.end()) region.number = tag->second;
            else if (!region.universe) {
                scanner_.log.add(
                    "F121", side.line, 0, [&] { return "MODEL_REGION " + side.region + ": no tetrahedron belongs to it"; }, "MODEL_REGION");
            }
            model.regions.push_back(std::move(region));
        }
        model.regions[at->second].sides.push_back({face->second, side.face > 0});
    }
}

void SolidModelReader::finish(CellMesh& mesh, StatedModel& model) {
    settle_references();
    check_numbers();
    if (scanner_.log.has_error()) return;
    add_faces(mesh, model);
    add_regions(mesh, model);
}

}  // namespace geomend::gocad
