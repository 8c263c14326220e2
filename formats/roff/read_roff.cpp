// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/read_roff.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/big_array.h"
#include "base/number_text.h"
#include "base/wording.h"
#include "formats/drop.h"
#include "formats/roff/document.h"
#include "formats/roff/subgrids.h"
#include "formats/roff/tag_text.h"

namespace geomend::roff {

namespace {

std::string stem_of(const Input& input) {
    std::string name = input.base_name();
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0) name.resize(dot);
    return name;
}

/// Where values of cells stand in a file: i slowest, k fastest and from the bottom.
template <class T>
std::vector<T> in_our_order(const std::vector<T>& values, const std::array<std::uint32_t, 3>& dims) {
    const auto [nx, ny, nz] = dims;
    std::vector<T> out(values.size());
    parallel_blocks(ny, 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t j = from; j != to; ++j) {
            for (std::size_t i = 0; i < nx; ++i) {
                const T* column = values.data() + (i * ny + j) * nz;
                for (std::size_t k = 0; k < nz; ++k) out[i + nx * (j + ny * k)] = column[nz - 1 - k];
            }
        }
    });
    return out;
}

class RoffReader {
public:
    RoffReader(const Document& document, const ReadOptions& options) : doc_(document), options_(options) {
        data_.format = "roff";
        data_.variant = document.text ? "ROFF text" : "ROFF binary";
        grid_.info.name = stem_of(document.input);
    }

    Result<Dataset> run() {
        if (auto done = take_dims(); !done) return done.why();
        if (auto done = take_transform(); !done) return done.why();
        const bool has_lines = find_tag(doc_, "cornerLines") != nullptr, has_depths = find_tag(doc_, "zvalues") != nullptr;
        if (has_lines != has_depths) {
            return unreadable("F004", {doc_.input.name()},
                              std::string("expected the tag ") + (has_lines ? "zvalues" : "cornerLines") + " of the grid, found none");
        }
        if (has_lines) {
            if (auto done = take_lines(); !done) return done.why();
            if (auto done = take_depths(); !done) return done.why();
        }
        if (auto done = take_activity(); !done) return done.why();
        for (const Tag& tag : doc_.tags) {
            if (options_.monitor != nullptr && options_.monitor->stopped())
                return failure(FailureKind::cancelled, "F022", {doc_.input.name()}, "stopped");
            if (auto done = take_other(tag); !done) return done.why();
        }
        finish();
        data_.objects.emplace_back(std::move(grid_));
        return std::move(data_);
    }

private:
    Failure fail(const char* code, std::uint64_t at, std::string message) const {
        return unreadable(code, place_at(doc_, at), std::move(message));
    }
    Failure wrong_count(const Entry& entry, std::uint64_t expected) const {
        return fail("F008", entry.place,
                    "expected " + std::to_string(expected) + " values of '" + entry.name + "', found " + std::to_string(entry.count));
    }

    Result<void> take_dims() {
        const Tag* tag = find_tag(doc_, "dimensions");
        if (tag == nullptr)
            return unreadable("F017", {doc_.input.name()}, "expected the tag dimensions, found none: this is no grid and no parameter");
        const char* names[] = {"nX", "nY", "nZ"};
        std::uint64_t left = doc_.input.bytes().size();
        for (std::size_t d = 0; d < 3; ++d) {
            const Entry* entry = find_entry(*tag, names[d]);
            if (entry == nullptr || entry->count != 1)
                return fail("F012", tag->place, std::string("expected ") + names[d] + " in the tag dimensions");
            const auto value = integers(doc_, *entry);
            if (!value) return value.why();
            const std::int32_t n = value->front();
            if (n < 1 || static_cast<std::uint64_t>(n) > left)
                return fail("F014", entry->place, "expected a number of cells that the file can hold, found " + std::to_string(n));
            left /= static_cast<std::uint64_t>(n);
            grid_.dims[d] = static_cast<std::uint32_t>(n);
        }
        return {};
    }

    Result<void> take_three(const char* tag_name, const char* first, const char* second, const char* third, std::string_view key,
                            Vec3& to) {
        const Tag* tag = find_tag(doc_, tag_name);
        if (tag == nullptr) return {};
        const char* names[] = {first, second, third};
        std::string text;
        for (std::size_t d = 0; d < 3; ++d) {
            const Entry* entry = find_entry(*tag, names[d]);
            if (entry == nullptr || entry->count != 1) continue;
            const auto value = doubles(doc_, *entry);
            if (!value) return value.why();
            if (!std::isfinite(value->front())) return fail("F006", entry->place, std::string("expected a finite number as ") + names[d]);
            to[d] = value->front();
        }
        for (const double v : to) {
            if (!text.empty()) text += ' ';
            append_number(text, v);
        }
        grid_.info.annotations.push_back({std::string(key), text});
        return {};
    }

