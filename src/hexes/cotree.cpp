// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/cotree.h"

#include <algorithm>

#include "model/objects.h"

namespace geomend::hexes {

Cotree::Cotree(std::size_t vertices, bool complement) : complement_(complement), leaf_of_(vertices, no_index), root_(no_index) {}

std::uint32_t Cotree::add_node(std::uint32_t parent, bool joins) {
    Node node;
    node.parent = parent;
    node.vertex = no_index;
    node.joins = joins;
    node.leaves = 0;
    nodes_.push_back(std::move(node));
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t Cotree::add_leaf(std::uint32_t vertex) {
    const std::uint32_t leaf = add_node(no_index, false);
    nodes_[leaf].vertex = vertex;
    nodes_[leaf].leaves = 1;
    leaf_of_[vertex] = leaf;
    return leaf;
}

/// Does not count leaves of the nodes above.
void Cotree::hang(std::uint32_t node, std::uint32_t parent) {
    nodes_[node].parent = parent;
    nodes_[parent].children.push_back(node);
    nodes_[parent].leaves += nodes_[node].leaves;
}

void Cotree::count_hits(std::span<const std::uint32_t> neighbours) {
    ++stamp_;
    for (const std::uint32_t v : neighbours) {
        if (leaf_of_[v] == no_index) continue;
        bool is_new = false;
        for (std::uint32_t node = leaf_of_[v], below = no_index; node != no_index; below = node, node = nodes_[node].parent) {
            Node& n = nodes_[node];
            if (below != no_index && is_new) {
                if (n.stamp != stamp_) n.hit_children.clear();
                n.hit_children.push_back(below);
            }
            is_new = n.stamp != stamp_;
            if (is_new && below == no_index) n.hit_children.clear();
            n.hits = is_new ? 1 : n.hits + 1;
            n.stamp = stamp_;
        }
    }
}

/// The cheapest way to put the vertex into a node some leaves of which it meets. \pre its partly met branches are planned
void Cotree::plan(std::uint32_t number) {
    Node& n = nodes_[number];
    const auto missing = [&](std::uint32_t node) { return std::uint64_t{nodes_[node].leaves - met(node)}; };
    n.cost = missing(number);
    n.down = all_of_it;
    // Branches that are met in part, and those that are not met: the others are met all over. Of a complement, those without a hit are.
    std::uint64_t in_part = 0, met_branches = complement_ ? n.children.size() : 0, the_one = no_index;
    std::uint64_t to_fill = 0;
    for (const std::uint32_t c : n.hit_children) {
        const bool is_met = met(c) > 0;
        if (complement_ && !is_met) --met_branches;
        if (!complement_ && is_met) ++met_branches;
        if (!is_met || met(c) == nodes_[c].leaves) continue;
        ++in_part;
        the_one = c;
        to_fill += missing(c);
    }
    const bool has_unmet = met_branches < n.children.size();
    if (has_unmet && to_fill < n.cost) n.cost = to_fill, n.down = some_branches;
    if (!n.joins) {
        // Into a branch alone where no other one is met.
        if (in_part == 1 && met_branches == 1 && nodes_[the_one].cost < n.cost)
            n.cost = nodes_[the_one].cost, n.down = static_cast<std::uint32_t>(the_one);
        return;
    }
    const std::uint64_t all = missing(number);
    for (const std::uint32_t c : n.hit_children) {
        if (met(c) == 0 || met(c) == nodes_[c].leaves) continue;
        const std::uint64_t cost = nodes_[c].cost + all - missing(c);
        if (cost < n.cost) n.cost = cost, n.down = c;
    }
}

/// Plans each node that is met in part, branches first.
void Cotree::plan_all() {
    std::vector<std::uint32_t> order{root_};
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const std::uint32_t c : nodes_[order[i]].hit_children) {
            if (met(c) > 0 && met(c) < nodes_[c].leaves) order.push_back(c);
        }
    }
    for (auto node = order.rbegin(); node != order.rend(); ++node) plan(*node);
}

