// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/obj.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "formats/drop.h"
#include "formats/surfaces/faces_writing.h"
#include "formats/text_reading.h"

namespace geomend::surfaces {

namespace {

/// What stands under one name; numbers are those of the file's positions.
struct Part {
    std::string name;
    Polygons polygons;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint64_t> first_edges;  ///< of each line
    std::vector<std::uint32_t> points;
};

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options) : input_(input), options_(options), cursor_(text_of(input)) {}

    Result<Dataset> run() {
        constexpr std::uint64_t often = 16384;
        while (cursor_.next_line()) {
            if (cursor_.line() % often == 0 && options_.monitor != nullptr && options_.monitor->stopped()) return stopped(input_);
            goes_on_ = false;
            if (auto failed = record(cursor_.token())) return std::move(*failed);
        }
        for (Part& part : parts_) finish(part);
        if (data_.objects.empty() && !positions_.empty()) {
            PointSet set;
            set.info.name = name_of(input_);
            set.points = positions_;
            data_.objects.emplace_back(std::move(set));
        }
        if (data_.objects.empty()) return unreadable("F017", {input_.name()}, "expected positions ('v x y z'), found none");
        for (const auto& [word, count] : style_)
            list_dropped(data_.losses, {LossClass::style, "", "records '" + word + "'", "they say how things look", count});
        tell_missing_line_end(input_, data_);
        return std::move(data_);
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    TextCursor cursor_;
    Dataset data_;
    std::vector<Vec3> positions_;
    std::vector<Part> parts_;
    std::map<std::string, std::size_t> part_of_;
    std::string name_;
    std::map<std::string, std::uint64_t> style_;
    bool goes_on_ = false;  // the word at hand ends with the '\\' that joins the next line to this one

    /// The next word of a record, which a '\\' at the end of a line carries on to the next one; empty at its end.
    std::string_view word() {
        while (true) {
            if (goes_on_ && !cursor_.next_line()) return {};
            goes_on_ = false;
            std::string_view token = cursor_.token();
            if (!token.ends_with('\\') || !cursor_.at_line_end()) return token;
            token.remove_suffix(1);
            goes_on_ = true;
            if (!token.empty()) return token;
        }
    }
    void skip_record() {
        while (cursor_.rest().ends_with('\\') && cursor_.next_line()) {
        }
    }
    /// Passes over the rest of a record; false where there was none.
    bool pass_rest() {
        bool any = false;
        while (!word().empty()) any = true;
        return any;
    }

    std::optional<Failure> record(std::string_view name) {
        if (name.empty() || name.starts_with('#')) return std::nullopt;
        if (name == "v") return position();
        if (name == "f") return face();
        if (name == "l") return line();
        if (name == "p") return points();
        if (name == "o" || name == "g") {
            name_ = cursor_.rest();
            return std::nullopt;
        }
        constexpr std::array<std::string_view, 7> looks{"vt", "vn", "usemtl", "mtllib", "s", "usemap", "maplib"};
        if (std::ranges::find(looks, name) != looks.end()) {
            ++style_[std::string(name)];
            skip_record();
            return std::nullopt;
        }
        drop(data_.findings, data_.losses,
             {.what = "record '" + std::string(name.substr(0, 40)) + "'",
              .why = "curves, free-form surfaces and what is no record of OBJ files are not read",
              .where = {input_.name(), cursor_.line()}});
        skip_record();
        return std::nullopt;
    }

    std::optional<Failure> position() {
        Vec3 p{};
        for (double& x : p) {
            if (auto failed = finite_number(input_, cursor_, word(), "a coordinate", x)) return failed;
        }
        if (pass_rest()) ++style_["v with colours"];
        if (positions_.size() >= no_index) return unreadable("F014", {input_.name(), cursor_.line()}, "expected fewer than 2^32 positions");
        positions_.push_back(p);
        return std::nullopt;
    }

    Part& part() {
        const auto [at, is_new] = part_of_.try_emplace(name_, parts_.size());
        if (is_new) parts_.push_back({name_.empty() ? name_of(input_) : name_, {}, {}, {}, {}});
        return parts_[at->second];
    }

    /// The positions that the rest of the line names: "7", "7/1/2", or "-1" for the last one so far.
    std::optional<Failure> corners(std::size_t least, std::vector<std::uint32_t>& to) {
        to.clear();
        const std::uint64_t first = cursor_.line();
        for (std::string_view token = word(); !token.empty() && !token.starts_with('#'); token = word()) {
            std::int64_t n = 0;
            if (parse_integer(token.substr(0, token.find('/')), n) != NumberStatus::ok)
                return unreadable("F005", location_of(input_, cursor_, token), "expected the number of a position, found " + shown(token));
            const auto size = static_cast<std::int64_t>(positions_.size());
            const std::int64_t index = n < 0 ? size + n : n - 1;
            if (index < 0 || index >= size)
                return unreadable("F007", location_of(input_, cursor_, token),
                                  "position " + std::to_string(n) + " is not there: " + std::to_string(size) + " were given so far");
            to.push_back(static_cast<std::uint32_t>(index));
        }
        if (to.size() >= least) return std::nullopt;
        return unreadable("F012", {input_.name(), first, 1},
                          "expected at least " + std::to_string(least) + " positions, found " + std::to_string(to.size()));
    }

    std::optional<Failure> face() {
        std::vector<std::uint32_t> polygon;
        if (auto failed = corners(3, polygon)) return failed;
        part().polygons.push_back(polygon);
        return std::nullopt;
    }
    std::optional<Failure> line() {
        std::vector<std::uint32_t> way;
        if (auto failed = corners(2, way)) return failed;
        Part& to = part();
        to.first_edges.push_back(to.edges.size());
        for (std::size_t i = 1; i < way.size(); ++i) to.edges.push_back({way[i - 1], way[i]});
        return std::nullopt;
    }
    std::optional<Failure> points() {
        std::vector<std::uint32_t> some;
        if (auto failed = corners(1, some)) return failed;
        Part& to = part();
        to.points.insert(to.points.end(), some.begin(), some.end());
        return std::nullopt;
    }

    /// The positions of some numbers, ascending, and the numbers as places among them. Where one part has all, all stay.
    std::vector<Vec3> take_positions(std::vector<std::uint32_t*> numbers) const {
        if (parts_.size() == 1) return positions_;
        std::vector<std::uint32_t> used;
        for (const std::uint32_t* n : numbers) used.push_back(*n);
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t* n : numbers) *n = static_cast<std::uint32_t>(std::ranges::lower_bound(used, *n) - used.begin());
        std::vector<Vec3> taken;
        for (const std::uint32_t n : used) taken.push_back(positions_[n]);
        return taken;
    }

