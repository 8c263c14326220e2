// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/netcdf_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace geomend::meshes {

namespace {

// Tags of lists in the header.
constexpr std::uint32_t dimension_list = 10, variable_list = 11, attribute_list = 12;
constexpr std::uint64_t largest_variable = 0xfffffffcull;

template <class Number>
void append_big_endian(std::string& out, Number value) {
    for (int shift = 8 * (static_cast<int>(sizeof value) - 1); shift >= 0; shift -= 8)
        out.push_back(static_cast<char>(static_cast<unsigned char>(value >> shift & 0xff)));
}

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

void append_text(std::string& out, std::string_view text) {
    append_big_endian(out, static_cast<std::uint32_t>(text.size()));
    out += text;
    out.append(padded(text.size()) - text.size(), '\0');
}

void begin_list(std::string& out, std::uint32_t tag, std::size_t count) {
    append_big_endian(out, count == 0 ? 0 : tag);
    append_big_endian(out, static_cast<std::uint32_t>(count));
}

std::uint64_t size_of(NetcdfFile::Type type) {
    switch (type) {
        case NetcdfFile::Type::text:
            return 1;
        case NetcdfFile::Type::float64:
            return 8;
        default:
            return 4;
    }
}

template <class Properties>
void append_attributes(std::string& out, const Properties& attributes) {
    begin_list(out, attribute_list, attributes.size());
    for (const auto& a : attributes) {
        append_text(out, a.name);
        if (const auto* text = std::get_if<std::string>(&a.value)) {
            append_big_endian(out, static_cast<std::uint32_t>(NetcdfFile::Type::text));
            append_text(out, *text);
            continue;
        }
        const auto* real = std::get_if<float>(&a.value);
        append_big_endian(out, static_cast<std::uint32_t>(real != nullptr ? NetcdfFile::Type::float32 : NetcdfFile::Type::int32));
        append_big_endian(out, std::uint32_t{1});
        append_big_endian(
            out, real != nullptr ? std::bit_cast<std::uint32_t>(*real) : static_cast<std::uint32_t>(std::get<std::int32_t>(a.value)));
    }
}

}  // namespace

void NetcdfFile::Values::integer(std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::array<char, 4> bytes{};
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(bits >> (24 - 8 * i) & 0xff);
    file_.write({bytes.data(), bytes.size()});
    bytes_ += 4;
}

void NetcdfFile::Values::real(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    std::array<char, 8> bytes{};
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<char>(bits >> (56 - 8 * i) & 0xff);
    file_.write({bytes.data(), bytes.size()});
    bytes_ += 8;
}

void NetcdfFile::Values::text(std::string_view value, std::size_t length) {
    value = value.substr(0, length);
    file_.write(value);
    file_.write(std::string(length - value.size(), '\0'));
    bytes_ += length;
}

std::uint32_t NetcdfFile::dimension(std::string name, std::uint32_t size) {
    dimensions_.push_back({std::move(name), size});
    return static_cast<std::uint32_t>(dimensions_.size() - 1);
}

void NetcdfFile::attribute(std::string name, std::string_view text) { attributes_.push_back({std::move(name), std::string(text)}); }
void NetcdfFile::attribute(std::string name, float value) { attributes_.push_back({std::move(name), value}); }
void NetcdfFile::attribute(std::string name, std::int32_t value) { attributes_.push_back({std::move(name), value}); }

void NetcdfFile::variable(std::string name, Type type, std::vector<std::uint32_t> dimensions, Write write) {
    variables_.push_back({std::move(name), type, std::move(dimensions), std::move(write), {}});
}

void NetcdfFile::of_last(std::string name, std::string_view text) {
    variables_.back().attributes.push_back({std::move(name), std::string(text)});
}

bool NetcdfFile::is_record(const Variable& variable) const {
    return !variable.dimensions.empty() && dimensions_[variable.dimensions.front()].size == 0;
}

std::uint64_t NetcdfFile::bytes_of(const Variable& variable) const {
    std::uint64_t bytes = size_of(variable.type);
    for (const std::uint32_t d : variable.dimensions) bytes *= std::max(dimensions_[d].size, 1u);
    return bytes;
}

/// The header, with the places of variables: first those of fixed size, then the record.
std::string NetcdfFile::header(bool& fits) const {
    const bool has_record = std::ranges::any_of(variables_, [&](const Variable& v) { return is_record(v); });
    std::string head = "CDF\2";
    append_big_endian(head, std::uint32_t{has_record ? 1u : 0u});
    begin_list(head, dimension_list, dimensions_.size());
    for (const Dimension& d : dimensions_) {
        append_text(head, d.name);
        append_big_endian(head, d.size);
    }
    append_attributes(head, attributes_);
    begin_list(head, variable_list, variables_.size());
    std::vector<std::string> rows;
    std::uint64_t at = head.size();
    for (const Variable& v : variables_) {
        std::string& row = rows.emplace_back();
        append_text(row, v.name);
        append_big_endian(row, static_cast<std::uint32_t>(v.dimensions.size()));
        for (const std::uint32_t d : v.dimensions) append_big_endian(row, d);
        append_attributes(row, v.attributes);
        append_big_endian(row, static_cast<std::uint32_t>(v.type));
        const std::uint64_t bytes = padded(bytes_of(v));
        fits = fits && bytes <= largest_variable;
        append_big_endian(row, static_cast<std::uint32_t>(bytes));
        at += row.size() + sizeof(std::uint64_t);
    }
    std::vector<std::uint64_t> places(variables_.size());
    for (const bool record : {false, true}) {
        for (std::size_t v = 0; v < variables_.size(); ++v) {
            if (is_record(variables_[v]) != record) continue;
            places[v] = at;
            at += padded(bytes_of(variables_[v]));
        }
    }
    for (std::size_t v = 0; v < rows.size(); ++v) {
        head += rows[v];
        append_big_endian(head, places[v]);
    }
    return head;
}

Result<void> NetcdfFile::write(OutputFile& file) const {
    bool fits = true;
    file.write(header(fits));
    if (!fits) return failure(FailureKind::cannot_hold, "F021", {}, "an array is larger than the 4 GiB that a classic netCDF file holds");
    for (const bool record : {false, true}) {
        for (const Variable& v : variables_) {
            if (is_record(v) != record) continue;
            Values values(file);
            v.write(values);
            if (values.bytes() != bytes_of(v))
                return failure(FailureKind::internal, "", {},
                               "netCDF variable " + v.name + ": another number of values than its dimensions say");
            file.write(std::string(padded(values.bytes()) - values.bytes(), '\0'));
        }
    }
    return {};
}

}  // namespace geomend::meshes
