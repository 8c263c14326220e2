// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/node_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "formats/gocad/number_scan.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

namespace {

constexpr std::uint64_t most_nodes = no_index - 1;

// CNXYZ, CNXY, CNZ, ... after the values; bare XYZ in solids.
bool is_control_flag(std::string_view token) {
    if (token.starts_with("CN") || token.starts_with("cn")) token.remove_prefix(2);
    return !token.empty() && token.size() <= 3 && token.find_first_not_of("XYZxyz") == std::string_view::npos;
}

}  // namespace

void NodeTable::begin() {
    begun_ = true;
    head_.geometry_begun = true;
    const ObjectFrame& frame = scanner_.frame;
    const std::uint64_t expected = frame.node_lines;
    points.reserve(expected);
    ids_.expect(expected);
    values_.begin(head_.properties, AttributeLocation::point, expected, scanner_);
}

void NodeTable::add_id(std::int64_t id, std::uint64_t line) {
    if (!ids_.add(id)) {
        scanner_.log.add(
            "F009", line, 0, [&] { return "node " + std::to_string(id) + " is defined twice"; }, {}, id);
    }
}

const char* NodeTable::scan_vertex(const char* p, const char* end, bool with_values, std::uint64_t line) {
    if (!begun_) begin();
    if (with_values != (values_.width() != 0)) return nullptr;
    std::int64_t id = 0;
    Vec3 at;
    if (!scan_id(p, end, id) || !scan_real(p, end, at[0]) || !scan_real(p, end, at[1]) || !scan_real(p, end, at[2])) return nullptr;
    if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2])) return nullptr;
    if (!values_.scan(p, end)) return nullptr;
    p = scan_line_end(p, end);
    if (p == nullptr || points.size() >= most_nodes) return nullptr;
    add_id(id, line);
    points.push_back(at);
    if (with_values) values_.push(values_.width());
    return p;
}

const char* NodeTable::scan_atom(const char* p, const char* end, std::uint64_t line) {
    if (!begun_) begin();
    std::int64_t id = 0, reference = 0;
    if (!scan_id(p, end, id) || !scan_id(p, end, reference)) return nullptr;
    p = scan_line_end(p, end);
    if (p == nullptr || points.size() >= most_nodes) return nullptr;
    add_id(id, line);
    atoms_.push_back({size(), false, reference, line});
    points.push_back({});
    values_.push(0);
    return p;
}

bool NodeTable::take(std::string_view keyword, TextCursor& line) {
    const auto is = [&](std::string_view word) { return same_word(keyword, word); };
    if (is("VRTX")) read_vertex(line, false);
    else if (is("PVRTX")) read_vertex(line, true);
    else if (is("ATOM") || is("SHAREDVRTX")) read_atom(line, false);
    else if (is("PATOM") || is("SHAREDPVRTX")) read_atom(line, true);
    else return false;
    return true;
}

bool NodeTable::read_id(TextCursor& line, std::int64_t& id, std::string_view what) {
    line.at_line_end();
    const std::uint32_t column = line.column();
    const NumberStatus status = line.integer(id);
    if (status == NumberStatus::ok && id <= largest_id && id >= -largest_id) return true;
    scanner_.log.add("F005", line.line(), column, [&] {
        return "expected " + std::string(what) + " (a whole number), found '" + std::string(trimmed(line.line_text())) + "'";
    });
    return false;
}

void NodeTable::add_flag(std::string_view flag) {
    const auto known = std::ranges::find(flags_, flag, &FlagSet::flag);
    if (known != flags_.end()) known->nodes.push_back(size());
    else flags_.push_back({std::string(flag), {size()}});
}

// Values and control flags, in either order.
void NodeTable::read_tail(TextCursor& line, bool with_values) {
    read_values(values_, line, scanner_.log, [&](std::string_view token) {
        const bool flag = is_control_flag(token);
        if (flag) add_flag(token);
        return flag;
    });
    if (!with_values && values_.given() != 0) {
        scanner_.log.add(
            "F118", line.line(), 0,
            "a VRTX or ATOM line, which is for nodes without properties, has values: they are read as those of a PVRTX or PATOM");
    }
}

