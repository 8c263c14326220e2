// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/legacy_arrays_out.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/number_text.h"
#include "formats/vtk/vtk_cells.h"

namespace geomend::vtk {

namespace {

// VTK reads names into buffers of 256 bytes and comes apart on longer ones.
constexpr std::size_t longest_name = 255;
constexpr std::size_t values_per_line = 9;

template <class T>
void append_big_endian(std::string& out, T value) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::little) std::ranges::reverse(bytes);
    out.append(bytes.data(), bytes.size());
}

template <class T>
void append_text(std::string& out, T value) {
    if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) append_number(out, std::int64_t{value});
    else if constexpr (std::is_integral_v<T>) append_number(out, std::uint64_t{value});
    else append_number(out, value);
}

// Collects values and hands them on in large pieces.
class Piece {
public:
    explicit Piece(OutputFile& out) : out_(out) { bytes_.reserve(limit + 256); }
    ~Piece() { out_.write(bytes_); }
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;
    std::string& bytes() {
        if (bytes_.size() >= limit) {
            out_.write(bytes_);
            bytes_.clear();
        }
        return bytes_;
    }

private:
    static constexpr std::size_t limit = std::size_t{1} << 16;
    OutputFile& out_;
    std::string bytes_;
};

LegacyType default_type(const AttributeValues& values, int major_version) {
    constexpr LegacyType types[] = {LegacyType::float64, LegacyType::float32,        LegacyType::signed_char, LegacyType::unsigned_char,
                                    LegacyType::short16, LegacyType::unsigned_short, LegacyType::int32,       LegacyType::unsigned_int,
                                    LegacyType::int64,   LegacyType::uint64,         LegacyType::string};
    const LegacyType type = types[values.index()];
    return type == LegacyType::signed_char && major_version < 5 ? LegacyType::char8 : type;
}

template <class T>
const std::vector<T>* as(const Attribute& a) {
    return std::get_if<std::vector<T>>(&a.values);
}

std::size_t stored_values(const Attribute& a) {
    return std::visit([](const auto& v) { return v.size(); }, a.values);
}

}  // namespace

std::string percent_encoded(std::string_view text) {
    constexpr char digits[] = "0123456789ABCDEF";
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 33 || byte > 126 || c == '"' || c == '%') {
            out += '%';
            out += digits[byte >> 4];
            out += digits[byte & 15];
        } else {
            out += c;
        }
    }
    return out;
}

template <class T>
void LegacyArraysOut::block(std::span<const T> values, std::size_t per_line) {
    Piece piece(out_);
    if (binary_) {
        for (const T value : values) append_big_endian(piece.bytes(), value);
        piece.bytes() += '\n';
        return;
    }
    std::size_t on_line = 0;
    for (const T value : values) {
        std::string& bytes = piece.bytes();
        append_text(bytes, value);
        bytes += ++on_line == per_line ? '\n' : ' ';
        if (on_line == per_line) on_line = 0;
    }
    if (on_line != 0 || values.empty()) piece.bytes() += '\n';
}

template void LegacyArraysOut::block(std::span<const double>, std::size_t);
template void LegacyArraysOut::block(std::span<const float>, std::size_t);
template void LegacyArraysOut::block(std::span<const std::int32_t>, std::size_t);
template void LegacyArraysOut::block(std::span<const std::uint64_t>, std::size_t);

void LegacyArraysOut::points_as_float(std::span<const Vec3> points) {
    Piece piece(out_);
    for (const Vec3& p : points) {
        std::string& bytes = piece.bytes();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (binary_) {
                append_big_endian(bytes, static_cast<float>(p[axis]));
            } else {
                append_number(bytes, p[axis]);  // as a double: who reads the text as doubles gets the same point, too
                bytes += axis == 2 ? '\n' : ' ';
            }
        }
    }
    if (binary_) piece.bytes() += '\n';
}

