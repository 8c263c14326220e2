// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <set>

#include "formats/gmsh/writing.h"
#include "model/annotations.h"

namespace geomend::gmsh {

namespace {

// Clients show views of 1, 3 and 9 components.
std::uint32_t padded_components(std::uint32_t n) { return n <= 1 ? 1 : n <= 3 ? 3 : n <= 9 ? 9 : n; }

bool fits_double(const Attribute& a) {
    constexpr std::int64_t largest = std::int64_t{1} << 53;
    if (const auto* v = std::get_if<std::vector<std::int64_t>>(&a.values)) {
        return std::ranges::all_of(*v, [](std::int64_t x) { return x >= -largest && x <= largest; });
    }
    if (const auto* v = std::get_if<std::vector<std::uint64_t>>(&a.values)) {
        return std::ranges::all_of(*v, [](std::uint64_t x) { return x <= std::uint64_t{largest}; });
    }
    return true;
}

std::size_t things_of(const CellMesh& mesh, AttributeLocation location) {
    return location == AttributeLocation::point ? mesh.points.size() : mesh.cell_count();
}

// Why an attribute cannot go out; empty where it can.
const char* obstacle(const CellMesh& mesh, const Attribute& a) {
    const bool placed =
        a.location == AttributeLocation::point || a.location == AttributeLocation::cell || a.location == AttributeLocation::polygon;
    if (!placed) return "MSH holds properties of nodes and elements";
    if (std::holds_alternative<std::vector<std::string>>(a.values)) return "MSH holds numbers only";
    if (a.components == 0 || a.components > 256) return "MSH data have 1 to 256 components here";
    if (value_count(a) != things_of(mesh, a.location) * a.components) return "its number of values does not fit";
    if (!fits_double(a)) return "MSH holds doubles, which do not hold all of its integers";
    return nullptr;
}

template <class Target>
void convert_values(Attribute& a) {
    const auto& from = std::get<std::vector<double>>(a.values);
    std::vector<Target> to(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double v = from[i];
        if constexpr (std::is_integral_v<Target>) {
            if (!(v >= static_cast<double>(std::numeric_limits<Target>::min()) &&
                  v <= static_cast<double>(std::numeric_limits<Target>::max())) ||
                v != std::floor(v) || std::fabs(v) > 9007199254740992.0) {
                return;  // the file was changed: doubles they stay
            }
        }
        to[i] = static_cast<Target>(v);
    }
    a.values = std::move(to);
}

void restore_type(Attribute& a, const std::string& type) {
    if (!std::holds_alternative<std::vector<double>>(a.values)) return;
    if (type == "float32") convert_values<float>(a);
    else if (type == "int8") convert_values<std::int8_t>(a);
    else if (type == "uint8") convert_values<std::uint8_t>(a);
    else if (type == "int16") convert_values<std::int16_t>(a);
    else if (type == "uint16") convert_values<std::uint16_t>(a);
    else if (type == "int32") convert_values<std::int32_t>(a);
    else if (type == "uint32") convert_values<std::uint32_t>(a);
    else if (type == "int64") convert_values<std::int64_t>(a);
    else if (type == "uint64") convert_values<std::uint64_t>(a);
}

void restore_components(Attribute& a, std::uint32_t components) {
    auto* values = std::get_if<std::vector<double>>(&a.values);
    if (values == nullptr || components == 0 || components >= a.components) return;
    const std::size_t things = values->size() / a.components;
    for (std::size_t i = 0; i < things; ++i) {
        for (std::uint32_t k = 0; k < components; ++k) (*values)[i * components + k] = (*values)[i * a.components + k];
    }
    values->resize(things * components);
    values->shrink_to_fit();
    a.components = components;
    if (!a.component_names.empty()) a.component_names.resize(components);
}

std::string take_annotation(Attribute& a, std::string_view key) {
    std::string value;
    std::erase_if(a.annotations, [&](auto& pair) {
        if (pair.first != key) return false;
        value = std::move(pair.second);
        return true;
    });
    return value;
}

// Values of one attribute as doubles or floats (whose digits are fewer), thing by thing.
class Values {
public:
    Values(const Attribute& a, std::uint32_t file_components) : a_(a), components_(file_components) {
        doubles_ = std::get_if<std::vector<double>>(&a.values);
        floats_ = std::get_if<std::vector<float>>(&a.values);
    }
    bool missing(std::size_t thing) const {
        if (!a_.no_data) return false;
        for (std::size_t k = 0; k < a_.components; ++k) {
            if (at(thing * a_.components + k) != *a_.no_data) return false;
        }
        return true;
    }
    double at(std::size_t i) const { return doubles_ != nullptr ? (*doubles_)[i] : value_as_double(a_, i); }
    void put_text(std::size_t i, TextPiece& piece) const {
        if (floats_ != nullptr) piece.number((*floats_)[i]);
        else piece.number(at(i));
    }
    void put(std::size_t thing, std::uint32_t k, bool binary, TextPiece& piece) const {
        piece.need(64);
        const bool padding = k >= a_.components;
        const std::size_t i = thing * a_.components + k;
        if (binary) return piece.raw(padding ? 0.0 : at(i));
        piece.put(' ');
        if (padding) piece.put('0');
        else put_text(i, piece);
    }
    std::uint32_t components() const { return components_; }

private:
    const Attribute& a_;
    std::uint32_t components_;
    const std::vector<double>* doubles_;
    const std::vector<float>* floats_;
};

void write_data_head(const Writing& w, const char* section, const Attribute& described, std::uint32_t components, std::uint64_t entries) {
    const std::string* view = find_annotation(described, "gmsh.view");
    const std::string* interpolation = find_annotation(described, "gmsh.interpolation");
    double time = 0;
    std::int64_t step = 0;
    if (const std::string* text = find_annotation(described, "gmsh.time")) {
        if (parse_real(*text, time) != NumberStatus::ok || !std::isfinite(time)) time = 0;
    }
    if (const std::string* text = find_annotation(described, "gmsh.step")) {
        if (parse_integer(*text, step) != NumberStatus::ok) step = 0;
    }
    w.out << "$" << section << "\n"
          << (interpolation != nullptr ? "2" : "1") << "\n\"" << quotable(view != nullptr ? *view : described.name) << "\"\n";
    if (interpolation != nullptr) w.out << "\"" << quotable(*interpolation) << "\"\n";
    w.out << "1\n";
    w.out.number(time) << "\n3\n";
    w.out.number(step) << '\n';
    w.out.number(components) << '\n';
    w.out.number(entries) << '\n';
}

void write_plain(const Writing& w, const Attribute& a, const Attribute& described) {
    const bool nodes = a.location == AttributeLocation::point;
    const Values values(a, described.components);
    const std::size_t count = nodes ? w.plan.points.size() : w.plan.cell_count();
    const WriteTags& tags = nodes ? w.plan.point_tags : w.plan.cell_tags;
    const auto source = [&](std::size_t i) { return nodes ? w.plan.source_of_point(i) : w.plan.source_of_cell(i); };
    std::uint64_t entries = count;
    if (a.no_data) {
        entries = 0;
        for (std::size_t i = 0; i < count; ++i) entries += values.missing(source(i)) ? 0 : 1;
    }
    write_data_head(w, nodes ? "NodeData" : "ElementData", described, values.components(), entries);
    write_pieces(w.out, count, lines_per_piece, [&](std::size_t first, std::size_t last, TextPiece& piece) {
        if (w.stopped()) return;
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t thing = source(i);
            if (values.missing(thing)) continue;
            piece.need(64);
            if (w.binary) piece.raw(static_cast<std::int32_t>(tags[i]));
            else piece.number(tags[i]);
            for (std::uint32_t k = 0; k < values.components(); ++k) values.put(thing, k, w.binary, piece);
            if (!w.binary) piece.put('\n');
        }
    });
    if (w.binary) w.out << '\n';
    w.out << (nodes ? "$EndNodeData\n" : "$EndElementData\n");
}

// A cell property with values at the corners goes to $ElementNodeData: node by node, in the order of MSH.
void write_per_node(const Writing& w, const Attribute& a, const Attribute& described, std::uint32_t per_node) {
    const Values values(a, described.components);
    const auto goes_out = [&](std::size_t i) {
        const std::size_t thing = w.plan.source_of_cell(i);
        return !values.missing(thing) && w.plan.cell_nodes(i).size() * per_node <= a.components;
    };
    std::uint64_t entries = 0;
    for (std::size_t i = 0; i < w.plan.cell_count(); ++i) entries += goes_out(i) ? 1 : 0;
    write_data_head(w, "ElementNodeData", described, per_node, entries);
    write_pieces(w.out, w.plan.cell_count(), lines_per_piece, [&](std::size_t first, std::size_t last, TextPiece& piece) {
        if (w.stopped()) return;
        for (std::size_t i = first; i < last; ++i) {
            if (!goes_out(i)) continue;
            const auto n = static_cast<std::uint32_t>(w.plan.cell_nodes(i).size());
            const ElementType& type = *element_type_of(w.plan.types[i]);
            std::uint32_t ours[most_written_nodes];
            std::uint32_t local[most_written_nodes];
            for (std::uint32_t k = 0; k < n; ++k) local[k] = k;
            file_order(type, {local, n}, ours);
            piece.need(128);
            if (w.binary) {
                piece.raw(static_cast<std::int32_t>(w.plan.cell_tags[i]));
                piece.raw(static_cast<std::int32_t>(n));
            } else {
                piece.number(w.plan.cell_tags[i]);
                piece.put(' ');
                piece.number(n);
            }
            for (std::uint32_t node = 0; node < n; ++node) {
                for (std::uint32_t k = 0; k < per_node; ++k)
                    values.put(w.plan.source_of_cell(i), ours[node] * per_node + k, w.binary, piece);
            }
            piece.need(1);
            if (!w.binary) piece.put('\n');
        }
    });
    if (w.binary) w.out << '\n';
    w.out << "$EndElementNodeData\n";
}

// Components per node of an attribute that goes to $ElementNodeData; 0 for others.
std::uint32_t components_per_node(const Attribute& a) {
    const std::uint32_t n = a.corner_values ? a.corner_values->components : 0;
    return n < 1 || n > 256 || a.components % n != 0 ? 0 : n;
}

}  // namespace

