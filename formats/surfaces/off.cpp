// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/off.h"

#include <algorithm>

#include "formats/drop.h"
#include "formats/surfaces/faces_writing.h"
#include "formats/text_reading.h"

namespace geomend::surfaces {

namespace {

constexpr std::array<std::string_view, 4> first_words{"OFF", "COFF", "NOFF", "CNOFF"};

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options) : input_(input), options_(options), cursor_(text_of(input)) {}

    Result<Dataset> run() {
        if (!next_line()) return end_of_file("OFF");
        const std::string_view first = cursor_.token();
        if (std::ranges::none_of(first_words, [&](std::string_view word) { return word == first; }))
            return unreadable("F012", {input_.name(), cursor_.line(), 1}, "expected OFF, COFF, NOFF or CNOFF, found " + shown(first));
        if (!has_more() && !next_line()) return end_of_file("the numbers of points, polygons and edges");
        std::array<std::uint64_t, 3> counts{};
        for (std::size_t k = 0; k < 3; ++k) {
            if (k == 2 && !has_more()) break;  // the number of edges says nothing
            if (auto failed = whole(cursor_.token(), counts[k])) return std::move(*failed);
        }
        // A point takes 6 bytes and a polygon of three corners 8 at least.
        if (counts[0] >= no_index || 6 * counts[0] + 8 * counts[1] > input_.bytes().size() + 16)
            return unreadable("F014", {input_.name(), cursor_.line()},
                              "the header asks for " + std::to_string(counts[0]) + " points and " + std::to_string(counts[1]) +
                                  " polygons, more than the file can hold");
        if (auto failed = points(counts[0])) return std::move(*failed);
        if (auto failed = polygons(counts[1])) return std::move(*failed);
        if (looks_ > 0) list_dropped(data_.losses, {LossClass::style, "", "colours and normals", "they say how things look", looks_});
        if (next_line())
            drop(data_.findings, data_.losses,
                 {.what = "what follows the last polygon",
                  .why = "the header states no more",
                  .where = {input_.name(), cursor_.line()},
                  .code = "F107"});
        surface_.info.name = name_of(input_);
        data_.objects.emplace_back(std::move(surface_));
        return std::move(data_);
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    TextCursor cursor_;
    Surface surface_;
    Dataset data_;
    std::uint64_t looks_ = 0;

    /// To the next line with something on it before a '#'.
    bool next_line() {
        while (cursor_.next_line()) {
            if (!cursor_.at_line_end() && !cursor_.peek_rest().starts_with('#')) return true;
        }
        return false;
    }
    bool is_stopped() const {
        constexpr std::uint64_t often = 16384;
        return cursor_.line() % often == 0 && options_.monitor != nullptr && options_.monitor->stopped();
    }
    Failure end_of_file(const std::string& expected) const {
        return unreadable("F004", {input_.name(), cursor_.line()}, "expected " + expected + ", found the end of the file");
    }
    std::optional<Failure> whole(std::string_view token, std::uint64_t& to) const {
        std::int64_t n = 0;
        if (parse_integer(token, n) != NumberStatus::ok || n < 0)
            return unreadable("F005", location_of(input_, cursor_, token), "expected a whole number of at least 0, found " + shown(token));
        to = static_cast<std::uint64_t>(n);
        return std::nullopt;
    }
    bool has_more() { return !cursor_.at_line_end() && !cursor_.peek_rest().starts_with('#'); }

    std::optional<Failure> points(std::uint64_t count) {
        surface_.points.reserve(count);
        while (surface_.points.size() < count) {
            if (!next_line())
                return end_of_file(std::to_string(count) + " points (there were " + std::to_string(surface_.points.size()) + ")");
            if (is_stopped()) return stopped(input_);
            for (double& x : surface_.points.emplace_back()) {
                if (auto failed = finite_number(input_, cursor_, cursor_.token(), "a coordinate", x)) return failed;
            }
            looks_ += has_more() ? 1 : 0;
        }
        return std::nullopt;
    }

    std::optional<Failure> polygons(std::uint64_t count) {
        std::vector<std::uint32_t> polygon;
        for (std::uint64_t p = 0; p < count; ++p) {
            if (!next_line()) return end_of_file(std::to_string(count) + " polygons (there were " + std::to_string(p) + ")");
            if (is_stopped()) return stopped(input_);
            std::uint64_t size = 0;
            if (auto failed = whole(cursor_.token(), size)) return failed;
            polygon.clear();
            for (std::uint64_t k = 0; k < size; ++k) {
                const std::string_view token = cursor_.token();
                std::uint64_t corner = 0;
                if (auto failed = whole(token, corner)) return failed;
                if (corner >= surface_.points.size())
                    return unreadable("F007", location_of(input_, cursor_, token),
                                      "point " + std::to_string(corner) + " is not there: they run from 0 to " +
                                          std::to_string(static_cast<std::int64_t>(surface_.points.size()) - 1));
                polygon.push_back(static_cast<std::uint32_t>(corner));
            }
            looks_ += has_more() ? 1 : 0;
            if (size >= 3) surface_.polygons.push_back(polygon);
            else
                drop(data_.findings, data_.losses,
                     {.what = "a polygon of fewer than three corners",
                      .why = "it has no interior",
                      .where = {input_.name(), cursor_.line()}});
        }
        return std::nullopt;
    }
};

}  // namespace

int sniff_off(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty() || word.starts_with('#')) continue;
        if (std::ranges::find(first_words, word) == first_words.end()) return 0;
        std::int64_t n = 0;
        return cursor.at_line_end() || cursor.integer(n) == NumberStatus::ok ? 85 : 0;
    }
    return 0;
}

Result<Dataset> read_off(const Input& input, const ReadOptions& options) {
    auto data = Reader(input, options).run();
    if (!data) return data;
    data->format = "surface";
    data->variant = "OFF";
    tell_missing_line_end(input, *data);
    return data;
}

Result<std::vector<Loss>> write_off(const Dataset& dataset, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses;
    const auto faces = faces_for_writing(dataset, {.title = "OFF", .polygons = true}, out, losses);
    if (!faces) return faces.why();
    OutputFile& file = out.main_file();
    file << "OFF\n";
    file.number(std::uint64_t{faces->points.size()}) << ' ';
    file.number(std::uint64_t{faces->polygons.size()}) << " 0\n";
    for (const Vec3& p : faces->points) {
        file.number(p[0]) << ' ';
        file.number(p[1]) << ' ';
        file.number(p[2]) << '\n';
    }
    for (std::size_t p = 0; p < faces->polygons.size() && file.good(); ++p) {
        const auto polygon = faces->polygons[p];
        file.number(std::uint64_t{polygon.size()});
        for (const std::uint32_t corner : polygon) {
            file << ' ';
            file.number(std::uint64_t{corner});
        }
        file << '\n';
    }
    if (faces->surfaces.size() > 1)
        add_loss(losses, {LossClass::identity, "", "which polygons make a surface", "OFF holds one surface", faces->surfaces.size()});
    return losses;
}

}  // namespace geomend::surfaces