void LegacyArraysOut::counted_cells(std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners) {
    Piece piece(out_);
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
        const auto cell = corners.subspan(offsets[i], offsets[i + 1] - offsets[i]);
        if (binary_) {
            append_big_endian(piece.bytes(), static_cast<std::uint32_t>(cell.size()));
            for (const std::uint32_t p : cell) append_big_endian(piece.bytes(), p);
            continue;
        }
        append_number(piece.bytes(), std::uint64_t{cell.size()});
        for (const std::uint32_t p : cell) {
            std::string& bytes = piece.bytes();
            bytes += ' ';
            append_number(bytes, std::uint64_t{p});
        }
        piece.bytes() += '\n';
    }
    if (binary_) piece.bytes() += '\n';
}

void LegacyArraysOut::connectivity(std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners) {
    Piece piece(out_);
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
        for (std::uint64_t k = offsets[i]; k < offsets[i + 1]; ++k) {
            std::string& bytes = piece.bytes();
            if (binary_) {
                append_big_endian(bytes, std::uint64_t{corners[k]});
            } else {
                append_number(bytes, std::uint64_t{corners[k]});
                bytes += k + 1 == offsets[i + 1] ? '\n' : ' ';
            }
        }
    }
    if (binary_) piece.bytes() += '\n';
}

// ---- attributes ----

// The word of the file that the attribute came from, where the values still fit it.
LegacyType LegacyArraysOut::type_of(const Attribute& a) {
    const LegacyType usual = default_type(a.values, major_);
    const LegacyType noted = legacy_type(annotation(a, "vtk.type"));
    switch (noted) {
        case LegacyType::char8:
            return as<std::int8_t>(a) != nullptr ? noted : usual;
        case LegacyType::long64:
            return as<std::int64_t>(a) != nullptr ? noted : usual;
        case LegacyType::unsigned_long:
            return as<std::uint64_t>(a) != nullptr ? noted : usual;
        case LegacyType::id_type:
            if (const auto* v = as<std::int64_t>(a);
                v != nullptr && std::ranges::all_of(*v, [](auto x) { return std::in_range<std::int32_t>(x); }))
                return noted;
            return usual;
        case LegacyType::bit:
            if (const auto* v = as<std::uint8_t>(a); v != nullptr && std::ranges::all_of(*v, [](auto x) { return x <= 1; })) return noted;
            return usual;
        default:
            return usual;
    }
}

std::string LegacyArraysOut::name_of(const Attribute& a) {
    if (a.name.empty()) {
        add_loss(losses_, {LossClass::identity, "", "the empty name of an attribute",
                           "arrays of legacy VTK files have names: it is called 'unnamed'"});
        return "unnamed";
    }
    std::string name = percent_encoded(a.name);
    if (name.size() > longest_name) {
        name.resize(longest_name);
        while (name.size() > longest_name - 3 && name.find('%', longest_name - 2) != std::string::npos) name.pop_back();
        add_loss(losses_, {LossClass::identity, a.name, "the end of the name of attribute '" + a.name.substr(0, 40) + "...'",
                           "VTK reads names of up to 255 bytes"});
    }
    if (name == "NULL_ARRAY") name = "%4EULL_ARRAY";
    return name;
}

void LegacyArraysOut::bits(const std::vector<std::uint8_t>& values) {
    if (!binary_) return block<std::int32_t>(std::vector<std::int32_t>(values.begin(), values.end()), values_per_line);
    Piece piece(out_);
    for (std::size_t i = 0; i < values.size(); i += 8) {
        unsigned byte = 0;
        for (std::size_t k = i; k < std::min(values.size(), i + 8); ++k) byte |= unsigned{values[k]} << (7 - (k - i));
        piece.bytes() += static_cast<char>(byte);
    }
    piece.bytes() += '\n';
}

// In binary files the highest two bits of the first byte tell how many bytes hold the length.
void LegacyArraysOut::strings(const std::vector<std::string>& values) {
    for (const std::string& text : values) {
        if (!binary_) {
            out_ << percent_encoded(text) << '\n';
            continue;
        }
        std::string head;
        const std::uint64_t n = text.size();
        if (n < 1u << 6) append_big_endian(head, static_cast<std::uint8_t>(n | 0xc0));
        else if (n < 1u << 14) append_big_endian(head, static_cast<std::uint16_t>(n | 0x8000));
        else if (n < 1u << 30) append_big_endian(head, static_cast<std::uint32_t>(n | 0x40000000));
        else append_big_endian(head, n);
        out_ << head << text;
    }
    out_ << '\n';
}

