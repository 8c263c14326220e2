// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/stl.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/wording.h"
#include "formats/drop.h"
#include "formats/surfaces/faces_writing.h"
#include "formats/surfaces/positions.h"
#include "formats/text_reading.h"

namespace geomend::surfaces {

namespace {

constexpr std::size_t header_size = 84, facet_size = 50;

/// Twice the area, along the normal that the corners' order gives.
Vec3 normal_of(const std::array<Vec3, 3>& t) {
    const Vec3 u{t[1][0] - t[0][0], t[1][1] - t[0][1], t[1][2] - t[0][2]}, v{t[2][0] - t[0][0], t[2][1] - t[0][1], t[2][2] - t[0][2]};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

bool faces_other_way(const std::array<Vec3, 3>& corners, const Vec3& stated) {
    const Vec3 n = normal_of(corners);
    return n[0] * stated[0] + n[1] * stated[1] + n[2] * stated[2] < 0;
}

/// One solid being read.
struct Solid {
    Surface surface;
    PositionNumbers numbers;
    std::uint64_t turned = 0;  ///< triangles whose stated normal looks the other way

    void add(const std::vector<Vec3>& corners, const Vec3& normal) {
        std::vector<std::uint32_t> polygon;
        for (const Vec3& p : corners) polygon.push_back(numbers.number(p));
        surface.polygons.push_back(polygon);
        if (corners.size() == 3 && faces_other_way({corners[0], corners[1], corners[2]}, normal)) ++turned;
    }
    void finish(Dataset& to, const Input& input) {
        surface.points = numbers.positions();
        if (turned > 0) {
            Finding finding = make_finding("F113",
                                           counted(turned, "triangle of '", "triangles of '") + surface.info.name +
                                               "' state a normal against the order of their corners: the order was kept",
                                           {input.name()}, turned);
            to.findings.push_back(std::move(finding));
        }
        to.objects.emplace_back(std::move(surface));
    }
};

// ---- text ----

class TextReader {
public:
    TextReader(const Input& input, const ReadOptions& options) : input_(input), options_(options), cursor_(text_of(input)) {}

    Result<Dataset> run() {
        while (next()) {
            if (word_ != "solid") return unexpected("solid");
            Solid solid;
            const std::string_view name = cursor_.rest();
            solid.surface.info.name = name.empty() ? name_of(input_) : std::string(name);
            if (auto failed = facets(solid)) return std::move(*failed);
            solid.finish(data_, input_);
        }
        if (failed_) return std::move(*failed_);
        if (data_.objects.empty()) return unreadable("F017", {input_.name()}, "expected a solid, found none");
        return std::move(data_);
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    TextCursor cursor_;
    std::string word_;
    std::optional<Failure> failed_;
    Dataset data_;

    /// The first word of the next line that is not empty, in lower case.
    bool next() {
        constexpr std::uint64_t often = 16384;
        while (cursor_.next_line()) {
            if (cursor_.line() % often == 0 && options_.monitor != nullptr && options_.monitor->stopped()) {
                failed_ = stopped(input_);
                return false;
            }
            const std::string_view token = cursor_.token();
            if (token.empty()) continue;
            word_ = lower_case(token);
            return true;
        }
        word_.clear();
        return false;
    }

    Failure unexpected(std::string_view expected) {
        if (failed_) return std::move(*failed_);
        const Location where{input_.name(), cursor_.line(), 1};
        if (word_.empty()) return unreadable("F004", where, "expected '" + std::string(expected) + "', found the end of the file");
        return unreadable("F012", where, "expected '" + std::string(expected) + "', found " + shown(trimmed(cursor_.line_text())));
    }

    std::optional<Failure> facets(Solid& solid) {
        while (next()) {
            if (word_ == "endsolid") return std::nullopt;
            if (word_ != "facet") return unexpected("facet");
            if (auto failed = facet(solid)) return failed;
        }
        if (failed_ || solid.surface.polygons.size() == 0) return unexpected("facet");
        data_.findings.push_back(
            make_finding("F101", "solid '" + solid.surface.info.name + "' has no endsolid", {input_.name(), cursor_.line()}, 1));
        return std::nullopt;
    }

    std::optional<Failure> three(std::string_view what, Vec3& to) {
        for (double& x : to) {
            if (auto failed = finite_number(input_, cursor_, cursor_.token(), what, x)) return failed;
        }
        return std::nullopt;
    }

    /// A normal is worth no failure: some programs write nan for triangles without area.
    Vec3 normal() {
        Vec3 n{};
        cursor_.token();  // "normal"
        for (double& x : n) {
            if (cursor_.real(x) != NumberStatus::ok || !std::isfinite(x)) return {};
        }
        return n;
    }

    std::optional<Failure> facet(Solid& solid) {
        const Vec3 stated = normal();
        if (!next() || word_ != "outer") return unexpected("outer loop");
        std::vector<Vec3> corners;
        while (next() && word_ == "vertex") {
            if (auto failed = three("a coordinate", corners.emplace_back())) return failed;
        }
        if (word_ != "endloop") return unexpected("endloop");
        if (corners.size() < 3)
            return unreadable("F012", {input_.name(), cursor_.line(), 1},
                              "expected 3 vertices in a loop, found " + std::to_string(corners.size()));
        if (!next() || word_ != "endfacet") return unexpected("endfacet");
        solid.add(corners, stated);
        return std::nullopt;
    }
};

// ---- binary ----

/// Bytes behind the triangles of a binary file; nothing where it is none. Such bytes are less than the triangles have.
std::optional<std::uint64_t> bytes_behind(std::string_view bytes) {
    if (bytes.size() < header_size) return std::nullopt;
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, 4);
    const std::uint64_t facets = std::uint64_t{facet_size} * count;
    if (bytes.size() < header_size + facets) return std::nullopt;
    const std::uint64_t more = bytes.size() - header_size - facets;
    if (more > 0 && (more >= facets || sniff_stl(bytes.substr(0, 4096), {}) > 0)) return std::nullopt;
    return more;
}

Vec3 vector_at(const char* at) {
    std::array<float, 3> v{};
    std::memcpy(v.data(), at, 12);
    return {v[0], v[1], v[2]};
}

Result<Dataset> read_binary(const Input& input, const ReadOptions& options, std::uint64_t more) {
    const std::string_view bytes = input.bytes().substr(0, input.bytes().size() - more);
    Solid solid;
    solid.surface.info.name = name_of(input);
    solid.surface.info.precision = CoordinatePrecision::single_precision;
    std::uint64_t marked = 0;
    std::vector<Vec3> corners(3);
    for (std::size_t at = header_size, i = 0; at < bytes.size(); at += facet_size, ++i) {
        if (i % 65536 == 0 && options.monitor != nullptr && options.monitor->stopped()) return stopped(input);
        const char* facet = bytes.data() + at;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = vector_at(facet + 12 * (k + 1));
            for (const double x : corners[k]) {
                if (!std::isfinite(x))
                    return unreadable("F006", {input.name()},
                                      "vertex " + std::to_string(k + 1) + " of triangle " + std::to_string(i + 1) + " is not finite");
            }
        }
        solid.add(corners, vector_at(facet));
        if (facet[48] != 0 || facet[49] != 0) ++marked;
    }
    Dataset data;
    if (marked > 0)
        list_dropped(data.losses, {LossClass::style, "", "attribute bytes of triangles", "programs use them for colours", marked});
    if (more > 0)
        drop(data.findings, data.losses,
             {.loss_class = more < facet_size ? LossClass::identity : LossClass::substance,
              .what = "what stands behind the triangles: " + counted(more, "byte", "bytes"),
              .why = "the file states " + counted((bytes.size() - header_size) / facet_size, "triangle", "triangles"),
              .where = {input.name()}});
    solid.finish(data, input);
    return data;
}

// ---- writing ----

constexpr Holds text_holds{.title = "STL", .names = true}, binary_holds{.title = "binary STL"};

void write_position(OutputFile& file, const Vec3& p) {
    file.number(p[0]) << ' ';
    file.number(p[1]) << ' ';
    file.number(p[2]) << '\n';
}

Vec3 unit_normal(const WrittenFaces& faces, std::size_t p) {
    const auto polygon = faces.polygons[p];
    Vec3 n = normal_of({faces.points[polygon[0]], faces.points[polygon[1]], faces.points[polygon[2]]});
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double& x : n) x = length > 0 && std::isfinite(length) ? x / length : 0;
    return n;
}

void write_text(const WrittenFaces& faces, OutputFile& file) {
    for (std::size_t s = 0; s < faces.surfaces.size(); ++s) {
        const std::string name(trimmed(faces.surfaces[s].info->name));
        file << "solid " << name << '\n';
        for (std::size_t p = faces.surfaces[s].first_polygon; p < faces.polygon_end(s) && file.good(); ++p) {
            file << "facet normal ";
            write_position(file, unit_normal(faces, p));
            file << "outer loop\n";
            for (const std::uint32_t corner : faces.polygons[p]) {
                file << "vertex ";
                write_position(file, faces.points[corner]);
            }
            file << "endloop\nendfacet\n";
        }
        file << "endsolid " << name << '\n';
    }
}

void write_binary(const WrittenFaces& faces, OutputFile& file, std::vector<Loss>& losses) {
    std::string bytes(80, ' ');
    const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(static_cast<std::uint32_t>(faces.polygons.size()));
    std::uint64_t rounded = 0;
    const auto append_vector = [&](const Vec3& p, bool counts) {
        for (const double x : p) {
            const auto stored = static_cast<float>(x);
            if (counts && static_cast<double>(stored) != x) ++rounded;
            append(stored);
        }
    };
    for (std::size_t p = 0; p < faces.polygons.size(); ++p) {
        append_vector(unit_normal(faces, p), false);
        for (const std::uint32_t corner : faces.polygons[p]) append_vector(faces.points[corner], true);
        append(std::uint16_t{0});
        file << bytes;
        bytes.clear();
    }
    if (rounded > 0)
        add_loss(losses, {LossClass::substance, "", "digits of coordinates", "binary STL holds single precision; encoding=text holds all",
                          rounded});
}

/// Points of a surface that are apart at one position, as along a cut, are one for whoever reads triangles.
void list_joined_points(const WrittenFaces& faces, std::vector<Loss>& losses) {
    for (std::size_t s = 0; s < faces.surfaces.size(); ++s) {
        const auto& surface = faces.surfaces[s];
        PositionNumbers numbers;
        for (std::size_t p = surface.first_point; p < faces.point_end(s); ++p) numbers.number(faces.points[p]);
        const std::size_t joined = faces.point_end(s) - surface.first_point - numbers.positions().size();
        if (joined > 0)
            add_loss(losses, {LossClass::identity, surface.info->name, "points apart at one position",
                              "STL has no numbers of points: whoever reads it joins them", joined});
    }
}

}  // namespace

