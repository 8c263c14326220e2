// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/drop.h"
#include "formats/surfaces/ply.h"
#include "formats/surfaces/ply_header.h"
#include "formats/text_reading.h"

namespace geomend::surfaces {

namespace {

/// Values one after the other, as text or as bytes.
class Values {
public:
    Values(const Input& input, const TextCursor& cursor, PlyEncoding encoding)
        : input_(input), cursor_(cursor), encoding_(encoding), at_(cursor.next_line_begin()), end_(cursor.text_end()) {}

    /// To the next element: a line of its own in text.
    std::optional<Failure> begin_element(std::string_view what) {
        if (encoding_ != PlyEncoding::text) return std::nullopt;
        while (cursor_.next_line()) {
            if (!cursor_.at_line_end()) return std::nullopt;
        }
        return cut(what);
    }

    std::optional<Failure> next(PlyType type, std::string_view what, double& value) {
        if (encoding_ == PlyEncoding::text) {
            const std::string_view token = cursor_.token();
            const NumberStatus status = parse_real(token, value);
            if (status != NumberStatus::malformed) return std::nullopt;
            return unreadable("F005", location_of(input_, cursor_, token), "expected " + std::string(what) + ", found " + shown(token));
        }
        const std::size_t size = size_of(type);
        if (static_cast<std::size_t>(end_ - at_) < size) return cut(what);
        std::array<char, 8> bytes{};
        std::memcpy(bytes.data(), at_, size);
        at_ += size;
        if (encoding_ == PlyEncoding::big_endian) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        value = decoded(type, bytes.data());
        return std::nullopt;
    }

    /// Where the last value stands.
    Location where() const {
        if (encoding_ == PlyEncoding::text) return {input_.name(), cursor_.line(), cursor_.column()};
        return {input_.name()};
    }
    /// Bytes that are left: no more values than these.
    std::uint64_t left() const {
        if (encoding_ == PlyEncoding::text)
            return static_cast<std::uint64_t>(cursor_.text_end() - cursor_.next_line_begin()) + cursor_.peek_rest().size();
        return static_cast<std::uint64_t>(end_ - at_);
    }
    bool is_text() const { return encoding_ == PlyEncoding::text; }

private:
    const Input& input_;
    TextCursor cursor_;
    PlyEncoding encoding_;
    const char *at_, *end_;

    Failure cut(std::string_view what) const {
        return unreadable("F004", where(), "expected " + std::string(what) + ", found the end of the file");
    }

    template <class Number>
    static double as(const char* bytes) {
        Number n{};
        std::memcpy(&n, bytes, sizeof n);
        return static_cast<double>(n);
    }
    static double decoded(PlyType type, const char* bytes) {
        switch (type) {
            case PlyType::int8:
                return as<std::int8_t>(bytes);
            case PlyType::uint8:
                return as<std::uint8_t>(bytes);
            case PlyType::int16:
                return as<std::int16_t>(bytes);
            case PlyType::uint16:
                return as<std::uint16_t>(bytes);
            case PlyType::int32:
                return as<std::int32_t>(bytes);
            case PlyType::uint32:
                return as<std::uint32_t>(bytes);
            case PlyType::float32:
                return as<float>(bytes);
            case PlyType::float64:
                return as<double>(bytes);
        }
        return 0;
    }
};

AttributeValues empty_values(PlyType type) {
    switch (type) {
        case PlyType::int8:
            return std::vector<std::int8_t>{};
        case PlyType::uint8:
            return std::vector<std::uint8_t>{};
        case PlyType::int16:
            return std::vector<std::int16_t>{};
        case PlyType::uint16:
            return std::vector<std::uint16_t>{};
        case PlyType::int32:
            return std::vector<std::int32_t>{};
        case PlyType::uint32:
            return std::vector<std::uint32_t>{};
        case PlyType::float32:
            return std::vector<float>{};
        case PlyType::float64:
            break;
    }
    return std::vector<double>{};
}

/// False where a whole number does not fit.
bool append(AttributeValues& values, double value) {
    return std::visit(
        [value](auto& list) {
            using Number = typename std::decay_t<decltype(list)>::value_type;
            if constexpr (std::is_integral_v<Number>) {
                const bool fits = value == std::floor(value) && value >= static_cast<double>(std::numeric_limits<Number>::min()) &&
                                  value <= static_cast<double>(std::numeric_limits<Number>::max());
                list.push_back(fits ? static_cast<Number>(value) : Number{});
                return fits;
            } else if constexpr (std::is_floating_point_v<Number>) {
                list.push_back(static_cast<Number>(value));
                return true;
            } else {
                return false;
            }
        },
        values);
}

constexpr std::uint64_t most_elements = 0xfffffffe;

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options, PlyHeader header, Values values)
        : input_(input), options_(options), header_(std::move(header)), values_(std::move(values)) {}

