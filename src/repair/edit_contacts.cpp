// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/edit_contacts.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/vectors.h"
#include "repair/soup_edges.h"
#include "repair/soup_edit.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

void sort_out(std::vector<std::uint32_t>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// What each edge between what is taken out and the rest says.
class ContactReader {
public:
    ContactReader(const SurfaceModel& model, std::span<const PatchEdit> edits)
        : soup_(model.model.soup), edits_(edits), interfaces_(interface_numbers(model)) {}

    /// Vertices at which what is taken out goes on through others, ascending.
    const std::vector<std::uint32_t>& passing() const { return passing_; }

    Detached read() {
        const SoupEdges edges = edges_of(soup_);
        for (std::size_t e = 0; e < edges.size(); ++e) read_edge(edges[e]);
        std::ranges::sort(found_.lines);
        for (const auto& [a, b] : found_.lines) found_.trace.insert(found_.trace.end(), {a, b});
        sort_out(found_.trace);
        sort_out(passing_);
        for (auto& [group, interfaces] : found_.replaced_endings) sort_out(interfaces);
        return std::move(found_);
    }

private:
    const PatchEdit& edit_of(const SoupEdges::Use& use) const { return edits_[soup_.patches[use.triangle]]; }

    void read_edge(std::span<const SoupEdges::Use> uses) {
        std::vector<SoupEdges::Use> out, rest;
        for (const auto& use : uses) (edit_of(use).taken_out ? out : rest).push_back(use);
        const bool several = std::ranges::any_of(out, [&](const auto& u) { return edit_of(u).group != edit_of(out.front()).group; });
        if (out.empty() || (rest.empty() && !several)) return;
        found_.lines.push_back({uses[0].low, uses[0].high});
        for (const auto& use : out) {
            std::size_t own = 0;  // of its group: where there are two it passes through
            std::vector<std::uint32_t> others;
            for (const auto& other : uses) {
                const bool same = edit_of(other).taken_out && edit_of(other).group == edit_of(use).group;
                if (same) ++own;
                else if (!edit_of(other).removed || edit_of(other).replaced)
                    others.push_back(interfaces_.of[soup_.patches[other.triangle]]);
            }
            if (own > 1) passing_.insert(passing_.end(), {use.low, use.high});
            if (own != 1 || others.empty()) continue;
            if (edit_of(use).replaced) {
                auto& all = found_.replaced_endings[edit_of(use).group];
                all.insert(all.end(), others.begin(), others.end());
            } else if (!edit_of(use).removed) {
                add(use, std::move(others));
            }
        }
        if (rest.size() != 1) return;
        std::vector<std::uint32_t> controllers;
        for (const auto& use : out) {
            if (!edit_of(use).removed || edit_of(use).replaced) controllers.push_back(interfaces_.of[soup_.patches[use.triangle]]);
        }
        if (!controllers.empty()) add(rest.front(), std::move(controllers));
    }

    void add(const SoupEdges::Use& use, std::vector<std::uint32_t> controllers) {
        sort_out(controllers);
        found_.endings.push_back({use.low, use.high, soup_.patches[use.triangle], std::move(controllers)});
    }

    const TriangleSoup& soup_;
    std::span<const PatchEdit> edits_;
    InterfaceNumbers interfaces_;
    Detached found_;
    std::vector<std::uint32_t> passing_;
};

}  // namespace

InterfaceNumbers interface_numbers(const SurfaceModel& model) {
    std::map<std::string_view, std::uint32_t> known;
    InterfaceNumbers numbers;
    for (const auto& patch : model.model.patches)
        numbers.of.push_back(known.emplace(patch.interface_name, static_cast<std::uint32_t>(known.size())).first->second);
    numbers.count = static_cast<std::uint32_t>(known.size());
    return numbers;
}

namespace {

/// Of vertices of several surfaces at one place the first is named as where they come from: those that go their own way are from now on
/// from their own.
void name_own_origins(SurfaceModel& model, std::span<const PatchEdit> edits) {
    for (std::uint32_t t = 0; t < model.model.soup.triangles.size(); ++t) {
        const std::uint32_t from = model.origin.triangles[t];
        if (!edits[model.model.soup.patches[t]].taken_out || from == no_index) continue;
        for (const std::uint32_t v : model.model.soup.triangles[t]) {
            std::uint32_t& named = model.origin.vertices[v].vertex;
            if (named == no_index) continue;
            for (const std::uint32_t own : model.source.triangles[from]) {
                if (model.source.vertices[own] == model.source.vertices[named]) named = own;
            }
        }
    }
}

}  // namespace