int sniff_stl(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    if (!cursor.next_line() || !same_word(cursor.token(), "solid")) return 0;
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty()) continue;
        return same_word(word, "facet") || same_word(word, "endsolid") ? 95 : 0;
    }
    return 0;
}

Result<Dataset> read_stl(const Input& input, const ReadOptions& options) {
    const auto more = bytes_behind(input.bytes());
    auto data = [&]() -> Result<Dataset> {
        if (more) return read_binary(input, options, *more);
        TextCursor cursor(text_of(input));
        if (cursor.next_line() && same_word(cursor.token(), "solid")) return TextReader(input, options).run();
        return unreadable(
            "F008", {input.name()},
            "neither a text that begins with 'solid' nor a binary file: of that size it would be 84 bytes and 50 for each triangle");
    }();
    if (!data) return data;
    data->format = "surface";
    data->variant = more ? "STL, binary" : "STL, text";
    return data;
}

Result<std::vector<Loss>> write_stl(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const bool binary = option_value(options.options, "encoding") == "binary";
    const auto faces = faces_for_writing(dataset, binary ? binary_holds : text_holds, out, losses);
    if (!faces) return faces.why();
    list_joined_points(*faces, losses);
    if (binary) write_binary(*faces, out.main_file(), losses);
    else write_text(*faces, out.main_file());
    return losses;
}

}  // namespace geomend::surfaces
