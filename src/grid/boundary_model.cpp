// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/boundary_model.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/number_text.h"
#include "grid/cell_mesh.h"
#include "grid/connections.h"
#include "grid/face_triangles.h"
#include "grid/triangle_sheets.h"

namespace geomend::grid {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

struct Feature {
    std::string name;
    FeatureRole role = FeatureRole::unknown;
    auto operator<=>(const Feature&) const = default;
};

CellFace opposite(CellFace face) { return static_cast<CellFace>(static_cast<unsigned>(face) ^ 1u); }

class Maker {
public:
    Maker(const CornerPointGrid& grid, const ModelRequest& request, ModelSources* sources)
        : grid_(grid), request_(request), sources_(sources), faces_(conforming_faces(grid)), stated_(grid), outward_(!right_handed(grid)) {}

    Result<Dataset> make() {
        for (const std::uint32_t layer : request_.horizons) {
            if (layer < 1 || layer >= grid_.dims[2])
                return failure(FailureKind::usage, "F018", {},
                               "--option horizons: layer " + std::to_string(layer) + " has nothing below it in grid '" + grid_.info.name +
                                   "' of " + std::to_string(grid_.dims[2]) + " layers");
        }
        if (auto found = find_regions(); !found) return std::move(found).why();
        for (std::uint32_t f = 0; f < faces_.faces.size(); ++f) sort_in(f);
        Dataset model;
        model.models.emplace_back();
        StatedModel& stated = model.models.front();
        stated.name = grid_.info.name;
        stated.crs = grid_.info.crs;
        for (const std::string& name : region_names_) {
            StatedModel::Region region;
            region.number = static_cast<std::int64_t>(stated.regions.size() + 1);
            region.name = name;
            stated.regions.push_back(std::move(region));
        }
        for (const auto& [key, members] : groups_) add_surfaces(key, members, model, stated);
        if (sources_ != nullptr) sources_->unmatched_columns = faces_.unmatched_columns;
        return model;
    }

private:
    // Feature, region behind, region in front or nobody, and which way open faces look: two that look at each other may
    // be alike, and one surface would hold them twice.
    using Key = std::tuple<Feature, std::uint32_t, std::uint32_t, unsigned>;
    struct Triangles {
        std::vector<std::array<std::uint32_t, 3>> corners;
        std::vector<std::uint32_t> face;  // of faces_, per triangle

        void add(const Triangles& from, std::size_t t, bool turned) {
            corners.push_back(from.corners[t]);
            if (turned) std::swap(corners.back()[1], corners.back()[2]);
            face.push_back(from.face[t]);
        }
    };
    struct Member {
        std::uint32_t face;
        bool turned;  // its normal leaves the region in front
    };

    Result<void> find_regions() {
        const Attribute* values =
            request_.regions.empty() ? nullptr : find_attribute(grid_.info.attributes, request_.regions, AttributeLocation::cell);
        if (values == nullptr && !request_.regions.empty())
            return failure(FailureKind::usage, "F018", {},
                           "--option regions=" + request_.regions + ": grid '" + grid_.info.name + "' has no such attribute of cells");
        std::map<std::pair<double, std::size_t>, std::uint32_t> ids;
        region_.assign(grid_.cell_count(), nobody);
        for (std::size_t c = 0; c < region_.size(); ++c) {
            if (faces_.present[c] != 0) ids[place(values, c)] = 0;
        }
        if (ids.size() > 100000)
            return failure(
                FailureKind::usage, "F018", {},
                "--option regions=" + request_.regions + ": " + std::to_string(ids.size()) + " different values do not make regions");
        for (auto& [key, id] : ids) {
            id = static_cast<std::uint32_t>(region_names_.size());
            std::string name = values == nullptr ? std::string() : request_.regions + "_" + number_text(key.first);
            if (!request_.horizons.empty()) name += (name.empty() ? "zone_" : "_zone_") + std::to_string(key.second + 1);
            region_names_.push_back(name.empty() ? "grid" : name);
        }
        for (std::size_t c = 0; c < region_.size(); ++c) {
            if (faces_.present[c] != 0) region_[c] = ids[place(values, c)];
        }
        return {};
    }

    std::pair<double, std::size_t> place(const Attribute* values, std::size_t cell) const {
        const std::uint32_t k = grid_.ijk(cell)[2];
        const auto above = std::ranges::count_if(request_.horizons, [&](std::uint32_t layer) { return layer <= k; });
        return {values == nullptr ? 0.0 : value_as_double(*values, cell), static_cast<std::size_t>(above)};
    }