    Result<void> take_transform() {
        if (auto done = take_three("translate", "xoffset", "yoffset", "zoffset", translate_key, offset_); !done) return done;
        if (auto done = take_three("scale", "xscale", "yscale", "zscale", scale_key, scale_); !done) return done;
        for (const double s : scale_) {
            if (s == 0) return unreadable("F012", {doc_.input.name()}, "expected scales other than 0");
        }
        return {};
    }

    /// Adding 0 makes a negative zero a plain one.
    double real(std::size_t axis, double local) const { return (local + offset_[axis]) * scale_[axis] + 0.0; }

    Result<const Entry*> array_of(const char* tag_name, const char* name, bool needed) const {
        const Tag* tag = find_tag(doc_, tag_name);
        const Entry* entry = tag == nullptr ? nullptr : find_entry(*tag, name);
        if (entry == nullptr && needed)
            return fail("F012", tag == nullptr ? 0 : tag->place, std::string("expected the array ") + name + " in the tag " + tag_name);
        return entry;
    }

    Result<void> take_lines() {
        const auto entry = array_of("cornerLines", "data", true);
        if (!entry) return entry.why();
        const std::size_t pillars = pillar_count(grid_.dims);
        if ((*entry)->count != 6 * pillars) return wrong_count(**entry, 6 * pillars);
        const auto values = doubles(doc_, **entry);
        if (!values) return values.why();
        grid_.info.precision =
            (*entry)->type == ValueType::real ? CoordinatePrecision::single_precision : CoordinatePrecision::double_precision;
        for (std::size_t d = 0; d < 3; ++d) grid_.info.stored_around[d] = real(d, 0);
        for (std::size_t v = 0; v < values->size(); ++v) {
            if (!std::isfinite((*values)[v]))
                return fail("F006", (*entry)->place, "value " + std::to_string(v + 1) + " of the corner lines is not finite");
        }
        const std::size_t lines_x = std::size_t{grid_.dims[0]} + 1, lines_y = std::size_t{grid_.dims[1]} + 1;
        grid_.pillars.resize(6 * pillars);
        for (std::size_t i = 0; i < lines_x; ++i) {
            for (std::size_t j = 0; j < lines_y; ++j) {
                const double* from = values->data() + 6 * (i * lines_y + j);
                double* to = grid_.pillars.data() + 6 * (i + lines_x * j);
                for (std::size_t v = 0; v < 6; ++v) to[v] = real(v % 3, from[(v + 3) % 6]);  // the file has the bottom first
            }
        }
        return {};
    }

    /// How many depths each node has; and the first value of each slab of nodes of one i.
    Result<std::vector<std::uint64_t>> take_splits(std::vector<std::uint8_t>& splits) const {
        const auto entry = array_of("zvalues", "splitEnz", false);
        if (!entry) return entry.why();
        const std::size_t per_slab = (std::size_t{grid_.dims[1]} + 1) * (std::size_t{grid_.dims[2]} + 1);
        const std::size_t slabs = std::size_t{grid_.dims[0]} + 1;
        std::vector<std::uint64_t> first(slabs + 1, 0);
        if (*entry != nullptr) {
            if ((*entry)->count != slabs * per_slab) return wrong_count(**entry, slabs * per_slab);
            auto read = bytes(doc_, **entry);
            if (!read) return read.why();
            splits = std::move(*read);
        }
        for (std::size_t i = 0; i < slabs; ++i) {
            first[i + 1] = first[i] + (splits.empty() ? per_slab : 0);
            for (std::size_t n = i * per_slab; !splits.empty() && n < (i + 1) * per_slab; ++n) {
                const std::uint8_t s = splits[n];
                if (s != 1 && s != 2 && s != 4 && s != 8) {
                    return fail("F012", (*entry)->place,
                                "expected 1, 2, 4 or 8 as value " + std::to_string(n + 1) + " of 'splitEnz', found " + std::to_string(s));
                }
                first[i + 1] += s;
            }
        }
        return first;
    }

