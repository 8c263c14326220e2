// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/gmsh/reading.h"
#include "model/annotations.h"

namespace geomend::gmsh {

namespace {

struct DataHead {
    std::string name;
    std::string interpolation;
    double time = 0;
    std::vector<double> further_reals;
    std::int64_t step = 0;
    std::int64_t components = 1;
    std::uint64_t entries = 0;
};

enum class DataKind : std::uint8_t { node, element, element_node };

std::string unquoted(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    return std::string(text);
}

// The head is text in binary files, too: each string, real and integer on a line of its own.
DataHead take_head(Scanner& s) {
    const Encoding encoding = s.encoding();
    s.set_encoding({});
    DataHead head;
    const std::uint64_t strings = s.count("number of string tags", 1, 1);
    s.line();
    for (std::uint64_t i = 0; i < strings && !s.failed(); ++i) {
        const std::string_view text = s.line();
        if (i == 0) head.name = unquoted(text);
        else if (i == 1) head.interpolation = unquoted(text);
    }
    const std::uint64_t reals = s.count("number of real tags", 1, 1);
    for (std::uint64_t i = 0; i < reals && !s.failed(); ++i) {
        const double value = s.real("a real tag");
        if (i == 0) head.time = value;
        else head.further_reals.push_back(value);
    }
    const std::uint64_t integers = s.count("number of integer tags", 1, 1);
    std::int64_t entries = 0;
    for (std::uint64_t i = 0; i < integers && !s.failed(); ++i) {
        const std::int64_t value = s.integer("an integer tag");
        if (i == 0) head.step = value;
        else if (i == 1) head.components = value;
        else if (i == 2) entries = value;
    }
    if (!s.failed() && integers < 3)
        s.fail("F012", "expected at least 3 integer tags (time step, components, entries), found " + std::to_string(integers),
               s.last_number());
    // More components than a tensor of many layers are a damaged count.
    if (!s.failed() && (head.components < 1 || head.components > 256)) {
        s.fail("F012", "the number of components is 1 to 256, found " + std::to_string(head.components), s.last_number());
    }
    if (encoding.binary && !s.failed()) s.line();
    s.set_encoding(encoding);
    const auto components = static_cast<std::uint64_t>(std::max<std::int64_t>(head.components, 1));
    if (s.fits(entries, "number of entries", 4 + 8 * components, 1 + components)) head.entries = static_cast<std::uint64_t>(entries);
    return head;
}

std::uint32_t cell_of_tag(Reading& r, std::int64_t tag) {
    const std::uint32_t cell = r.cells.find(tag);
    if (cell != no_index || r.repeated.empty()) return cell;
    const auto at = r.repeated.find(tag);
    return at == r.repeated.end() ? no_index : at->second;
}

// Values of one section before they become an attribute.
struct Values {
    std::vector<double> data;
    std::vector<std::uint8_t> has;  // per thing
    std::uint64_t filled = 0;
    std::uint64_t twice = 0;
};

// A sentinel that none of the values is.
double free_no_data(std::span<const double> values) {
    for (const double candidate : {-99999.0, -999999.0, -9999999.0, -1e20, -1e30, -1e35}) {
        const bool used = std::ranges::any_of(values, [&](double v) { return static_cast<float>(v) == static_cast<float>(candidate); });
        if (!used) return candidate;
    }
    return std::numeric_limits<double>::lowest();
}

void annotate(Attribute& a, const char* key, std::string value) { a.annotations.emplace_back(key, std::move(value)); }

// Another part (partition, entity) of the same view and step: fills what is missing.
Attribute* same_view(Reading& r, const DataHead& head, AttributeLocation location, std::size_t components, bool per_node) {
    for (Attribute& a : r.mesh.info.attributes) {
        if (a.location != location || a.components != components || !a.no_data) continue;
        const std::string* view = find_annotation(a, "gmsh.view");
        const std::string* step = find_annotation(a, "gmsh.step");
        const bool same = (view != nullptr ? *view : a.name) == head.name && (step != nullptr ? *step : "0") == std::to_string(head.step) &&
                          a.corner_values.has_value() == per_node;
        if (same) return &a;
    }
    return nullptr;
}

std::string free_name(const Reading& r, const DataHead& head, AttributeLocation location) {
    const auto taken = [&](const std::string& name) { return find_attribute(r.mesh.info.attributes, name, location) != nullptr; };
    std::string name = head.name.empty() ? "data" : head.name;
    if (!taken(name)) return name;
    name += " [step " + std::to_string(head.step) + "]";
    std::string numbered = name;
    for (int i = 2; taken(numbered); ++i) numbered = name + " (" + std::to_string(i) + ")";
    return numbered;
}

bool fill_missing(Attribute& into, const Values& from) {
    auto& target = std::get<std::vector<double>>(into.values);
    const std::size_t n = into.components;
    const double missing = *into.no_data;
    bool left = false;
    if (std::ranges::any_of(from.data, [&](double v) { return v == missing; })) return false;
    for (std::size_t i = 0; i < from.has.size(); ++i) {
        if (from.has[i] == 0) {
            left |= target[i * n] == missing;
            continue;
        }
        std::copy_n(from.data.begin() + static_cast<std::ptrdiff_t>(i * n), n, target.begin() + static_cast<std::ptrdiff_t>(i * n));
    }
    if (!left) into.no_data.reset();
    return true;
}

void tell_twice(Reading& r, const std::string& name, std::uint64_t count) {
    drop(r.findings, r.losses,
         {.entity = name,
          .what = "values",
          .why = "they are given twice for the same node or element: the first ones are kept",
          .count = count,
          .where = {r.input.name()},
          .code = "F107",
          .message = "data '" + name + "' give values twice for the same node or element: the first ones are kept"});
}

void add_attribute(Reading& r, const DataHead& head, DataKind kind, std::size_t components, Values values, bool padded) {
    const AttributeLocation location = kind == DataKind::node ? AttributeLocation::point : AttributeLocation::cell;
    if (values.twice > 0) tell_twice(r, head.name, values.twice);
    const bool partial = padded || values.filled < values.has.size();
    if (Attribute* known = same_view(r, head, location, components, kind == DataKind::element_node); known != nullptr && !padded) {
        if (fill_missing(*known, values)) return;
    }
    Attribute a;
    a.name = free_name(r, head, location);
    a.location = location;
    a.components = static_cast<std::uint32_t>(components);
    if (a.name != head.name) annotate(a, "gmsh.view", head.name);
    if (head.step != 0) annotate(a, "gmsh.step", std::to_string(head.step));
    if (head.time != 0) annotate(a, "gmsh.time", number_text(head.time));
    if (!head.interpolation.empty()) annotate(a, "gmsh.interpolation", head.interpolation);
    if (kind == DataKind::element_node) a.corner_values = CornerValues{static_cast<std::uint32_t>(head.components), {}, false};
    if (partial) {
        a.no_data = free_no_data(values.data);
        for (std::size_t i = 0; i < values.has.size(); ++i) {
            if (values.has[i] != 0) continue;
            std::fill_n(values.data.begin() + static_cast<std::ptrdiff_t>(i * components), components, *a.no_data);
        }
        if (padded) {
            for (double& v : values.data) {
                if (std::isnan(v)) v = *a.no_data;
            }
        }
    }
    a.values = std::move(values.data);
    r.mesh.info.attributes.push_back(std::move(a));
}

// Few entries over many things make much memory of few bytes; this bounds what a whole file may ask for.
bool affordable(Reading& r, Scanner& s, std::uint64_t things, std::uint64_t components) {
    constexpr std::uint64_t free_bytes = std::uint64_t{64} << 20;
    r.attribute_bytes += things * components * 8;
    if (r.attribute_bytes <= free_bytes + 64 * std::uint64_t{r.input.bytes().size()}) return true;
    s.fail("F014", "the data sections ask for far more memory than the file has bytes");
    return false;
}

void take_values(Reading& r, Scanner& s, const DataHead& head, DataKind kind, Values& values) {
    const auto n = static_cast<std::size_t>(head.components);
    const bool nodes = kind == DataKind::node;
    const std::size_t things = nodes ? r.mesh.points.size() : r.mesh.cell_count();
    if (!affordable(r, s, things, n)) return;
    values.data.resize(things * n);
    values.has.assign(things, 0);
    for (std::uint64_t i = 0; i < head.entries && !s.failed(); ++i) {
        const std::int64_t tag = s.integer(nodes ? "a node tag" : "an element tag");
        const std::uint32_t index = nodes ? r.nodes.find(tag) : cell_of_tag(r, tag);
        if (s.failed()) return;
        if (index == no_index) {
            s.fail("F007",
                   "data '" + head.name + "' name " + (nodes ? "node " : "element ") + std::to_string(tag) + ", which is not defined",
                   s.last_number());
            return;
        }
        const bool keep = values.has[index] == 0;
        bool different = false;
        for (std::size_t k = 0; k < n; ++k) {
            const double v = s.real("a value");
            double& slot = values.data[index * n + k];
            if (keep) slot = v;
            else different |= slot != v;
        }
        if (keep) ++values.filled;
        values.twice += different ? 1 : 0;
        values.has[index] = 1;
    }
}

// Each entry: element, its number of nodes, then the components node by node. They become a cell property with the
// components of all nodes, in our order of the nodes; cells with fewer nodes than others are padded.
void take_element_node_values(Reading& r, Scanner& s, const DataHead& head, Values& values, std::size_t& components, bool& padded) {
    const auto n = static_cast<std::size_t>(head.components);
    std::size_t most_nodes = 0;
    for (std::size_t cell = 0; cell < r.mesh.cell_count(); ++cell) most_nodes = std::max(most_nodes, r.mesh.cell_nodes(cell).size());
    // Only cells that have entries count: find their size first.
    const char* start = s.position();
    std::size_t widest = 0;
    std::size_t narrowest = most_nodes;
    for (int pass = 0; pass < 2 && !s.failed(); ++pass) {
        s.jump(start);
        if (pass == 1) {
            components = std::max<std::size_t>(widest, 1) * n;
            padded = narrowest < widest;
            const std::size_t things = r.mesh.cell_count();
            if (!affordable(r, s, things, components)) return;
            values.data.assign(things * components, std::numeric_limits<double>::quiet_NaN());
            values.has.assign(things, 0);
        }
        for (std::uint64_t i = 0; i < head.entries && !s.failed(); ++i) {
            const std::int64_t tag = s.integer("an element tag");
            const std::uint32_t cell = cell_of_tag(r, tag);
            const std::int64_t nodes = s.integer("the number of nodes of the element");
            if (s.failed()) return;
            if (cell == no_index) {
                s.fail("F007", "data '" + head.name + "' name element " + std::to_string(tag) + ", which is not defined", s.last_number());
                return;
            }
            const std::size_t own = r.mesh.cell_nodes(cell).size();
            if (nodes != static_cast<std::int64_t>(own)) {
                s.fail("F008",
                       "element " + std::to_string(tag) + " has " + std::to_string(own) + " nodes, but its data are for " +
                           std::to_string(nodes),
                       s.last_number());
                return;
            }
            widest = std::max(widest, own);
            narrowest = std::min(narrowest, own);
            const ElementType* type = element_type_of(r.mesh.types[cell]);
            const std::size_t base = pass == 1 ? cell * components : 0;
            for (std::size_t file_node = 0; file_node < own; ++file_node) {
                std::size_t at = file_node;
                if (type != nullptr && type->order != nullptr) {
                    at = static_cast<std::size_t>(std::find(type->order, type->order + own, static_cast<std::uint8_t>(file_node)) -
                                                  type->order);
                }
                for (std::size_t k = 0; k < n; ++k) {
                    const double v = s.real("a value");
                    if (pass == 1 && values.has[cell] == 0) values.data[base + at * n + k] = v;
                }
            }
            if (pass == 1) {
                if (values.has[cell] == 0) ++values.filled;
                else ++values.twice;
                values.has[cell] = 1;
            }
        }
    }
}

}  // namespace

Result<void> read_data(Reading& r, const Section& section) {
    Scanner s(r.input, section.content, section.name, r.layout.encoding);
    const DataKind kind = section.name == "NodeData"      ? DataKind::node
                          : section.name == "ElementData" ? DataKind::element
                                                          : DataKind::element_node;
    if (r.options.monitor != nullptr && r.options.monitor->stopped()) return stopped(r.input);
    const DataHead head = take_head(s);
    if (s.failed()) return s.take_failure();
    if (kind != DataKind::node && !r.cells_indexed) {
        r.cells_indexed = true;
        if (const auto twice = r.cells.build(r.mesh.cell_labels, r.mesh.cell_count())) {
            return unreadable("F009", s.location(s.position()),
                              "element tag " + std::to_string(r.mesh.cell_labels[*twice]) + " is defined twice");
        }
    }
    Values values;
    bool padded = false;
    auto components = static_cast<std::size_t>(head.components);
    if (kind == DataKind::element_node) take_element_node_values(r, s, head, values, components, padded);
    else take_values(r, s, head, kind, values);
    s.expect_end();
    if (s.failed()) return s.take_failure();
    if (!head.further_reals.empty()) {
        list_dropped(r.losses, {LossClass::style, "data '" + head.name + "'", "further real tags", "only the time is kept",
                                head.further_reals.size()});
    }
    add_attribute(r, head, kind, components, std::move(values), padded);
    return {};
}

}  // namespace geomend::gmsh
