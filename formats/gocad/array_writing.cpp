// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/array_writing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/text_cursor.h"
#include "formats/gocad/array_codec.h"
#include "formats/gocad/ascii_data_file.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/region_flags.h"
#include "model/annotations.h"

namespace geomend::gocad {

namespace {

bool is_flags(const Attribute& a) { return !annotation(a, flags_annotation).empty(); }

ArrayStorage storage_of_attribute(const Attribute& a) {
    const std::string_view stated = annotation(a, "gocad.storage");
    if (stated == "RGBA" && a.components == 4 && std::holds_alternative<std::vector<std::uint8_t>>(a.values)) return ArrayStorage::rgba;
    if (stated == "IBM" && array_fits(a.values, ArrayStorage::ibm32)) return ArrayStorage::ibm32;
    return storage_for(a.values);
}

std::string plain(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool keep = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
        out += keep ? c : '_';
    }
    return out.empty() ? "data" : out;
}

// Numbers of a property without NaN: count, mean, variance, least and largest, as Gocad tells them.
std::string sample_stats(const Attribute& a) {
    double sum = 0, squares = 0, low = 0, high = 0;
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < value_count(a); ++i) {
        const double v = value_as_double(a, i);
        if (!std::isfinite(v) || is_no_data(a, v)) continue;
        low = count == 0 ? v : std::min(low, v);
        high = count == 0 ? v : std::max(high, v);
        ++count;
        const double delta = v - sum;  // running mean and squares (Welford)
        sum += delta / static_cast<double>(count);
        squares += delta * (v - sum);
    }
    std::string text = std::to_string(count);
    const double variance = count == 0 ? 0 : squares / static_cast<double>(count);
    for (const double v : {sum, variance, low, high}) text += ' ' + number_text(v);
    return text;
}

}  // namespace

ArrayWriting::ArrayWriting(const ObjectInfo& info, const std::array<std::uint32_t, 3>& dims,
                           std::initializer_list<AttributeLocation> locations, GocadOutput& to)
    : info_(info), dims_(dims), to_(to) {
    for (const Attribute& a : info.attributes) {
        const auto lose = [&](const char* why) {
            add_loss(to.losses, {LossClass::substance, info.name, "attribute '" + a.name + "'", why});
        };
        if (std::ranges::find(locations, a.location) == locations.end()) lose("this object has no place for values there");
        else if (std::holds_alternative<std::vector<std::string>>(a.values)) lose("Gocad properties are numbers, not text");
        else if (is_flags(a)) (a.name == "gocad_region_flags" ? region_flags : flags) = &a;
        else if (a.components != 1 && storage_of_attribute(a) != ArrayStorage::rgba) lose("a property of a grid has one value per sample");
        else attributes.push_back(trimmed(a.name).empty() ? with_name(a) : &a);
    }
}

// A record without a name, or with blanks alone for one, cannot be read.
const Attribute* ArrayWriting::with_name(const Attribute& a) {
    Attribute& copy = named_.emplace_back(a);
    const auto is_taken = [&](const Attribute& other) { return &other != &copy && other.name == copy.name; };
    copy.name = "unnamed";
    for (int n = 2; std::ranges::any_of(info_.attributes, is_taken) || std::ranges::any_of(named_, is_taken); ++n)
        copy.name = "unnamed_" + std::to_string(n);
    add_loss(to_.losses, {LossClass::identity, info_.name, "that a property has no name: it is '" + copy.name + "'",
                          "a property of a grid has to have one"});
    return &copy;
}

