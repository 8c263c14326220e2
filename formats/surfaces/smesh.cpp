// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/smesh.h"

#include <filesystem>
#include <map>

#include "formats/drop.h"
#include "formats/surfaces/faces_writing.h"
#include "formats/surfaces/positions.h"
#include "formats/text_reading.h"

namespace geomend::surfaces {

namespace {

bool is_poly(std::string_view base_name) { return lower_case(base_name).ends_with(".poly"); }

/// The words of a file whatever lines they stand on, without comments; names of markers from comments.
class Words {
public:
    explicit Words(const Input& input) : input_(input), cursor_(text_of(input)) {}

    /// The next word; empty at the end of the file.
    std::string_view next() {
        while (!started_ || cursor_.at_line_end() || cursor_.peek_rest().starts_with('#')) {
            if (started_ && !cursor_.at_line_end()) note(cursor_.peek_rest().substr(1));
            if (!cursor_.next_line()) return {};
            started_ = true;
        }
        return cursor_.token();
    }
    bool line_has_more() { return !cursor_.at_line_end() && !cursor_.peek_rest().starts_with('#'); }
    std::uint64_t line() const { return cursor_.line(); }
    const std::map<std::int64_t, std::string>& names() const { return names_; }

    std::optional<Failure> whole(const std::string& what, std::int64_t& value) {
        const std::string_view word = next();
        if (word.empty()) return unreadable("F004", {input_.name(), cursor_.line()}, "expected " + what + ", found the end of the file");
        if (parse_integer(word, value) != NumberStatus::ok)
            return unreadable("F005", location_of(input_, cursor_, word), "expected " + what + " as a whole number, found " + shown(word));
        return std::nullopt;
    }
    std::optional<Failure> real(const std::string& what, double& value) {
        const std::string_view word = next();
        if (word.empty()) return unreadable("F004", {input_.name(), cursor_.line()}, "expected " + what + ", found the end of the file");
        return finite_number(input_, cursor_, word, what, value);
    }
    /// A number of things that take so many bytes each at least.
    std::optional<Failure> count(const std::string& what, std::uint64_t bytes, std::uint64_t& value) {
        std::int64_t n = 0;
        if (auto failed = whole("the number of " + what, n)) return failed;
        if (n < 0 || static_cast<std::uint64_t>(n) > input_.bytes().size() / bytes + 1 || static_cast<std::uint64_t>(n) >= no_index)
            return unreadable("F014", {input_.name(), cursor_.line()},
                              std::to_string(n) + " " + what + " are announced, more than the file can hold");
        value = static_cast<std::uint64_t>(n);
        return std::nullopt;
    }

private:
    const Input& input_;
    TextCursor cursor_;
    bool started_ = false;
    std::map<std::int64_t, std::string> names_;

    void note(std::string_view comment) {
        TextCursor words(comment);
        std::int64_t number = 0;
        if (!words.next_line() || words.token() != "marker") return;
        std::string_view word = words.token();
        if (!word.ends_with(':')) return;
        word.remove_suffix(1);
        if (parse_integer(word, number) == NumberStatus::ok) names_.emplace(number, std::string(words.rest()));
    }
};

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options)
        : input_(input), options_(options), words_(input), poly_(is_poly(input.base_name())) {}

    Result<Dataset> run() {
        if (auto failed = nodes()) return std::move(*failed);
        if (auto failed = facets()) return std::move(*failed);
        if (auto failed = points_of("holes", 3)) return std::move(*failed);
        if (auto failed = points_of("regions", 4)) return std::move(*failed);
        if (holes_ > 0)
            drop(data_.findings, data_.losses,
                 {.what = "holes in facets", .why = "polygons here have none", .count = holes_, .where = {input_.name()}});
        for (auto& [marker, made] : surfaces_) {
            const auto name = words_.names().find(marker);
            made.surface.info.name = name != words_.names().end() ? name->second
                                     : surfaces_.size() == 1      ? name_of(input_)
                                                                  : "surface " + std::to_string(marker);
            data_.objects.emplace_back(std::move(made.surface));
        }
        return std::move(data_);
    }

private:
    struct Made {
        Surface surface;
        std::map<std::uint32_t, std::uint32_t> point_of;  // by node
    };

    const Input& input_;
    const ReadOptions& options_;
    Words words_;
    bool poly_;
    std::vector<Vec3> nodes_;
    std::int64_t first_ = 1;
    std::map<std::int64_t, Made> surfaces_;
    std::uint64_t holes_ = 0;
    Dataset data_;

    bool is_stopped(std::uint64_t i) const { return i % 16384 == 0 && options_.monitor != nullptr && options_.monitor->stopped(); }