    Result<void> take_depths() {
        std::vector<std::uint8_t> splits;
        const auto first = take_splits(splits);
        if (!first) return first.why();
        const auto entry = array_of("zvalues", "data", true);
        if (!entry) return entry.why();
        if ((*entry)->count != first->back()) return wrong_count(**entry, first->back());
        const auto values = doubles(doc_, **entry);
        if (!values) return values.why();
        make_big(grid_.depths, 8 * grid_.cell_count());
        std::atomic<bool> finite{true};
        parallel_blocks(first->size() - 1, 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i != to; ++i) {
                if (!put_slab(i, splits, values->data() + (*first)[i])) finite = false;
            }
        });
        if (!finite) return fail("F006", (*entry)->place, "expected finite depths of corners");
        return {};
    }

    /// Depths of the nodes of one i, onto the corners of the cells around them. False where one is not finite.
    bool put_slab(std::size_t i, const std::vector<std::uint8_t>& splits, const double* values) {
        const auto [nx, ny, nz] = grid_.dims;
        bool finite = true;
        std::size_t node = i * (std::size_t{ny} + 1) * (std::size_t{nz} + 1);
        for (std::size_t j = 0; j <= ny; ++j) {
            for (std::size_t k = 0; k <= nz; ++k, ++node) {
                const unsigned split = splits.empty() ? 1 : splits[node];
                for (unsigned v = 0; v < 8; ++v) {  // below SW SE NW NE, above SW SE NW NE
                    const std::size_t from_left = v & 1u, from_south = (v >> 1) & 1u, above = v >> 2;
                    const std::size_t ci = i + from_left - 1, cj = j + from_south - 1;  // wraps where there is no cell
                    const std::size_t layer = above != 0 ? nz - 1 - k : nz - k;         // wraps likewise
                    if (ci >= nx || cj >= ny || layer >= nz) continue;
                    const unsigned corner = static_cast<unsigned>((1 - from_left) + 2 * (1 - from_south) + 4 * above);
                    const double local = values[split == 1 ? 0 : split == 2 ? above : split == 4 ? v % 4 : v];
                    finite = finite && std::isfinite(local);
                    grid_.depths[corner_index(grid_.dims, ci, cj, layer, corner)] = real(2, local);
                }
                values += split;
            }
        }
        return finite;
    }

    Result<void> take_activity() {
        if (find_tag(doc_, "active") == nullptr) return {};
        const auto entry = array_of("active", "data", true);
        if (!entry) return entry.why();
        if ((*entry)->count != grid_.cell_count()) return wrong_count(**entry, grid_.cell_count());
        auto values = bytes(doc_, **entry);
        if (!values) return values.why();
        for (std::uint8_t& v : *values) v = v != 0 ? 1 : 0;
        grid_.activity = in_our_order(*values, grid_.dims);
        return {};
    }

    Result<void> take_other(const Tag& tag) {
        constexpr std::string_view known[] = {"version", "dimensions", "translate", "scale", "cornerLines", "zvalues", "active", "eof"};
        if (std::ranges::find(known, tag.name) != std::end(known)) return {};
        if (tag.name == "parameter") return take_parameter(tag);
        auto text = tag_text(doc_, tag);
        if (!text) return text.why();
        grid_.info.annotations.push_back({std::string(tag_key), std::move(*text)});
        if (tag.name == "subgrids") take_subgrids(tag);
        return {};
    }

    /// Which subgrid a cell is in, as a property: so it gets into formats that know no subgrids.
    void take_subgrids(const Tag& tag) {
        const auto& attributes = grid_.info.attributes;
        if (subgrid_layers(grid_).empty()) {
            drop(data_.findings, data_.losses,
                 {.loss_class = LossClass::identity,
                  .entity = grid_.info.name,
                  .what = "tag 'subgrids'",
                  .why = "its nLayers are not numbers above 0 that add up to the " + counted(grid_.dims[2], "layer", "layers") +
                         " of the grid",
                  .where = place_at(doc_, tag.place)});
            return;
        }
        if (std::ranges::find(attributes, subgrid_name, &Attribute::name) != attributes.end()) return;
        if (auto a = subgrid_attribute(grid_)) grid_.info.attributes.push_back(std::move(*a));
    }

    Result<void> take_parameter(const Tag& tag) {
        const Entry *name_entry = find_entry(tag, "name"), *data = find_entry(tag, "data");
        if (name_entry == nullptr || data == nullptr) return fail("F012", tag.place, "expected the name and the data of a parameter");
        const auto name = texts(doc_, *name_entry);
        if (!name) return name.why();
        if (data->count != grid_.cell_count()) return wrong_count(*data, grid_.cell_count());
        Attribute a;
        a.name = name->empty() ? "" : name->front();
        a.location = AttributeLocation::cell;
        if (auto done = take_values(*data, a); !done) return done;
        if (auto done = take_codes(tag, a); !done) return done;
        for (const Entry& entry : tag.entries) {
            if (&entry == name_entry || &entry == data || entry.name == "codeNames" || entry.name == "codeValues") continue;
            auto text = entry_text(doc_, entry);
            if (!text) return text.why();
            a.annotations.emplace_back("roff.entry", std::move(*text));
        }
        grid_.info.attributes.push_back(std::move(a));
        return {};
    }

    Result<void> take_values(const Entry& data, Attribute& a) {
        const auto put = [&](auto read) -> Result<void> {
            if (!read) return read.why();
            drop_not_finite(data, a, *read);
            a.values = in_our_order(*read, grid_.dims);
            return {};
        };
        switch (data.type) {
            case ValueType::integer:
                a.no_data = missing_integer;
                return put(integers(doc_, data));
            case ValueType::real:
                a.no_data = missing_real;
                return put(floats(doc_, data));
            case ValueType::real_double:
                a.no_data = missing_real;
                return put(doubles(doc_, data));
            case ValueType::byte:
                a.no_data = missing_byte;
                return put(bytes(doc_, data));
            case ValueType::boolean:
                a.annotations.emplace_back(type_key, "bool");
                return put(bytes(doc_, data));
            case ValueType::text:
                return put(texts(doc_, data));
        }
        return {};
    }

    template <class T>
    void drop_not_finite(const Entry& data, const Attribute& a, std::vector<T>& values) {
        if constexpr (std::is_floating_point_v<T>) {
            std::uint64_t count = 0;
            for (T& v : values) {
                if (std::isfinite(v)) continue;
                v = static_cast<T>(missing_real);
                ++count;
            }
            if (count == 0) return;
            data_.findings.push_back(make_finding("F120", "values of '" + a.name + "' that are not finite are taken as missing",
                                                  place_at(doc_, data.place), count));
            data_.findings.back().entities = {{"attribute", a.name}};
        }
    }

    Result<void> take_codes(const Tag& tag, Attribute& a) const {
        const Entry *names_entry = find_entry(tag, "codeNames"), *values_entry = find_entry(tag, "codeValues");
        if (names_entry == nullptr || values_entry == nullptr) return {};
        if (names_entry->count != values_entry->count) return wrong_count(*values_entry, names_entry->count);
        const auto names = texts(doc_, *names_entry);
        if (!names) return names.why();
        const auto values = integers(doc_, *values_entry);
        if (!values) return values.why();
        for (std::size_t i = 0; i < names->size(); ++i) a.code_names.emplace_back((*values)[i], (*names)[i]);
        return {};
    }

    /// Layers that lie one above the other with decreasing negative depths are elevations.
    void finish() {
        CoordinateSystem& crs = grid_.info.crs;
        crs.z_positive = ZPositive::depth;
        crs.z_positive_stated = true;
        if (grid_.depths.empty()) return;
        double top = 0, bottom = 0;
        const auto [nx, ny, nz] = grid_.dims;
        for (std::size_t n = 0; n < std::size_t{4} * nx * ny; ++n) {
            top += grid_.depths[n];
            bottom += grid_.depths[grid_.depths.size() - 4 * std::size_t{nx} * ny + n];
        }
        if (!(bottom < top && top < 0)) return;
        for (double& z : grid_.depths) z = 0.0 - z;
        for (std::size_t v = 2; v < grid_.pillars.size(); v += 3) grid_.pillars[v] = 0.0 - grid_.pillars[v];
        crs.z_positive = ZPositive::elevation;
        data_.findings.push_back(
            make_finding("F132", "the corner depths are negative and decrease downwards: they are elevations, and were turned into depths",
                         place_at(doc_, find_tag(doc_, "zvalues")->place), 1));
    }

    const Document& doc_;
    const ReadOptions& options_;
    Dataset data_;
    CornerPointGrid grid_;
    Vec3 offset_{0, 0, 0}, scale_{1, 1, 1};
};

}  // namespace

Result<Dataset> read_roff(const Input& input, const ReadOptions& options) {
    const auto document = find_tags(input, options.monitor);
    if (!document) return document.why();
    return RoffReader(*document, options).run();
}

}  // namespace geomend::roff