void NodeTable::read_vertex(TextCursor& line, bool with_values) {
    if (!begun_) begin();
    ObjectLog& log = scanner_.log;
    std::int64_t id = 0;
    if (!read_id(line, id, "a node id")) return;
    Vec3 at{};
    for (double& coordinate : at) {
        line.at_line_end();
        const std::uint32_t column = line.column();
        const NumberStatus status = line.real(coordinate);
        if (status == NumberStatus::ok && std::isfinite(coordinate)) continue;
        if (status == NumberStatus::ok) {
            log.add(
                "F006", line.line(), column,
                [&] {
                    return "expected finite coordinates of node " + std::to_string(id) + ", found '" +
                           std::string(trimmed(line.line_text())) + "'";
                },
                {}, id);
            coordinate = 0;
            continue;
        }
        log.add(
            "F005", line.line(), column,
            [&] {
                return "expected three coordinates of node " + std::to_string(id) + ", found '" + std::string(trimmed(line.line_text())) +
                       "'";
            },
            "coordinate", id);
        coordinate = 0;
        break;
    }
    if (points.size() >= most_nodes) return log.add("F014", line.line(), 0, "more than 4294967294 nodes in one object");
    read_tail(line, with_values);
    add_id(id, line.line());
    points.push_back(at);
}

void NodeTable::read_atom(TextCursor& line, bool with_values) {
    if (!begun_) begin();
    std::int64_t id = 0, reference = 0;
    if (!read_id(line, id, "a node id") || !read_id(line, reference, "the id of the node it stands at")) return;
    if (points.size() >= most_nodes) return scanner_.log.add("F014", line.line(), 0, "more than 4294967294 nodes in one object");
    bool own_values = with_values;
    if (with_values || !line.at_line_end()) {
        read_tail(line, with_values);
        own_values |= values_.given() != 0;
    } else {
        values_.push(0);
    }
    add_id(id, line.line());
    atoms_.push_back({size(), own_values, reference, line.line()});
    points.push_back({});
}

// An atom may point to an atom, forwards or backwards. Each chain is walked to its primary node, then its atoms are
// settled from the far end back, so that each atom is settled once.
void NodeTable::resolve_atoms() {
    if (atoms_.empty()) return;
    alias.assign(points.size(), no_index);
    constexpr std::uint32_t settled = no_index;
    std::vector<std::uint32_t> pending(points.size(), settled);  // node -> its atom, until it is settled
    for (std::uint32_t i = 0; i != atoms_.size(); ++i) pending[atoms_[i].node] = i;
    std::vector<std::uint32_t> chain;
    std::vector<std::uint8_t> in_chain(atoms_.size(), 0);
    for (std::uint32_t i = 0; i != atoms_.size(); ++i) {
        chain.clear();
        std::uint32_t node = atoms_[i].node;
        while (node != no_index && pending[node] != settled) {
            const Atom& atom = atoms_[pending[node]];
            if (in_chain[pending[node]]) {
                scanner_.log.add(
                    "F007", atom.line, 0, [&] { return "the atoms refer to each other in a circle"; }, "circle", ids_.id_of(atom.node));
                node = no_index;
                break;
            }
            in_chain[pending[node]] = 1;
            chain.push_back(pending[node]);
            node = ids_.find(atom.reference);
            if (node == no_index) {
                scanner_.log.add(
                    "F007", atom.line, 0,
                    [&] {
                        return "ATOM " + std::to_string(ids_.id_of(atom.node)) + ": node " + std::to_string(atom.reference) +
                               " is not defined";
                    },
                    "atom", atom.reference);
            }
        }
        std::uint32_t next = node;  // what the last atom of the chain refers to
        for (auto link = chain.rbegin(); link != chain.rend(); ++link) {
            const Atom& atom = atoms_[*link];
            pending[atom.node] = settled;
            in_chain[*link] = 0;
            if (next != no_index) {
                alias[atom.node] = alias[next] != no_index ? alias[next] : next;
                points[atom.node] = points[next];
                if (!atom.own_values) values_.copy(next, atom.node);
            }
            next = next == no_index ? no_index : atom.node;
        }
    }
}