    std::optional<Failure> nodes() {
        std::uint64_t count = 0;
        std::array<std::int64_t, 3> more{};
        if (auto failed = head(input_, words_, count, more)) return failed;
        if (count > 0) return node_list(input_, words_, count, more);
        const std::string name = name_of(input_) + ".node";
        auto beside = input_.companion(name);
        if (!beside) return std::move(beside).why();
        Words words(*beside);
        if (auto failed = head(*beside, words, count, more)) return failed;
        return node_list(*beside, words, count, more);
    }

    static std::optional<Failure> head(const Input& input, Words& words, std::uint64_t& count, std::array<std::int64_t, 3>& more) {
        if (auto failed = words.count("nodes", 6, count)) return failed;
        more = {3, 0, 0};
        for (std::size_t k = 0; k < 3 && words.line_has_more(); ++k) {
            if (auto failed = words.whole("a number of the list of nodes", more[k])) return failed;
        }
        if (more[0] != 3)
            return unreadable("F013", {input.name(), words.line()},
                              "nodes of dimension " + std::to_string(more[0]) + ": only three are read");
        if (more[1] < 0 || more[1] > 1000 || more[2] < 0 || more[2] > 1)
            return unreadable("F014", {input.name(), words.line()}, "expected up to 1000 attributes and 0 or 1 markers of a node");
        return std::nullopt;
    }

    std::optional<Failure> node_list(const Input& input, Words& words, std::uint64_t count, const std::array<std::int64_t, 3>& more) {
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input);
            std::int64_t id = 0;
            if (auto failed = words.whole("the number of a node", id)) return failed;
            if (i == 0) first_ = id;
            if (id != first_ + static_cast<std::int64_t>(i))
                return unreadable(
                    "F012", {input.name(), words.line()},
                    "expected node " + std::to_string(first_ + static_cast<std::int64_t>(i)) + ", found node " + std::to_string(id));
            for (double& x : nodes_.emplace_back()) {
                if (auto failed = words.real("a coordinate", x)) return failed;
            }
            double ignored = 0;
            for (std::int64_t k = 0; k < more[1] + more[2]; ++k) {
                if (auto failed = words.real("an attribute or a marker", ignored)) return failed;
            }
        }
        if (more[1] > 0 && count > 0)
            drop(data_.findings, data_.losses,
                 {.what = "attributes of nodes", .why = "surfaces take none of them", .count = count, .where = {input.name()}});
        return std::nullopt;
    }

    std::optional<Failure> facets() {
        std::uint64_t count = 0;
        std::int64_t markers = 0;
        if (auto failed = words_.count("facets", 4, count)) return failed;
        if (words_.line_has_more()) {
            if (auto failed = words_.whole("the number of markers", markers)) return failed;
        }
        for (std::uint64_t f = 0; f < count; ++f) {
            if (is_stopped(f)) return stopped(input_);
            if (auto failed = poly_ ? poly_facet(markers > 0) : plain_facet(markers > 0)) return failed;
        }
        return std::nullopt;
    }

    std::optional<Failure> corners(std::vector<std::uint32_t>& polygon) {
        std::uint64_t size = 0;
        if (auto failed = words_.count("corners", 2, size)) return failed;
        polygon.clear();
        for (std::uint64_t k = 0; k < size; ++k) {
            std::int64_t id = 0;
            if (auto failed = words_.whole("a corner", id)) return failed;
            const std::int64_t at = id - first_;
            if (at < 0 || static_cast<std::uint64_t>(at) >= nodes_.size())
                return unreadable("F007", {input_.name(), words_.line()},
                                  "node " + std::to_string(id) + " is not there: they run from " + std::to_string(first_) + " to " +
                                      std::to_string(first_ + static_cast<std::int64_t>(nodes_.size()) - 1));
            polygon.push_back(static_cast<std::uint32_t>(at));
        }
        return std::nullopt;
    }

    std::optional<Failure> plain_facet(bool marked) {
        std::vector<std::uint32_t> polygon;
        std::int64_t marker = 0;
        if (auto failed = corners(polygon)) return failed;
        if (marked && words_.line_has_more()) {
            if (auto failed = words_.whole("the marker of a facet", marker)) return failed;
        }
        add(polygon, marker);
        return std::nullopt;
    }

    std::optional<Failure> poly_facet(bool marked) {
        std::uint64_t polygons = 0;
        std::int64_t holes = 0, marker = 0;
        if (auto failed = words_.count("polygons of a facet", 2, polygons)) return failed;
        if (words_.line_has_more()) {
            if (auto failed = words_.whole("the number of holes of a facet", holes)) return failed;
        }
        if (marked && words_.line_has_more()) {
            if (auto failed = words_.whole("the marker of a facet", marker)) return failed;
        }
        std::vector<std::uint32_t> polygon;
        for (std::uint64_t p = 0; p < polygons; ++p) {
            if (auto failed = corners(polygon)) return failed;
            add(polygon, marker);
        }
        for (std::int64_t h = 0; h < holes; ++h) {
            double ignored = 0;
            for (int k = 0; k < 4; ++k) {
                if (auto failed = words_.real("a number of a hole", ignored)) return failed;
            }
            ++holes_;
        }
        return std::nullopt;
    }

    void add(const std::vector<std::uint32_t>& polygon, std::int64_t marker) {
        if (polygon.size() < 3) {
            drop(data_.findings, data_.losses,
                 {.what = "a polygon of fewer than three corners", .why = "it has no interior", .where = {input_.name(), words_.line()}});
            return;
        }
        Made& made = surfaces_[marker];
        std::vector<std::uint32_t> own;
        for (const std::uint32_t node : polygon) {
            const auto [at, fresh] = made.point_of.try_emplace(node, static_cast<std::uint32_t>(made.surface.points.size()));
            if (fresh) made.surface.points.push_back(nodes_[node]);
            own.push_back(at->second);
        }
        made.surface.polygons.push_back(own);
    }

    /// Points in holes or regions: the list may be missing.
    std::optional<Failure> points_of(const std::string& what, int numbers) {
        const std::string_view word = words_.next();
        if (word.empty()) return std::nullopt;
        std::int64_t count = 0;
        if (parse_integer(word, count) != NumberStatus::ok || count < 0)
            return unreadable("F005", {input_.name(), words_.line()}, "expected the number of " + what + ", found " + shown(word));
        for (std::int64_t i = 0; i < count; ++i) {
            double ignored = 0;
            for (int k = 0; k < numbers; ++k) {
                if (auto failed = words_.real("a number of the points in " + what, ignored)) return failed;
            }
            while (words_.line_has_more()) words_.next();
        }
        if (count > 0)
            drop(data_.findings, data_.losses,
                 {.what = "points in " + what,
                  .why = "what surfaces enclose is found from them",
                  .count = static_cast<std::uint64_t>(count),
                  .where = {input_.name(), words_.line()}});
        return std::nullopt;
    }
};

}  // namespace