    Result<Dataset> run() {
        const auto vertex = std::ranges::find(header_.elements, "vertex", &PlyElement::name);
        if (vertex == header_.elements.end()) return unreadable("F017", {input_.name()}, "expected an element 'vertex', found none");
        points_ = vertex->count;
        for (const PlyElement& element : header_.elements) {
            if (auto failed = check_size(element)) return std::move(*failed);
            auto failed = element.name == "vertex" ? vertices(element)
                          : element.name == "face" ? faces(element)
                          : element.name == "edge" ? edges(element)
                                                   : skipped(element);
            if (failed) return std::move(*failed);
        }
        if (values_.left() > 0 && !values_.is_text())
            drop(data_.findings, data_.losses,
                 {.what = "bytes behind the last element",
                  .why = "the header announces no more",
                  .count = values_.left(),
                  .where = {input_.name()},
                  .code = "F107"});
        return finish();
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    PlyHeader header_;
    Values values_;
    std::uint64_t points_ = 0;
    Surface surface_;
    PolylineSet lines_;
    Dataset data_;
    std::uint64_t unfit_ = 0;

    /// A property that becomes an attribute, and where it goes.
    struct Kept {
        std::size_t property;
        Attribute attribute;
    };

    std::optional<Failure> check_size(const PlyElement& element) const {
        std::uint64_t least = 0;
        for (const PlyProperty& p : element.properties) least += values_.is_text() ? 1 : size_of(p.count_type.value_or(p.type));
        if (element.count <= most_elements && element.count * std::max<std::uint64_t>(least, 1) <= values_.left() + 1) return std::nullopt;
        return unreadable(
            "F014", {input_.name()},
            "the header asks for " + std::to_string(element.count) + " of element '" + element.name + "', more than the file can hold");
    }

    bool is_stopped(std::uint64_t i) const { return i % 16384 == 0 && options_.monitor != nullptr && options_.monitor->stopped(); }

    std::vector<Kept> kept(const PlyElement& element, AttributeLocation location, std::initializer_list<std::string_view> others) {
        std::vector<Kept> all;
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (std::ranges::find(others, std::string_view(property.name)) != others.end()) continue;
            if (property.count_type) {
                drop(data_.findings, data_.losses,
                     {.what = "list '" + property.name + "' of element '" + element.name + "'",
                      .why = "attributes are single numbers",
                      .count = element.count,
                      .where = {input_.name()}});
                continue;
            }
            Attribute a;
            a.name = property.name;
            a.location = location;
            a.values = empty_values(property.type);
            all.push_back({p, std::move(a)});
        }
        return all;
    }

    /// Reads one property of one element; lists go to `list` where it is not null.
    std::optional<Failure> read(const PlyElement& element, const PlyProperty& property, double& value, std::vector<double>* list) {
        const std::string what = "'" + property.name + "' of element '" + element.name + "'";
        if (!property.count_type) return values_.next(property.type, what, value);
        double size = 0;
        if (auto failed = values_.next(*property.count_type, "the length of " + what, size)) return failed;
        if (!(size >= 0) || size != std::floor(size) || size > static_cast<double>(values_.left()) + 1)
            return unreadable("F014", values_.where(), "list " + what + " cannot have " + number_text(size) + " entries");
        for (double k = 0; k < size; ++k) {
            if (auto failed = values_.next(property.type, "an entry of " + what, value)) return failed;
            if (list != nullptr) list->push_back(value);
        }
        return std::nullopt;
    }