    void finish(Part& part) {
        std::vector<std::uint32_t*> numbers;
        if (part.polygons.size() > 0) {
            Surface surface;
            surface.info.name = part.name;
            surface.polygons = std::move(part.polygons);
            for (std::uint32_t& c : surface.polygons.corners) numbers.push_back(&c);
            surface.points = take_positions(std::move(numbers));
            data_.objects.emplace_back(std::move(surface));
        }
        if (!part.edges.empty()) {
            PolylineSet set;
            set.info.name = part.name;
            set.edges = std::move(part.edges);
            numbers.clear();
            for (auto& edge : set.edges) numbers.insert(numbers.end(), {&edge[0], &edge[1]});
            set.points = take_positions(std::move(numbers));
            data_.objects.emplace_back(std::move(set));
        }
        if (!part.points.empty()) {
            PointSet set;
            set.info.name = part.name;
            for (const std::uint32_t n : part.points) set.points.push_back(positions_[n]);
            data_.objects.emplace_back(std::move(set));
        }
    }
};

}  // namespace

int sniff_obj(std::string_view head, std::string_view base_name) {
    if (!lower_case(base_name).ends_with(".obj")) return 0;  // lines of "v 1 2 3" are in other files, too
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty() || word.starts_with('#')) continue;
        constexpr std::array<std::string_view, 9> first{"v", "vn", "vt", "o", "g", "mtllib", "usemtl", "s", "f"};
        return std::ranges::find(first, word) != first.end() ? 60 : 0;
    }
    return 0;
}

Result<Dataset> read_obj(const Input& input, const ReadOptions& options) {
    auto data = Reader(input, options).run();
    if (!data) return data;
    data->format = "surface";
    data->variant = "OBJ";
    return data;
}

Result<std::vector<Loss>> write_obj(const Dataset& dataset, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses;
    const auto faces = faces_for_writing(dataset, {.title = "OBJ", .names = true, .polygons = true}, out, losses);
    if (!faces) return faces.why();
    OutputFile& file = out.main_file();
    std::set<std::string> names;
    for (std::size_t s = 0; s < faces->surfaces.size(); ++s) {
        const auto& surface = faces->surfaces[s];
        file << "o " << name_in_file(trimmed(surface.info->name), s, names, losses) << '\n';
        for (std::size_t v = surface.first_point; v < faces->point_end(s) && file.good(); ++v) {
            file << "v ";
            file.number(faces->points[v][0]) << ' ';
            file.number(faces->points[v][1]) << ' ';
            file.number(faces->points[v][2]) << '\n';
        }
        for (std::size_t p = surface.first_polygon; p < faces->polygon_end(s) && file.good(); ++p) {
            file << 'f';
            for (const std::uint32_t corner : faces->polygons[p]) {
                file << ' ';
                file.number(std::uint64_t{corner} + 1);
            }
            file << '\n';
        }
    }
    return losses;
}

}  // namespace geomend::surfaces
