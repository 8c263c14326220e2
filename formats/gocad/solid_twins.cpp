// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/solid_twins.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/disjoint_sets.h"
#include "formats/gocad/region_indicators.h"
#include "model/attribute_operations.h"

namespace geomend::gocad {

namespace {

class Splitter {
public:
    Splitter(const CellMesh& mesh, const SolidPlan& plan) : mesh_(mesh), plan_(plan), first_(mesh.points.size(), no_index) {}

    std::optional<CellMesh> run() {
        if (!mesh_.alias.empty() || plan_.volumes.size() < 2 || mesh_.points.size() + mesh_.nodes.size() >= no_index) return {};
        split_.nodes = mesh_.nodes;
        number_nodes();
        if (source_.size() == mesh_.points.size()) return {};
        take_first_twins();
        split_.types = mesh_.types;
        split_.offsets = mesh_.offsets;
        split_.points.reserve(source_.size());
        for (const std::uint32_t node : source_) split_.points.push_back(mesh_.points[node]);
        label_nodes();
        split_.info = mesh_.info;
        for (Attribute& a : split_.info.attributes) {
            if (a.location == AttributeLocation::point) a.values = taken(a.values, source_, a.components);
        }
        for (NamedSet& set : split_.info.sets) {
            if (set.location == AttributeLocation::point) spread_set(set);
        }
        return std::move(split_);
    }

private:
    // --- which corners share a node ---

    struct Facet {
        std::array<std::uint32_t, 3> nodes;    // ascending
        std::array<std::uint32_t, 3> corners;  // places in mesh_.nodes, in that order
        std::uint32_t volume;
        bool on_surface;
    };

    template <class Take>
    void each_facet(const Take& take) const {
        std::size_t tag = 0;
        for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c) {
            if (plan_.volume_of[c] == no_index) continue;
            const auto first = static_cast<std::uint32_t>(mesh_.offsets[c]);
            for (std::uint32_t i = 0; i < 4; ++i, ++tag) {
                Facet facet{{}, {first + (i == 0 ? 1 : 0), first + (i <= 1 ? 2 : 1), first + (i <= 2 ? 3 : 2)}, plan_.volume_of[c], false};
                std::ranges::sort(facet.corners, {}, [&](std::uint32_t corner) { return mesh_.nodes[corner]; });
                for (std::size_t k = 0; k < 3; ++k) facet.nodes[k] = mesh_.nodes[facet.corners[k]];
                facet.on_surface = !plan_.facet_tags.empty() && plan_.facet_tags[tag].sign != 0;
                take(facet);
            }
        }
    }

    // Facets are sorted by their lowest node first, so that each sort is a small one.
    void join_corners() {
        joined_ = DisjointSets(mesh_.nodes.size());
        std::vector<std::size_t> begin(mesh_.points.size() + 1);
        each_facet([&](const Facet& f) { ++begin[f.nodes[0] + std::size_t{1}]; });
        for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
        std::vector<Facet> facets(begin.back());
        std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
        each_facet([&](const Facet& f) { facets[next[f.nodes[0]]++] = f; });
        for (std::size_t node = 0; node + 1 < begin.size(); ++node) {
            const std::span<Facet> of_node(facets.data() + begin[node], begin[node + 1] - begin[node]);
            std::ranges::sort(of_node, {}, &Facet::nodes);
            for (std::size_t i = 1; i < of_node.size(); ++i) {
                const Facet &a = of_node[i - 1], &b = of_node[i];
                if (a.nodes != b.nodes || a.volume != b.volume || a.on_surface || b.on_surface) continue;
                for (std::size_t k = 0; k < 3; ++k) joined_.join(a.corners[k], b.corners[k]);
            }
        }
    }

    void number_nodes() {
        join_corners();
        std::vector<std::uint32_t> number(mesh_.nodes.size(), no_index);  // per root
        std::vector<std::pair<std::uint32_t, std::uint32_t>> own;         // node, root
        source_.reserve(mesh_.points.size());
        for (const SolidPlan::Volume& volume : plan_.volumes) {
            own.clear();
            for (const std::uint32_t c : volume.cells) {
                for (std::uint64_t i = mesh_.offsets[c]; i < mesh_.offsets[c + 1]; ++i) {
                    const std::uint32_t r = joined_.root(static_cast<std::uint32_t>(i));
                    if (r == i) own.emplace_back(mesh_.nodes[i], r);
                }
            }
            std::ranges::sort(own);
            for (const auto& [node, r] : own) number[r] = add_node(node);
            for (const std::uint32_t c : volume.cells) {
                for (std::uint64_t i = mesh_.offsets[c]; i < mesh_.offsets[c + 1]; ++i) {
                    split_.nodes[i] = number[joined_.root(static_cast<std::uint32_t>(i))];
                }
            }
        }
        for (std::uint32_t node = 0; node < first_.size(); ++node) {
            if (first_[node] == no_index) add_node(node);
        }
    }

    std::uint32_t add_node(std::uint32_t node) {
        const auto index = static_cast<std::uint32_t>(source_.size());
        source_.push_back(node);
        split_.alias.push_back(first_[node]);
        if (first_[node] == no_index) first_[node] = index;
        return index;
    }

    void take_first_twins() {
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            if (plan_.volume_of[c] != no_index) continue;
            for (std::uint64_t i = mesh_.offsets[c]; i < mesh_.offsets[c + 1]; ++i) split_.nodes[i] = first_[mesh_.nodes[i]];
        }
    }

    // Stated ids stay with their nodes; twins get new ones.
    void label_nodes() {
        split_.point_labels.first = mesh_.point_labels.first;
        const auto& ids = mesh_.point_labels.ids;
        if (ids.size() != mesh_.points.size() || ids.empty()) return;
        const std::int64_t last = *std::ranges::max_element(ids);
        if (last > largest_id_to_go_on_from) return;
        std::int64_t next = last + 1;
        for (std::size_t i = 0; i < source_.size(); ++i) {
            split_.point_labels.ids.push_back(split_.alias[i] == no_index ? ids[source_[i]] : next++);
        }
    }

    void spread_set(NamedSet& set) const {
        std::vector<bool> is_member(mesh_.points.size());
        for (const std::uint32_t node : set.members) is_member[node] = true;
        const bool flag = set.name.starts_with(control_set_prefix);
        set.members.clear();
        for (std::uint32_t i = 0; i < source_.size(); ++i) {
            if (is_member[source_[i]] && (!flag || split_.alias[i] == no_index)) set.members.push_back(i);
        }
    }

    static constexpr std::int64_t largest_id_to_go_on_from = 1'000'000'000'000;

    const CellMesh& mesh_;
    const SolidPlan& plan_;
    CellMesh split_;
    std::vector<std::uint32_t> source_;  // per node of the split mesh its node in the mesh
    DisjointSets joined_{0};             // corners (places in mesh_.nodes) that share their node
    std::vector<std::uint32_t> first_;   // per node of the mesh the first of its twins
};

}  // namespace

std::optional<CellMesh> split_at_volumes(const CellMesh& mesh, const SolidPlan& plan) { return Splitter(mesh, plan).run(); }

}  // namespace geomend::gocad