    void take(std::vector<Kept>& all, std::size_t property, double value) {
        for (Kept& k : all) {
            if (k.property == property && !append(k.attribute.values, value)) ++unfit_;
        }
    }
    static void move_to(std::vector<Kept>& all, ObjectInfo& info) {
        for (Kept& k : all) info.attributes.push_back(std::move(k.attribute));
    }

    std::optional<Failure> vertices(const PlyElement& element) {
        constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
        std::array<std::size_t, 3> place{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = std::ranges::find(element.properties, axes[k], &PlyProperty::name);
            if (found == element.properties.end() || found->count_type)
                return unreadable("F012", {input_.name()},
                                  "expected a property '" + std::string(axes[k]) + "' of element 'vertex', found none");
            place[k] = static_cast<std::size_t>(found - element.properties.begin());
        }
        if (!values_.is_text() && std::ranges::all_of(place, [&](std::size_t p) { return element.properties[p].type == PlyType::float32; }))
            surface_.info.precision = CoordinatePrecision::single_precision;
        auto all = kept(element, AttributeLocation::point, {"x", "y", "z"});
        surface_.points.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (is_stopped(i)) return stopped(input_);
            if (auto failed = values_.begin_element("vertex " + std::to_string(i))) return failed;
            Vec3& p = surface_.points.emplace_back();
            for (std::size_t c = 0; c < element.properties.size(); ++c) {
                double value = 0;
                if (auto failed = read(element, element.properties[c], value, nullptr)) return failed;
                const auto axis = std::ranges::find(place, c);
                if (axis == place.end()) {
                    take(all, c, value);
                    continue;
                }
                if (!std::isfinite(value))
                    return unreadable("F006", values_.where(), "a coordinate of vertex " + std::to_string(i) + " is not finite");
                p[static_cast<std::size_t>(axis - place.begin())] = value;
            }
        }
        move_to(all, surface_.info);
        return std::nullopt;
    }

    std::optional<std::uint32_t> point_of(double value) const {
        if (!(value >= 0) || value >= static_cast<double>(points_) || value != std::floor(value)) return std::nullopt;
        return static_cast<std::uint32_t>(value);
    }
    Failure no_point(const std::string& whose, double value) const {
        return unreadable("F007", values_.where(),
                          whose + " names vertex " + number_text(value) + ", which is not there: they run from 0 to " +
                              std::to_string(static_cast<std::int64_t>(points_) - 1));
    }

    std::optional<Failure> faces(const PlyElement& element) {
        const auto is_corners = [](const PlyProperty& p) {
            return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
        };
        const auto corners = std::ranges::find_if(element.properties, is_corners);
        if (corners == element.properties.end())
            return unreadable("F012", {input_.name()}, "expected a list 'vertex_indices' of element 'face', found none");
        auto all = kept(element, AttributeLocation::polygon, {"vertex_indices", "vertex_index"});
        std::vector<double> list;
        std::vector<std::uint32_t> polygon;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (is_stopped(i)) return stopped(input_);
            if (auto failed = values_.begin_element("face " + std::to_string(i))) return failed;
            polygon.clear();
            std::vector<double> numbers;
            for (const PlyProperty& property : element.properties) {
                double value = 0;
                list.clear();
                if (auto failed = read(element, property, value, &list)) return failed;
                numbers.push_back(value);
                if (&property != &*corners) continue;
                for (const double n : list) {
                    const auto point = point_of(n);
                    if (!point) return no_point("face " + std::to_string(i), n);
                    polygon.push_back(*point);
                }
            }
            if (polygon.size() < 3) {
                drop(data_.findings, data_.losses,
                     {.what = "a face of fewer than three corners", .why = "it has no interior", .where = {input_.name()}});
                continue;
            }
            surface_.polygons.push_back(polygon);
            for (std::size_t c = 0; c < numbers.size(); ++c) take(all, c, numbers[c]);
        }
        move_to(all, surface_.info);
        return std::nullopt;
    }

    std::optional<Failure> edges(const PlyElement& element) {
        std::array<std::size_t, 2> place{};
        for (std::size_t k = 0; k < 2; ++k) {
            const std::string name = "vertex" + std::to_string(k + 1);
            const auto found = std::ranges::find(element.properties, name, &PlyProperty::name);
            if (found == element.properties.end() || found->count_type) return skipped(element);
            place[k] = static_cast<std::size_t>(found - element.properties.begin());
        }
        auto all = kept(element, AttributeLocation::edge, {"vertex1", "vertex2"});
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (auto failed = values_.begin_element("edge " + std::to_string(i))) return failed;
            std::array<std::uint32_t, 2> edge{};
            for (std::size_t c = 0; c < element.properties.size(); ++c) {
                double value = 0;
                if (auto failed = read(element, element.properties[c], value, nullptr)) return failed;
                const auto end = std::ranges::find(place, c);
                if (end == place.end()) {
                    take(all, c, value);
                    continue;
                }
                const auto point = point_of(value);
                if (!point) return no_point("edge " + std::to_string(i), value);
                edge[static_cast<std::size_t>(end - place.begin())] = *point;
            }
            lines_.edges.push_back(edge);
        }
        move_to(all, lines_.info);
        return std::nullopt;
    }

    std::optional<Failure> skipped(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (auto failed = values_.begin_element("element '" + element.name + "'")) return failed;
            double value = 0;
            for (const PlyProperty& property : element.properties) {
                if (auto failed = read(element, property, value, nullptr)) return failed;
            }
        }
        if (element.count > 0)
            drop(data_.findings, data_.losses,
                 {.what = "element '" + element.name + "'",
                  .why = "only vertices, faces and edges are read",
                  .count = element.count,
                  .where = {input_.name()}});
        return std::nullopt;
    }

    Result<Dataset> finish() {
        if (unfit_ > 0)
            data_.findings.push_back(
                make_finding("F105", "values that do not fit the type of their property are taken as 0", {input_.name()}, unfit_));
        for (const std::string& comment : header_.comments) surface_.info.annotations.push_back({"ply.header", comment});
        surface_.info.name = lines_.info.name = name_of(input_);
        if (!lines_.edges.empty()) lines_.points = surface_.points;
        if (surface_.polygons.size() > 0) {
            data_.objects.emplace_back(std::move(surface_));
        } else if (lines_.edges.empty()) {
            PointSet set;
            set.info = std::move(surface_.info);
            set.points = std::move(surface_.points);
            data_.objects.emplace_back(std::move(set));
        }
        if (!lines_.edges.empty()) data_.objects.emplace_back(std::move(lines_));
        return std::move(data_);
    }
};

}  // namespace

int sniff_ply(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    if (!cursor.next_line() || trimmed(cursor.line_text()) != "ply" || !cursor.next_line()) return 0;
    const std::string_view word = cursor.token();
    return word == "format" || word == "comment" || word == "obj_info" ? 98 : 0;
}

Result<Dataset> read_ply(const Input& input, const ReadOptions& options) {
    TextCursor cursor(text_of(input));
    auto header = read_ply_header(input, cursor);
    if (!header) return std::move(header).why();
    const PlyEncoding encoding = header->encoding;
    auto data = Reader(input, options, std::move(*header), Values(input, cursor, encoding)).run();
    if (!data) return data;
    data->format = "surface";
    data->variant = encoding == PlyEncoding::text ? "PLY, text" : "PLY, binary";
    if (encoding == PlyEncoding::text) tell_missing_line_end(input, *data);
    return data;
}

}  // namespace geomend::surfaces