    // Puts a face where it belongs; faces within a region that are on no fault and no horizon belong nowhere.
    void sort_in(std::uint32_t f) {
        const GridFaces::Face& face = faces_.faces[f];
        const std::uint32_t back = region_[face.first], front = face.second == nobody ? nobody : region_[face.second];
        Feature feature;
        if (!feature_of(face, back == front, feature)) return;
        const unsigned way = face.second == nobody ? static_cast<unsigned>(face.side) & 1u : 0u;
        if (back <= front) groups_[{std::move(feature), back, front, way}].push_back({f, false});
        else groups_[{std::move(feature), front, back, way}].push_back({f, true});
    }

    bool feature_of(const GridFaces::Face& face, bool within, Feature& feature) const {
        const std::string* fault = stated_.find(face.first, face.side);
        if (fault == nullptr && face.second != nobody) fault = stated_.find(face.second, opposite(face.side));
        if (fault != nullptr) {
            feature = {*fault, FeatureRole::fault};
            return true;
        }
        if (face.side >= CellFace::k_minus) return level_feature(face, within, feature);
        if (face.second != nobody && is_throw(face)) {
            feature = {"unnamed throw", FeatureRole::fault};
            return true;
        }
        if (face.second != nobody) {
            if (!within) feature = {"region boundary", FeatureRole::unknown};
            return !within;
        }
        static constexpr std::array names{"boundary I-", "boundary I+", "boundary J-", "boundary J+"};
        if (on_edge(face)) feature = {names[static_cast<std::size_t>(face.side)], FeatureRole::boundary};
        else if (has_cells_beside(face)) feature = {"unnamed throw", FeatureRole::fault};
        else feature = {"boundary inside", FeatureRole::boundary};
        return true;
    }

    bool level_feature(const GridFaces::Face& face, bool within, Feature& feature) const {
        const std::uint32_t k = grid_.ijk(face.first)[2];
        if (face.second == nobody) {
            const bool top = face.side == CellFace::k_minus;
            bool outer = true;
            const auto [i, j, unused] = grid_.ijk(face.first);
            for (std::uint32_t m = top ? 0 : k + 1; m < (top ? k : grid_.dims[2]); ++m)
                outer = outer && faces_.present[grid_.cell(i, j, m)] == 0;
            feature = {outer ? (top ? "top" : "base") : "gap", FeatureRole::boundary};
            return true;
        }
        const std::uint32_t below = grid_.ijk(face.second)[2];
        for (const std::uint32_t layer : request_.horizons) {
            if (layer > k && layer <= below) {
                feature = {"horizon " + std::to_string(layer), FeatureRole::horizon};
                return true;
            }
        }
        if (!within) feature = {"region boundary", FeatureRole::unknown};
        return !within;
    }

    bool is_throw(const GridFaces::Face& face) const {
        const auto a = grid_.ijk(face.first), b = grid_.ijk(face.second);
        if (a[2] != b[2]) return true;
        const bool along_i = face.side <= CellFace::i_plus;
        const std::array<unsigned, 4> near = along_i ? std::array<unsigned, 4>{1, 3, 5, 7} : std::array<unsigned, 4>{2, 3, 6, 7};
        for (const unsigned c : near) {
            const unsigned far = along_i ? c - 1 : c - 2;
            if (grid_.depths[corner_index(grid_.dims, a[0], a[1], a[2], c)] !=
                grid_.depths[corner_index(grid_.dims, b[0], b[1], b[2], far)])
                return true;
        }
        return false;
    }

    bool on_edge(const GridFaces::Face& face) const {
        const auto [i, j, k] = grid_.ijk(face.first);
        switch (face.side) {
            case CellFace::i_minus:
                return i == 0;
            case CellFace::i_plus:
                return i + 1 == grid_.dims[0];
            case CellFace::j_minus:
                return j == 0;
            default:
                return j + 1 == grid_.dims[1];
        }
    }

    bool has_cells_beside(const GridFaces::Face& face) const {
        auto [i, j, k] = grid_.ijk(face.first);
        if (face.side == CellFace::i_minus) --i;
        else if (face.side == CellFace::i_plus) ++i;
        else if (face.side == CellFace::j_minus) --j;
        else ++j;
        for (std::uint32_t m = 0; m < grid_.dims[2]; ++m) {
            if (faces_.present[grid_.cell(i, j, m)] != 0) return true;
        }
        return false;
    }

    void add_surfaces(const Key& key, const std::vector<Member>& members, Dataset& model, StatedModel& stated) const {
        const auto& [feature, back, front, way] = key;
        for (const Triangles& layer : layers_of(triangles_of(members))) {
            for (const Triangles& sheet : sheets_of(layer, back == front)) add_surface(key, sheet, model, stated);
        }
    }