void NodeTable::finish() {
    if (!begun_ && head_.properties.declared()) begin();
    if (values_.width() == 0 && head_.properties.declared() && !scanner_.log.has_error()) {
        scanner_.log.add("F012", scanner_.frame.line, 0, "PROPERTIES stands after the first node: expected it before the nodes");
    }
    resolve_atoms();
    if (head_.depth()) {
        for (Vec3& at : points) at[2] = -at[2];
    }
    values_.finish(head_.info.attributes);
    for (FlagSet& set : flags_) {
        head_.info.sets.push_back({std::string(control_set_prefix) + set.flag, AttributeLocation::point, std::move(set.nodes)});
    }
}

NodeWriter::NodeWriter(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& alias, const Labels& labels,
                       const ObjectInfo& info, std::vector<const Attribute*> attributes)
    : points_(points), alias_(alias), labels_(labels), attributes_(std::move(attributes)), sign_(z_sign(info.crs)) {
    for (const NamedSet& set : info.sets) {
        if (set.location == AttributeLocation::point && set.name.starts_with(control_set_prefix)) flags_.push_back(&set);
    }
}

void NodeWriter::append_flags(std::string& out, std::size_t index) const {
    for (const NamedSet* set : flags_) {
        if (!std::ranges::binary_search(set->members, static_cast<std::uint32_t>(index))) continue;
        out += ' ';
        out.append(set->name, control_set_prefix.size());
    }
}

void NodeWriter::append(std::string& out, std::size_t first, std::size_t last, bool light) const {
    const bool with_values = !attributes_.empty();
    const std::string_view vertex = with_values ? "PVRTX " : "VRTX ";
    const std::string_view atom = light ? (with_values ? "SHAREDPVRTX " : "SHAREDVRTX ") : (with_values ? "PATOM " : "ATOM ");
    char line[160];  // a keyword, two ids or an id and three reals of at most 24 characters
    char* const end = line + sizeof line;
    for (std::size_t i = first; i != last; ++i) {
        const bool is_atom = !alias_.empty() && alias_[i] != no_index;
        const std::string_view keyword = is_atom ? atom : vertex;
        char* p = std::copy(keyword.begin(), keyword.end(), line);
        p = std::to_chars(p, end, labels_[i]).ptr;
        *p++ = ' ';
        if (is_atom) {
            p = std::to_chars(p, end, labels_[alias_[i]]).ptr;
        } else {
            p = std::to_chars(p, end, points_[i][0]).ptr;
            *p++ = ' ';
            p = std::to_chars(p, end, points_[i][1]).ptr;
            *p++ = ' ';
            p = std::to_chars(p, end, sign_ * points_[i][2]).ptr;
        }
        if (with_values || !flags_.empty()) {
            out.append(line, p);
            append_values(out, attributes_, i);
            append_flags(out, i);
            out += '\n';
        } else {
            *p++ = '\n';
            out.append(line, p);
        }
    }
}

Labels writable_labels(const Labels& labels, std::size_t count) {
    const auto fits = [](std::int64_t id) { return id <= largest_id && id >= 0; };
    Labels plain;
    if (labels.ids.empty()) {
        if (fits(labels.first) && labels.first < 1'000'000'000'000) plain.first = labels.first;
        return plain;
    }
    if (labels.ids.size() != count || !std::ranges::all_of(labels.ids, fits)) return plain;
    NodeIds ids;
    ids.expect(count);
    for (const std::int64_t id : labels.ids) {
        if (!ids.add(id)) return plain;
    }
    return labels;
}

}  // namespace geomend::gocad