void LegacyArraysOut::values(const Attribute& a, LegacyType type, std::size_t per_line) {
    if (const auto* v = as<std::string>(a)) return strings(*v);
    if (type == LegacyType::bit) return bits(*as<std::uint8_t>(a));
    std::visit(
        [&](const auto& v) {
            using T = typename std::decay_t<decltype(v)>::value_type;
            if constexpr (!std::is_same_v<T, std::string>) {
                if (type == LegacyType::id_type && binary_) block<std::int32_t>(std::vector<std::int32_t>(v.begin(), v.end()), per_line);
                else block<T>(v, per_line);
            }
        },
        a.values);
}

// Component names, the unit and what else the file said; ends with an empty line.
void LegacyArraysOut::metadata(const Attribute& a) {
    const bool names = !a.component_names.empty() && a.component_names.size() == a.components;
    std::string lines(annotation(a, "vtk.information"));
    if (!lines.empty()) lines += '\n';
    if (!a.unit.empty() && as<std::string>(a) == nullptr && a.unit.size() < 80)
        lines += "NAME UNITS_LABEL LOCATION vtkDataArray\nDATA " + percent_encoded(a.unit) + '\n';
    if (!names && lines.empty()) return;
    out_ << "METADATA\n";
    if (names) {
        out_ << "COMPONENT_NAMES\n";
        for (const std::string& name : a.component_names) out_ << percent_encoded(name).substr(0, longest_name) << '\n';
    }
    if (!lines.empty()) {
        std::uint64_t keys = 0;
        for (std::size_t at = 0; at != std::string::npos;
             at = lines.find('\n', at) == std::string::npos ? std::string::npos : lines.find('\n', at) + 1)
            keys += lines.compare(at, 5, "NAME ") == 0;
        out_ << "INFORMATION ";
        out_.number(keys) << '\n' << lines;
    }
    out_ << '\n';
}

void LegacyArraysOut::array(const Attribute& a, Shape shape) {
    const LegacyType type = type_of(a);
    out_ << name_of(a) << ' ';
    out_.number(shape.components) << ' ';
    out_.number(shape.tuples) << ' ' << type_word(type) << '\n';
    values(a, type, shape.components > 1 ? shape.components : values_per_line);
    metadata(a);
}

void LegacyArraysOut::lookup_table(const Attribute& a, const std::string& name) {
    std::vector<double> colours;
    const std::string_view text = annotation(a, "vtk.lookup_values");
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        double value = 0;
        if (parse_real(text.substr(at, end - at), value) != NumberStatus::ok) return;
        colours.push_back(value);
        at = end + 1;
    }
    if (colours.empty() || colours.size() % 4 != 0) return;
    out_ << "LOOKUP_TABLE " << name << ' ';
    out_.number(std::uint64_t{colours.size() / 4}) << '\n';
    if (!binary_) return block<double>(colours, 4);
    bool exact = true;
    for (const double c : colours) {
        const double byte = std::clamp(std::round(c * 255.0), 0.0, 255.0);
        exact = exact && byte / 255.0 == c;
        out_ << static_cast<char>(static_cast<unsigned char>(byte));
    }
    out_ << '\n';
    if (!exact)
        add_loss(losses_, {LossClass::style, a.name, "digits of the colour table '" + name + "'", "binary files hold colours as bytes"});
}