    void add_surface(const Key& key, const Triangles& sheet, Dataset& model, StatedModel& stated) const {
        const auto& [feature, back, front, way] = key;
        Surface surface;
        surface.info.name = feature.name;
        surface.info.role = feature.role;
        surface.info.crs = grid_.info.crs;
        fill(surface, sheet);
        StatedModel::Face face;
        face.number = static_cast<std::int64_t>(stated.faces.size() + 1);
        face.object = static_cast<std::uint32_t>(model.objects.size());
        face.interface_name = feature.name;
        face.role = feature.role;
        const auto number = static_cast<std::uint32_t>(stated.faces.size());
        stated.regions[back].sides.push_back({number, false});
        if (front != nobody) stated.regions[front].sides.push_back({number, true});
        stated.faces.push_back(std::move(face));
        model.objects.emplace_back(std::move(surface));
        if (sources_ == nullptr) return;
        sources_->sides.emplace_back();
        for (const std::uint32_t f : sheet.face) sources_->sides.back().push_back({faces_.faces[f].first, faces_.faces[f].second});
    }

    Triangles triangles_of(const std::vector<Member>& members) const {
        Triangles all;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (const Member& m : members) {
            face_triangles(faces_.polygon(m.face), faces_.points, triangles);
            // Normals point to the front: out of the region behind.
            if (outward_ == m.turned) {
                for (auto& t : triangles) std::swap(t[1], t[2]);
            }
            all.corners.insert(all.corners.end(), triangles.begin(), triangles.end());
            all.face.insert(all.face.end(), triangles.size(), m.face);
        }
        return all;
    }

    // Where cells are pinched, open faces may have triangles in common: a surface holds each but once.
    static std::vector<Triangles> layers_of(const Triangles& all) {
        std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>> sorted(all.corners.size());
        for (std::size_t t = 0; t < sorted.size(); ++t) {
            sorted[t] = {all.corners[t], t};
            std::ranges::sort(sorted[t].first);
        }
        std::ranges::sort(sorted);
        std::vector<std::size_t> layer(sorted.size(), 0);
        for (std::size_t n = 1; n < sorted.size(); ++n) {
            if (sorted[n].first == sorted[n - 1].first) layer[sorted[n].second] = layer[sorted[n - 1].second] + 1;
        }
        std::vector<Triangles> layers;
        for (std::size_t t = 0; t < layer.size(); ++t) {
            if (layer[t] >= layers.size()) layers.resize(layer[t] + 1);
            layers[layer[t]].add(all, t, false);
        }
        return layers;
    }

    // The plane of faces (all between two rows of columns, or two layers) that a triangle is from.
    std::uint64_t plane_of(std::uint32_t f) const {
        const GridFaces::Face& face = faces_.faces[f];
        const auto at = grid_.ijk(face.first);
        const std::size_t axis = static_cast<std::size_t>(face.side) / 2;
        return 4 * (std::uint64_t{at[axis]} + (static_cast<unsigned>(face.side) & 1u)) + axis;
    }

    // Turning a surface changes nothing only where one region is on both of its sides.
    std::vector<Triangles> sheets_of(const Triangles& layer, bool may_turn) const {
        std::vector<std::uint64_t> planes;
        planes.reserve(layer.face.size());
        for (const std::uint32_t f : layer.face) planes.push_back(plane_of(f));
        const TriangleSheets parted = triangle_sheets(layer.corners, planes, may_turn);
        std::vector<Triangles> sheets(parted.count);
        for (std::size_t t = 0; t < layer.face.size(); ++t) sheets[parted.sheet[t]].add(layer, t, parted.turned[t] != 0);
        return sheets;
    }

    void fill(Surface& surface, const Triangles& sheet) const {
        std::vector<std::uint32_t> nodes;
        for (const auto& t : sheet.corners) nodes.insert(nodes.end(), t.begin(), t.end());
        std::ranges::sort(nodes);
        nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
        for (const std::uint32_t n : nodes) surface.points.push_back(faces_.points[n]);
        for (const auto& t : sheet.corners) {
            for (const std::uint32_t n : t)
                surface.polygons.corners.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(nodes, n) - nodes.begin()));
        }
    }

    const CornerPointGrid& grid_;
    const ModelRequest& request_;
    ModelSources* sources_;
    GridFaces faces_;
    FaultFaces stated_;
    bool outward_;  // polygons leave their first cell, elevation-up
    std::vector<std::uint32_t> region_;
    std::vector<std::string> region_names_;
    std::map<Key, std::vector<Member>> groups_;
};

}  // namespace

Result<Dataset> boundary_model(const CornerPointGrid& grid, const ModelRequest& request, ModelSources* sources) {
    return Maker(grid, request, sources).make();
}

}  // namespace geomend::grid