/// Makes a node and the leaf the two branches of a new one, or the leaf a branch of the node where that is the same.
void Cotree::put_beside(std::uint32_t node, std::uint32_t leaf, bool joins) {
    if (nodes_[node].vertex == no_index && nodes_[node].joins == joins) {
        hang(leaf, node);
        count_up(nodes_[node].parent);
        return;
    }
    const std::uint32_t above = nodes_[node].parent, made = add_node(above, joins);
    if (above == no_index) root_ = made;
    else *std::ranges::find(nodes_[above].children, node) = made;
    hang(node, made);
    hang(leaf, made);
    count_up(above);
}

/// The branches that are met (or, where the node joins, those that are not) become one, with the leaf beside them.
void Cotree::put_into(std::uint32_t number, std::uint32_t leaf) {
    const bool joins = nodes_[number].joins;
    std::vector<std::uint32_t> apart, stay;
    for (const std::uint32_t c : nodes_[number].children) ((met(c) > 0) != joins ? apart : stay).push_back(c);
    if (apart.size() == 1) return put_beside(apart.front(), leaf, !joins);
    const std::uint32_t both = add_node(number, !joins), group = add_node(both, joins);
    nodes_[number].children = std::move(stay);
    nodes_[number].children.push_back(both);
    for (const std::uint32_t c : apart) hang(c, group);
    nodes_[both].children = {group};
    nodes_[both].leaves = nodes_[group].leaves;
    hang(leaf, both);
    count_up(number);
}

void Cotree::count_up(std::uint32_t node) {
    for (; node != no_index; node = nodes_[node].parent) ++nodes_[node].leaves;
}

void Cotree::insert(std::uint32_t vertex, std::span<const std::uint32_t> neighbours) {
    count_hits(neighbours);
    const std::uint32_t leaf = add_leaf(vertex);
    if (root_ == no_index) {
        root_ = leaf;
        return;
    }
    const std::uint32_t met_all = met(root_);
    if (met_all == 0 || met_all == nodes_[root_].leaves) return put_beside(root_, leaf, met_all > 0);
    plan_all();
    std::uint32_t node = root_;
    while (nodes_[node].down < some_branches) node = nodes_[node].down;
    if (nodes_[node].down == all_of_it) put_beside(node, leaf, true);
    else put_into(node, leaf);
}

std::uint64_t Cotree::edge_count() const {
    std::uint64_t count = 0;
    std::vector<std::uint32_t> open;
    if (root_ != no_index) open.push_back(root_);
    while (!open.empty()) {
        const Node& n = nodes_[open.back()];
        open.pop_back();
        open.insert(open.end(), n.children.begin(), n.children.end());
        if (!n.joins) continue;
        std::uint64_t before = 0;
        for (const std::uint32_t c : n.children) {
            count += before * nodes_[c].leaves;
            before += nodes_[c].leaves;
        }
    }
    return count;
}

std::vector<std::uint32_t> Cotree::heaviest(std::span<const double> weights) const {
    if (root_ == no_index) return {};
    std::vector<std::uint32_t> order{root_};
    for (std::size_t i = 0; i < order.size(); ++i)
        order.insert(order.end(), nodes_[order[i]].children.begin(), nodes_[order[i]].children.end());
    std::vector<double> best(nodes_.size(), 0);
    const auto takes_one = [&](const Node& n) { return n.joins != complement_; };
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        const Node& n = nodes_[*at];
        if (n.vertex != no_index) best[*at] = weights[n.vertex];
        for (const std::uint32_t c : n.children) best[*at] = takes_one(n) ? std::max(best[*at], best[c]) : best[*at] + best[c];
    }
    std::vector<std::uint32_t> taken, open{root_};
    while (!open.empty()) {
        const Node& n = nodes_[open.back()];
        open.pop_back();
        if (n.vertex != no_index) taken.push_back(n.vertex);
        else if (takes_one(n)) open.push_back(*std::ranges::max_element(n.children, {}, [&](std::uint32_t c) { return best[c]; }));
        else open.insert(open.end(), n.children.begin(), n.children.end());
    }
    std::ranges::sort(taken);
    return taken;
}

}  // namespace geomend::hexes