int sniff_smesh(std::string_view head, std::string_view base_name) {
    if (!is_poly(base_name) && !lower_case(base_name).ends_with(".smesh")) return 0;
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty() || word.starts_with('#')) continue;
        std::int64_t count = 0;
        return parse_integer(word, count) == NumberStatus::ok ? 80 : 0;
    }
    return 0;
}

Result<Dataset> read_smesh(const Input& input, const ReadOptions& options) {
    auto data = Reader(input, options).run();
    if (!data) return data;
    data->format = "surface";
    data->variant = is_poly(input.base_name()) ? "TetGen .poly" : "TetGen .smesh";
    tell_missing_line_end(input, *data);
    return data;
}

Result<std::vector<Loss>> write_smesh(const Dataset& dataset, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses;
    const auto faces = faces_for_writing(dataset, {.title = "TetGen", .names = true, .polygons = true}, out, losses);
    if (!faces) return faces.why();
    const std::filesystem::path name = out.main_path().filename();
    const bool poly = is_poly((name.extension() == ".gz" ? name.stem() : name).string());
    PositionNumbers numbers;
    std::vector<std::uint32_t> node;
    for (const Vec3& p : faces->points) node.push_back(numbers.number(p));
    OutputFile& file = out.main_file();
    file.number(std::uint64_t{numbers.positions().size()}) << " 3 0 0\n";
    for (std::size_t n = 0; n < numbers.positions().size() && file.good(); ++n) {
        file.number(std::uint64_t{n + 1});
        for (const double x : numbers.positions()[n]) file << ' ', file.number(x);
        file << '\n';
    }
    for (std::size_t s = 0; s < faces->surfaces.size(); ++s) {
        std::string line = faces->surfaces[s].info->name;
        for (char& c : line) c = static_cast<unsigned char>(c) < 32 ? ' ' : c;
        file << "# marker ";
        file.number(std::uint64_t{s + 1}) << ": " << line << '\n';
    }
    file.number(std::uint64_t{faces->polygons.size()}) << " 1\n";
    for (std::size_t s = 0; s < faces->surfaces.size(); ++s) {
        for (std::size_t p = faces->surfaces[s].first_polygon; p < faces->polygon_end(s) && file.good(); ++p) {
            const auto polygon = faces->polygons[p];
            if (poly) {
                file << "1 0 ";
                file.number(std::uint64_t{s + 1}) << '\n';
            }
            file.number(std::uint64_t{polygon.size()});
            for (const std::uint32_t corner : polygon) file << ' ', file.number(std::uint64_t{node[corner]} + 1);
            if (!poly) file << ' ', file.number(std::uint64_t{s + 1});
            file << '\n';
        }
    }
    file << "0\n0\n";
    return losses;
}

}  // namespace geomend::surfaces
