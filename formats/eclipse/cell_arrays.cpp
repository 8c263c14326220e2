// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/cell_arrays.h"

#include <cmath>
#include <span>

namespace geomend::eclipse {

namespace {

template <class T>
T missing_value() {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(missing_real);
    if constexpr (std::is_same_v<T, std::int32_t>) return missing_integer;
    if constexpr (std::is_same_v<T, std::uint8_t>) return missing_byte;
    return T{};
}

template <class T>
std::vector<T> spread(std::span<const T> values, const std::vector<std::uint64_t>& to, std::size_t cells) {
    std::vector<T> out(cells, missing_value<T>());
    for (std::size_t i = 0; i < to.size(); ++i) out[to[i]] = values[i];
    return out;
}

/// Makes values that are not finite the missing one; how many there were.
template <class T>
std::uint64_t drop_not_finite(std::vector<T>& values) {
    std::uint64_t count = 0;
    if constexpr (std::is_floating_point_v<T>) {
        for (T& v : values) {
            if (std::isfinite(v)) continue;
            v = missing_value<T>();
            ++count;
        }
    }
    return count;
}

struct Target {
    const ArrayFile& file;
    const Array& array;
    const CellOrder& order;
    CornerPointGrid& grid;
    std::vector<Finding>& findings;
};

template <class T>
void add_attribute(const Target& to, std::string name, std::vector<T> values, bool has_missing) {
    Attribute a;
    const std::string_view keyword = to.array.name;
    if (const std::uint64_t count = drop_not_finite(values); count != 0) {
        has_missing = true;
        to.findings.push_back(
            make_finding("F120", "values of '" + name + "' that are not finite are taken as missing", place_of(to.file, to.array), count));
        to.findings.back().entities = {{"attribute", name}};
    }
    a.name = std::move(name);
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    a.unit = unit_of(keyword, to.grid.unit_system);
    if constexpr (!std::is_same_v<T, std::string>) {
        if (has_missing) a.no_data = static_cast<double>(missing_value<T>());
    }
    if (to.array.type == ArrayType::logical) a.annotations.emplace_back("eclipse.type", "LOGI");
    to.grid.info.attributes.push_back(std::move(a));
}

template <class T>
Result<void> take(const Target& to, const std::string& name, Result<std::vector<T>> read) {
    if (!read) return read.why();
    const CellOrder& order = to.order;
    const std::string fracture = name + std::string(fracture_suffix);
    if (read->size() == order.total()) {
        if (!order.dual) {
            add_attribute(to, name, std::move(*read), false);
            return {};
        }
        const auto half = read->begin() + static_cast<std::ptrdiff_t>(order.cells);
        add_attribute(to, name, std::vector<T>(read->begin(), half), false);
        add_attribute(to, fracture, std::vector<T>(half, read->end()), false);
        return {};
    }
    const std::span<const T> values(*read);
    add_attribute(to, name, spread(values.first(order.matrix.size()), order.matrix, order.cells), true);
    if (order.dual) add_attribute(to, fracture, spread(values.subspan(order.matrix.size()), order.fracture, order.cells), true);
    return {};
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    for (const std::string_view w : words) {
        if (w == word) return true;
    }
    return false;
}

}  // namespace

CellOrder cell_order(const CornerPointGrid& grid) {
    CellOrder order;
    order.cells = grid.cell_count();
    order.dual = grid.porosity != CornerPointGrid::Porosity::single;
    if (!order.dual && grid.activity.empty()) {
        order.all_active = true;
        return order;
    }
    const auto state = [&](std::size_t cell) -> unsigned { return grid.activity.empty() ? 3u : grid.activity[cell]; };
    for (std::size_t cell = 0; cell < order.cells; ++cell) {
        const unsigned s = state(cell);
        if (order.dual ? (s & 1u) != 0 : s != 0) order.matrix.push_back(cell);
        if (order.dual && (s & 2u) != 0) order.fracture.push_back(cell);
    }
    if (!order.dual && order.matrix.size() == order.cells) {
        order.all_active = true;
        order.matrix = {};
    }
    return order;
}

bool fits_cells(const Array& array, const CellOrder& order) {
    if (array.type == ArrayType::message || array.count == 0) return false;
    return array.count == order.active() || array.count == order.total();
}

bool is_cell_property(std::string_view name) {
    return is_one_of(name, {"PORO",   "NTG",    "PERMX",  "PERMY",  "PERMZ",  "PORV",    "DX",      "DY",      "DZ",     "DEPTH", "TOPS",
                            "MULTX",  "MULTX-", "MULTY",  "MULTY-", "MULTZ",  "MULTZ-",  "MULTPV",  "TRANX",   "TRANY",  "TRANZ", "SATNUM",
                            "PVTNUM", "EQLNUM", "FIPNUM", "ENDNUM", "IMBNUM", "FLUXNUM", "MULTNUM", "OPERNUM", "ROCKNUM"});
}

Failure wrong_cell_count(const ArrayFile& file, const Array& array, const CellOrder& order) {
    const std::string active =
        order.active() == order.total() ? std::string() : " (or " + std::to_string(order.active()) + ", those of active cells)";
    return unreadable("F008", place_of(file, array),
                      "expected " + std::to_string(order.total()) + " values of '" + array.name + "'" + active + ", found " +
                          std::to_string(array.count));
}

Result<void> take_cell_array(const ArrayFile& file, const Array& array, const CellOrder& order, const std::string& name,
                             CornerPointGrid& grid, std::vector<Finding>& findings) {
    const Target to{file, array, order, grid, findings};
    switch (array.type) {
        case ArrayType::integer:
            return take(to, name, integers(file, array));
        case ArrayType::real:
            return take(to, name, floats(file, array));
        case ArrayType::real_double:
            return take(to, name, doubles(file, array));
        case ArrayType::logical:
            return take(to, name, logicals(file, array));
        case ArrayType::text:
            return take(to, name, texts(file, array));
        case ArrayType::message:
            break;
    }
    return {};
}

std::string unit_of(std::string_view keyword, std::string_view unit_system) {
    const bool metric = unit_system == "METRIC", field = unit_system == "FIELD", lab = unit_system == "LAB";
    if (!metric && !field && !lab) return {};
    if (is_one_of(keyword, {"PERMX", "PERMY", "PERMZ", "PERMR", "PERMTHT"})) return "mD";
    if (is_one_of(keyword, {"DX", "DY", "DZ", "DEPTH", "TOPS", "DR"})) return metric ? "m" : field ? "ft" : "cm";
    if (keyword == "PORV") return metric ? "rm3" : field ? "rb" : "rcc";
    if (keyword == "PRESSURE") return metric ? "barsa" : field ? "psia" : "atma";
    return {};
}

}  // namespace geomend::eclipse