std::string quotable(std::string_view name) {
    constexpr std::size_t longest = 127;
    std::string text;
    for (const char c : name.substr(0, longest)) text += c == '"' ? '\'' : (c == '\n' || c == '\r' || c == '\0') ? ' ' : c;
    return text;
}

std::vector<Attribute> describe_attributes(const CellMesh& mesh, std::vector<Loss>& losses) {
    std::vector<Attribute> all;
    std::set<std::pair<AttributeLocation, std::string>> used;
    for (const Attribute& a : mesh.info.attributes) {
        Attribute d;
        if (const char* why = obstacle(mesh, a)) {
            const bool whole = a.location == AttributeLocation::object;
            losses.push_back({whole ? LossClass::identity : LossClass::substance, mesh.info.name, "property '" + a.name + "'", why, 1});
            d.components = 0;
            all.push_back(std::move(d));
            continue;
        }
        d = without_values(a);
        d.location = a.location == AttributeLocation::polygon ? AttributeLocation::cell : a.location;
        const std::string clean = a.name.empty() ? "data" : quotable(a.name);
        std::string name = clean;
        for (int i = 2; !used.insert({d.location, name}).second; ++i)
            name = quotable(clean.substr(0, 110) + " (" + std::to_string(i) + ")");
        d.name = name;
        d.components = components_per_node(a) > 0 ? a.components : padded_components(a.components);
        if (d.name != a.name) d.annotations.emplace_back("geomend.name", a.name);
        if (a.values.index() != 0) d.annotations.emplace_back("geomend.type", type_name(a.values));
        if (d.components != a.components) {
            d.annotations.emplace_back("geomend.components", std::to_string(a.components));
            if (!d.component_names.empty()) d.component_names.resize(d.components);
            losses.push_back({LossClass::style, mesh.info.name,
                              "property '" + a.name + "' of " + std::to_string(a.components) + " components",
                              "clients take 1, 3 or 9: padded with zeros", 1});
        }
        all.push_back(std::move(d));
    }
    return all;
}

void restore_attributes(std::vector<Attribute>& attributes) {
    for (Attribute& a : attributes) {
        std::int64_t components = 0;
        if (parse_integer(take_annotation(a, "geomend.components"), components) == NumberStatus::ok && components > 0) {
            restore_components(a, static_cast<std::uint32_t>(std::min<std::int64_t>(components, 256)));
        }
        const std::string type = take_annotation(a, "geomend.type");
        if (!type.empty()) restore_type(a, type);
        const auto named = std::ranges::find(a.annotations, "geomend.name", &std::pair<std::string, std::string>::first);
        if (named != a.annotations.end()) {
            a.name = named->second;
            a.annotations.erase(named);
        }
    }
}

void write_data(const Writing& w, const CellMesh& mesh, const std::vector<Attribute>& described) {
    for (std::size_t i = 0; i < described.size() && !w.stopped(); ++i) {
        const Attribute& a = mesh.info.attributes[i];
        if (described[i].components == 0) continue;
        const std::uint32_t per_node = a.location == AttributeLocation::point ? 0 : components_per_node(a);
        if (per_node > 0) write_per_node(w, a, described[i], per_node);
        else write_plain(w, a, described[i]);
    }
}

}  // namespace geomend::gmsh