Result<void> ArrayWriting::prepare(bool needs_files) {
    const std::string_view wish = option_value(to_.options.options, "data");
    if (!wish.empty() && wish != "ascii" && wish != "binary") {
        return failure(FailureKind::usage, "F018", {}, "option data: expected ascii or binary, found '" + std::string(wish) + "'");
    }
    const bool exact = std::ranges::all_of(attributes, [](const Attribute* a) {
        const ArrayStorage s = storage_of_attribute(*a);
        return s != ArrayStorage::float64 && (s == ArrayStorage::rgba || array_fits(a->values, s));
    });
    ascii_ = wish == "ascii" || (wish.empty() && !exact);
    if (wish == "binary") {
        for (const Attribute* a : attributes) {
            if (array_fits(a->values, storage_of_attribute(*a))) continue;
            add_loss(to_.losses, {LossClass::substance, info_.name, "digits of '" + a->name + "'", "the binary type does not hold them"});
        }
    }
    if (to_.files.is_stream() && (needs_files || !attributes.empty() || flags != nullptr || region_flags != nullptr)) {
        return failure(FailureKind::cannot_hold, "F021", {to_.files.main_path().string()},
                       "'" + info_.name + "' needs companion files for its values, which have no place beside a stream: give a file");
    }
    return {};
}

std::string ArrayWriting::file_name(std::string_view what) {
    std::string stem = to_.files.main_path().filename().string();
    if (stem.ends_with(".gz")) stem.resize(stem.size() - 3);
    if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot != 0) stem.resize(dot);
    if (to_.dataset.objects.size() > 1) {
        std::size_t place = 0;
        for (std::size_t i = 0; i < to_.dataset.objects.size(); ++i) {
            if (&info_of(to_.dataset.objects[i]) == &info_) place = i;
        }
        stem += '_' + std::to_string(place + 1) + '_' + plain(info_.name);
    }
    std::string name = stem + "__" + plain(what) + "@@";
    for (std::size_t n = 2; std::ranges::find(used_names_, name) != used_names_.end(); ++n) {
        name = stem + "__" + plain(what) + '_' + std::to_string(n) + "@@";
    }
    used_names_.push_back(name);
    return name;
}

void ArrayWriting::write_file(const std::string& name, std::string_view bytes) { to_.files.companion(name).write(bytes); }

void ArrayWriting::write_records(const Attribute& a, std::size_t number, const std::string& file) {
    OutputFile& out = to_.out;
    const std::string n = ' ' + std::to_string(number) + ' ';
    const auto stated = [](const std::string& text, std::string_view other) {
        return name_token(text.empty() ? other : std::string_view(text));
    };
    const std::string cls = stated(a.property_class, a.name);
    out << "\nPROPERTY" << n << name_token(a.name) << '\n';
    if (!a.property_class.empty()) out << "PROPERTY_CLASS" << n << cls << '\n';
    if (const auto method = annotation(a, "gocad.interpolation_method"); !method.empty()) out << "INTERPOLATION_METHOD " << method << '\n';
    if (!a.kind.empty()) out << "PROPERTY_KIND" << n << name_token(a.kind) << '\n';
    bool open = false;
    for (const auto& [key, value] : a.annotations) {
        if (key != "gocad.class_header") continue;
        if (!open) out << "PROPERTY_CLASS_HEADER" << n << cls << " {\n";
        open = true;
        out << value << '\n';
    }
    if (open) out << "}\n";
    const auto subclass = annotation(a, "gocad.subclass");
    if (!subclass.empty()) out << "PROPERTY_SUBCLASS" << n << subclass << '\n';
    for (const auto& [key, value] : a.annotations) {
        if (key != "gocad.prop_record") continue;
        const std::size_t blank = value.find(' ');
        out << std::string_view(value).substr(0, blank) << n
            << (blank == std::string::npos ? "" : std::string_view(value).substr(blank + 1)) << '\n';
    }
    if (!a.unit.empty()) out << "PROP_UNIT" << n << name_token(a.unit) << '\n';
    if (a.no_data) (out << "PROP_NO_DATA_VALUE" << n).number(*a.no_data) << '\n';
    if (a.legal_min || a.legal_max) {
        const auto end = [](std::optional<double> v) { return v ? number_text(*v) : std::string("**none**"); };
        out << "PROP_LEGAL_RANGE" << n << end(a.legal_min) << ' ' << end(a.legal_max) << '\n';
    }
    out << "PROP_SAMPLE_STATS" << n << sample_stats(a) << '\n';
    const ArrayStorage storage = storage_of_attribute(a);
    const std::size_t size = element_size(storage);
    using enum ArrayStorage;
    const bool is_real = storage == float32 || storage == float64 || storage == ibm32;
    const bool text_of_floats = ascii_ && std::holds_alternative<std::vector<float>>(a.values);
    if (storage == rgba) out << "PROP_STORAGE_TYPE" << n << "RGBA\n";
    else if (!is_real) out << "PROP_STORAGE_TYPE" << n << (size == 1 ? "Octet" : size == 2 ? "Short" : "Integer") << '\n';
    else if (text_of_floats) out << "PROP_STORAGE_TYPE" << n << "Float\n";
    out << "PROP_ESIZE" << n << std::to_string(ascii_ && is_real ? 4 : size) << '\n';
    if (!is_real && storage != rgba) out << "PROP_SIGNED" << n << (storage == int8 || storage == int16 || storage == int32 ? "1\n" : "0\n");
    if (a.location == AttributeLocation::cell) out << "PROP_ALIGNMENT" << n << "CELLS\n";
    if (file.empty()) return;
    out << "PROP_ETYPE" << n << (storage == ibm32 ? "IBM\n" : "IEEE\n") << "PROP_FORMAT" << n << "RAW\nPROP_OFFSET" << n << "0\nPROP_FILE"
        << n << file << '\n';
}

