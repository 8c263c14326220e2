// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geomend::hexes {

/// The tree of a graph without induced paths of four vertices (a cograph). Its leaves are the vertices of the graph; below an inner node
/// the vertices of different branches are all joined by edges, or none of them is. Vertices are inserted one by one; where the result
/// would be no cograph, as few edges as possible are added with each. Sources: D. Corneil, Y. Perl, L. Stewart, "A linear recognition
/// algorithm for cographs" (1985); D. Lokshtanov, F. Mancini, C. Papadopoulos, "Characterizing and computing minimal cograph completions"
/// (2010).
class Cotree {
public:
    /// \param vertices how many there may be
    /// \param complement edges are those between vertices that are not named as neighbours
    Cotree(std::size_t vertices, bool complement);

    /// \param neighbours of the vertex: those that are not in the tree do not count. \pre it is not in the tree
    /// Cost: as the depths of the neighbours.
    void insert(std::uint32_t vertex, std::span<const std::uint32_t> neighbours);

    /// The vertices of greatest weight in sum of which no two are joined; for a complement, of which all are: in terms of the graph itself
    /// no two are neighbours. Ascending. Linear.
    std::vector<std::uint32_t> heaviest(std::span<const double> weights) const;

    /// How many edges the graph has that the tree stands for: those that were named and those that were added. Linear.
    std::uint64_t edge_count() const;

private:
    struct Node {
        std::uint32_t parent, vertex;  ///< no_index: the root; an inner node
        bool joins = false;            ///< its branches, in the graph that the tree stands for
        std::uint32_t leaves = 1;
        std::vector<std::uint32_t> children;
        // Of the insertion at hand:
        std::uint32_t stamp = 0, hits = 0;  ///< leaves that were named
        std::vector<std::uint32_t> hit_children;
        std::uint64_t cost = 0;          ///< edges to add, at least
        std::uint32_t down = no_branch;  ///< the branch that the vertex goes into, or one of these:
    };
    static constexpr std::uint32_t no_branch = 0xffffffffu, all_of_it = 0xfffffffeu, some_branches = 0xfffffffdu;

    std::uint32_t hits(std::uint32_t node) const { return nodes_[node].stamp == stamp_ ? nodes_[node].hits : 0; }
    /// Leaves to which the vertex has an edge.
    std::uint32_t met(std::uint32_t node) const { return complement_ ? nodes_[node].leaves - hits(node) : hits(node); }
    std::uint32_t add_node(std::uint32_t parent, bool joins);
    std::uint32_t add_leaf(std::uint32_t vertex);
    void hang(std::uint32_t node, std::uint32_t parent);
    void count_hits(std::span<const std::uint32_t> neighbours);
    void plan(std::uint32_t node);
    void plan_all();
    void put_beside(std::uint32_t node, std::uint32_t leaf, bool joins);
    void put_into(std::uint32_t node, std::uint32_t leaf);
    void count_up(std::uint32_t node);

    bool complement_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leaf_of_;
    std::uint32_t root_, stamp_ = 0;
};

}  // namespace geomend::hexes