// Arrays that VTK is to take as its active scalars, vectors, ...: the first of each role.
bool LegacyArraysOut::role_record(const Attribute& a, std::uint64_t count, std::vector<std::string>& used_roles) {
    const std::string role(annotation(a, attribute_role_key));
    const bool text_values = as<std::string>(a) != nullptr;
    const std::uint64_t n = a.components;
    std::string_view record;
    if (role == "Scalars" && !text_values) record = "SCALARS";
    else if (role == "Vectors" && n == 3 && !text_values) record = "VECTORS";
    else if (role == "Normals" && n == 3 && !text_values) record = "NORMALS";
    else if (role == "Tensors" && n == 9 && !text_values) record = "TENSORS";
    else if (role == "Tensors" && n == 6 && !text_values && major_ >= 5) record = "TENSORS6";
    else if (role == "TCoords" && n <= 3 && !text_values) record = "TEXTURE_COORDINATES";
    else if (role == "GlobalIds" && n == 1 && !text_values) record = "GLOBAL_IDS";
    else if (role == "PedigreeIds" && n == 1) record = "PEDIGREE_IDS";
    else if (role == "EdgeFlag" && n == 1 && !text_values) record = "EDGE_FLAGS";
    if (record.empty() || std::ranges::find(used_roles, role) != used_roles.end() || stored_values(a) != n * count) return false;
    used_roles.push_back(role);
    const LegacyType type = type_of(a);
    const bool colours =
        annotation(a, "vtk.record") == "COLOR_SCALARS" && (binary_ ? as<std::uint8_t>(a) != nullptr : as<float>(a) != nullptr);
    out_ << (colours ? "COLOR_SCALARS" : record) << ' ' << name_of(a) << ' ';
    if (colours) {
        out_.number(n) << '\n';
        values(a, type, n);
        return true;
    }
    if (record == "TEXTURE_COORDINATES") out_.number(n) << ' ';
    out_ << type_word(type);
    if (record == "SCALARS") (out_ << ' ').number(n);
    out_ << '\n';
    std::string table;
    if (record == "SCALARS") {
        table = percent_encoded(annotation(a, "vtk.lookup_table"));
        out_ << "LOOKUP_TABLE " << (table.empty() ? "default" : table) << '\n';
    }
    values(a, type, n > 1 ? n : values_per_line);
    metadata(a);
    if (!table.empty()) lookup_table(a, table);
    return true;
}

void LegacyArraysOut::section(std::string_view keyword, std::span<const Attribute* const> attributes, AttributeLocation location,
                              std::uint64_t count) {
    std::vector<const Attribute*> here;
    for (const Attribute* at : attributes) {
        const Attribute& a = *at;
        if (a.location != location) continue;
        if (a.components != 0 && stored_values(a) == a.components * count) here.push_back(&a);
        else
            add_loss(losses_,
                     {LossClass::substance, a.name, "attribute '" + a.name + "'", "its number of values does not match what it stands on"});
    }
    if (here.empty()) return;
    out_ << keyword << ' ';
    out_.number(count) << '\n';
    std::vector<std::string> used_roles;
    std::vector<const Attribute*> plain;
    for (const Attribute* a : here) {
        if (!role_record(*a, count, used_roles)) plain.push_back(a);
    }
    if (plain.empty()) return;
    out_ << "FIELD FieldData ";
    out_.number(std::uint64_t{plain.size()}) << '\n';
    for (const Attribute* a : plain) array(*a, {a->components, count});
}

void LegacyArraysOut::object_field(std::span<const Attribute* const> attributes, std::span<const LegacyText> texts) {
    std::uint64_t n = texts.size();
    for (const Attribute* a : attributes) n += a->location == AttributeLocation::object && stored_values(*a) != 0;
    if (n == 0) return;
    out_ << "FIELD FieldData ";
    out_.number(n) << '\n';
    for (const LegacyText& text : texts) {
        out_ << text.name << " 1 1 string\n";
        strings({text.text});
    }
    for (const Attribute* at : attributes) {
        const Attribute& a = *at;
        if (a.location != AttributeLocation::object || stored_values(a) == 0) continue;
        Shape shape{stored_values(a), 1};
        const std::string_view noted = annotation(a, "vtk.shape");
        const std::size_t blank = noted.find(' ');
        std::uint64_t components = 0, tuples = 0;
        if (blank != std::string_view::npos && parse_integer(noted.substr(0, blank), components) == NumberStatus::ok &&
            parse_integer(noted.substr(blank + 1), tuples) == NumberStatus::ok && components != 0 && shape.components % components == 0 &&
            shape.components / components == tuples)
            shape = {components, tuples};
        array(a, shape);
    }
}

}  // namespace geomend::vtk