void ArrayWriting::write(const std::vector<Vec3>& positions) {
    const bool text_file = ascii_ && (!attributes.empty() || !positions.empty());
    if (text_file) {
        const std::string name = file_name("ascii");
        to_.out << "ASCII_DATA_FILE " << name << '\n';
        std::vector<bool> cells;
        for (const Attribute* a : attributes) cells.push_back(a->location == AttributeLocation::cell);
        write_ascii_data(to_.files.companion(name), dims_, attributes, cells, positions, z_sign(info_.crs));
    }
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const Attribute& a = *attributes[i];
        const std::string name = ascii_ ? std::string() : file_name(a.name);
        write_records(a, i + 1, name);
        if (ascii_) continue;
        std::string bytes;
        encode_array(a.values, storage_of_attribute(a), bytes);
        write_file(name, bytes);
    }
}

ObjectInfo array_head(const ObjectInfo& info, bool ascii) {
    ObjectInfo head;
    head.name = info.name;
    head.role = info.role;
    head.role_text = info.role_text;
    head.feature = info.feature;
    head.crs = info.crs;
    for (const Annotation& a : info.annotations) {
        if (a.key == "gocad.header" && (a.value.starts_with("ascii:") || a.value.starts_with("double_precision_binary:"))) continue;
        head.annotations.push_back(a);
    }
    head.annotations.push_back({"gocad.header", ascii ? "ascii:on" : "ascii:off"});
    return head;
}

std::vector<std::uint32_t> region_bits(const ObjectInfo& info, const std::vector<const NamedSet*>& sets, std::uint32_t first_free) {
    constexpr std::uint32_t none = no_index;
    std::vector<std::uint32_t> bits(sets.size(), none);
    std::set<std::uint32_t> used;
    for (const Annotation& a : info.annotations) {
        if (a.key != "gocad.region_bit") continue;
        std::uint32_t bit = 0;
        const auto [end, error] = std::from_chars(a.value.data(), a.value.data() + a.value.size(), bit);
        if (error != std::errc{} || bit >= 8 * 64) continue;
        const std::string_view name = trimmed({end, static_cast<std::size_t>(a.value.data() + a.value.size() - end)});
        for (std::size_t i = 0; i < sets.size(); ++i) {
            if (bits[i] != none || sets[i]->name != name || !used.insert(bit).second) continue;
            bits[i] = bit;
            break;
        }
    }
    for (std::uint32_t& bit : bits) {
        if (bit != none) continue;
        while (used.contains(first_free)) ++first_free;
        used.insert(first_free);
        bit = first_free;
    }
    return bits;
}

}  // namespace geomend::gocad