Detached detach(SurfaceModel& model, std::span<const PatchEdit> edits) {
    ContactReader reader(model, edits);
    Detached found = reader.read();
    const TriangleSoup& soup = model.model.soup;
    TriangleSoup made;
    Origin origin;
    made.vertices = soup.vertices;
    for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) origin.vertices.push_back(Origin::from_vertex(v));
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> moved;  // group, vertex -> vertex of its own
    const auto own_vertex = [&](const PatchEdit& edit, std::uint32_t v) {
        const auto [at, is_new] = moved.emplace(std::pair(edit.group, v), static_cast<std::uint32_t>(made.vertices.size()));
        if (is_new) {
            made.vertices.push_back(plus(soup.vertices[v], edit.by));
            origin.vertices.push_back(Origin::from_vertex(v));
        }
        return at->second;
    };
    std::vector<std::uint32_t> removed;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const PatchEdit& edit = edits[soup.patches[t]];
        if (edit.removed) removed.push_back(t);
        if (edit.removed) continue;
        Triangle tri = soup.triangles[t];
        if (edit.taken_out) {
            for (std::uint32_t& v : tri) v = own_vertex(edit, v);
        }
        made.triangles.push_back(tri);
        made.patches.push_back(soup.patches[t]);
        origin.triangles.push_back(t);
    }
    for (std::size_t e = 0; e < soup.edges.size(); ++e) {
        const auto& [a, b] = soup.edges[e];
        if (std::ranges::binary_search(found.lines, std::array{std::min(a, b), std::max(a, b)})) continue;
        made.edges.push_back(soup.edges[e]);
        made.edge_ids.push_back(soup.edge_ids[e]);
    }
    for (EndingEdge& ending : found.endings) {
        const PatchEdit& edit = edits[ending.patch];
        if (!edit.taken_out) continue;
        ending.a = own_vertex(edit, ending.a);
        ending.b = own_vertex(edit, ending.b);
    }
    const auto lines = found.lines;
    for (const auto& [group_vertex, own] : moved) {
        if (std::ranges::binary_search(reader.passing(), group_vertex.second)) found.trace.push_back(own);
    }
    for (const auto& [a, b] : lines) {
        for (const PatchEdit& edit : edits) {
            const auto from = moved.find({edit.group, a}), to = moved.find({edit.group, b});
            if (!edit.taken_out || from == moved.end() || to == moved.end()) continue;
            found.lines.push_back({std::min(from->second, to->second), std::max(from->second, to->second)});
        }
    }
    std::ranges::sort(found.lines);
    found.lines.erase(std::unique(found.lines.begin(), found.lines.end()), found.lines.end());
    sort_out(found.trace);
    found.moved = moved.size();
    note_removed(model, removed, Removal::edited);
    take_soup(model, std::move(made), origin);
    name_own_origins(model, edits);
    return found;
}

EndingParts ending_parts(const SurfaceModel& model, std::span<const EndingEdge> endings) {
    const TriangleSoup& soup = model.model.soup;
    EndingParts parts;
    parts.barriers.resize(model.model.patches.size());
    for (const EndingEdge& e : endings) {
        auto& own = parts.barriers[e.patch];
        own.insert(own.end(), e.controllers.begin(), e.controllers.end());
    }
    for (auto& own : parts.barriers) sort_out(own);
    std::vector<std::uint8_t> ends(soup.triangles.size(), 0);
    for (std::uint32_t t = 0; t < ends.size(); ++t) ends[t] = parts.barriers[soup.patches[t]].empty() ? 0 : 1;
    const Parts hanging = parts_of(soup, ends);
    parts.of = hanging.of;
    parts.count = hanging.count;
    return parts;
}

std::uint64_t drop_beyond(SurfaceModel& model, const EndingParts& parts, const Origin& origin) {
    const TriangleSoup& soup = model.model.soup;
    const InterfaceNumbers interfaces = interface_numbers(model);
    const SoupEdges edges = edges_of(soup);
    DisjointSets sets(soup.triangles.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        for (std::size_t i = 0; i < uses.size(); ++i) {
            const std::uint32_t patch = soup.patches[uses[i].triangle];
            const bool barred = std::ranges::any_of(uses, [&](const auto& use) {
                return soup.patches[use.triangle] != patch &&
                       std::ranges::binary_search(parts.barriers[patch], interfaces.of[soup.patches[use.triangle]]);
            });
            if (barred) continue;
            for (std::size_t j = i + 1; j < uses.size(); ++j) {
                if (soup.patches[uses[j].triangle] == patch) sets.join(uses[i].triangle, uses[j].triangle);
            }
        }
    }
    const auto part_of = [&](std::uint32_t t) { return origin.triangles[t] == no_index ? no_index : parts.of[origin.triangles[t]]; };
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> areas;  // part, piece
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (part_of(t) != no_index) areas[{part_of(t), sets.root(t)}] += triangle_area(soup, t);
    }
    std::vector<std::pair<double, std::uint32_t>> core(parts.count, {-1, no_index});
    for (const auto& [part_piece, area] : areas) {
        if (area > core[part_piece.first].first) core[part_piece.first] = {area, part_piece.second};
    }
    std::vector<std::uint8_t> keep(soup.triangles.size(), 1), is_core(soup.triangles.size(), 0);
    for (const auto& [area, piece] : core) {
        if (piece != no_index) is_core[piece] = 1;
    }
    std::uint64_t dropped = 0;
    for (std::uint32_t t = 0; t < keep.size(); ++t) {
        if (parts.barriers[soup.patches[t]].empty() || is_core[sets.root(t)] != 0) continue;
        keep[t] = 0;
        ++dropped;
    }
    if (dropped == 0) return 0;
    std::vector<std::uint8_t> noted(keep.size(), 1);
    note_removed(model, keep, noted, Removal::beyond);
    keep_triangles(model, keep);
    return dropped;
}

}  // namespace geomend::repair
