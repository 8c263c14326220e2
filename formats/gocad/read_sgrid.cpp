// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_set>
#include <utility>

#include "formats/gocad/array_codec.h"
#include "formats/gocad/array_object.h"
#include "formats/gocad/array_properties.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_flags.h"
#include "formats/gocad/sgrid_layout.h"

namespace geomend::gocad {

namespace {

class SGridReader {
public:
    explicit SGridReader(ObjectScanner& scanner) : scanner_(scanner), log_(scanner.log), object_(scanner) {}

    Result<void> run() {
        auto whole = object_.read_records([this](std::string_view keyword, TextCursor& line) { return take(keyword, line); });
        if (!whole) return whole;
        if (!counts_.complete(0, scanner_.frame.line, log_)) return {};
        for (std::size_t d = 0; d < 3; ++d) grid_.dims[d] = static_cast<std::uint32_t>(counts_.count[d]);
        const SGridLayout layout(grid_.dims);
        read_points(layout);
        if (scanner_.stopped()) return scanner_.stop();
        if (log_.has_error()) return {};
        read_properties(layout);
        read_node_flags(layout);
        read_regions(layout);
        if (log_.has_error()) return {};
        settle_splits();
        settle_face_sets(layout);
        if (log_.has_error()) return {};
        files_.report_rest();
        grid_.info = std::move(head_.info);
        scanner_.objects.emplace_back(std::move(grid_));
        return {};
    }

private:
    bool take(std::string_view keyword, TextCursor& line) {
        if (take_file_record(keyword, line)) return true;
        if (keyword == "AXIS_N") counts_.take(keyword, line, log_);
        else if (keyword == "SPLIT") read_split(line);
        else if (keyword == "FACE_SET") read_face_set(line);
        else if (keyword == "MODEL_REGION") {
            TextCursor name = line;
            head_.info.annotations.push_back({"gocad.model_region", std::string(name.quoted_token())});
            head_.take_known("REGION", line);
        } else if (keyword == "MODEL_LAYER") keep_layer(line);
        else return false;
        return true;
    }

    bool take_file_record(std::string_view keyword, TextCursor& line) {
        if (keyword == "PROP_ALIGNMENT") cells_by_default_ = same_word(line.token(), "CELLS");
        else if (keyword == "POINTS_FILE") {
            points_.take("FILE", line, log_);
        } else if (keyword == "POINTS_OFFSET") {
            points_.take("OFFSET", line, log_);
        } else if (keyword == "BINARY_POINTS_IN_DOUBLE_PRECISION") {
            double_points_ = line.token() == "1";
        } else if (keyword == "ASCII_DATA_FILE") {
            ascii_file_ = line.quoted_token();
            ascii_line_ = line.line();
        } else if (keyword.starts_with("REGION_FLAGS_")) return region_flags_.take(keyword.substr(13), line, log_);
        else if (keyword.starts_with("FLAGS_")) return node_flags_.take(keyword.substr(6), line, log_);
        else return false;
        return true;
    }

    void read_points(const SGridLayout& layout) {
        if (points_.line == 0) {
            if (ascii_file_.empty())
                log_.add("F012", scanner_.frame.line, 0, "the grid has no points: expected POINTS_FILE or ASCII_DATA_FILE");
            return;
        }
        const ArrayStorage storage = double_points_ ? ArrayStorage::float64 : ArrayStorage::float32;
        const std::uint64_t numbers = 3 * layout.node_count();
        const std::string_view bytes = files_.bytes(points_.file, points_.offset, numbers * element_size(storage), points_.line);
        if (files_.failed()) return;
        const AttributeValues values = decode_array(bytes, storage, numbers);
        grid_.points.resize(layout.node_count());
        std::visit(
            [&](const auto& v) {
                if constexpr (std::is_arithmetic_v<typename std::decay_t<decltype(v)>::value_type>) {
                    for (std::size_t i = 0; i < numbers; ++i) grid_.points[i / 3][i % 3] = static_cast<double>(v[i]);
                }
            },
            values);
        for (std::size_t i = 0; i < grid_.points.size(); ++i) {
            const Vec3& p = grid_.points[i];
            if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
            log_.add(
                "F006", points_.line, 0,
                [&] { return "the file " + points_.file + ": point " + std::to_string(i) + " (from 0) is not finite"; }, "points",
                static_cast<std::int64_t>(i));
        }
        if (head_.depth()) {
            for (Vec3& p : grid_.points) p[2] = -p[2];
        }
    }

    void read_properties(const SGridLayout& layout) {
        ArrayPlace place;
        place.dims = grid_.dims;
        place.cells = layout.cell_count();
        place.cells_by_default = cells_by_default_;
        place.ascii_file = ascii_file_;
        place.ascii_line = ascii_line_;
        // The rows of a text file begin with X Y Z whether or not the points stand in a file of their own.
        place.ascii_positions = !ascii_file_.empty();
        std::vector<Vec3> positions;
        head_.info.attributes =
            read_array_properties(std::move(properties_.properties), place, files_, scanner_, grid_.points.empty() ? &positions : nullptr);
        if (!grid_.points.empty() || log_.has_error()) return;
        grid_.points = std::move(positions);
        if (head_.depth()) {
            for (Vec3& p : grid_.points) p[2] = -p[2];
        }
    }

    // Flags that follow from the place in the grid are made anew when written; others go along.
    void read_node_flags(const SGridLayout& layout) {
        if (node_flags_.line == 0 || log_.has_error()) return;
        if (node_flags_.entry_size == 0) node_flags_.entry_size = 4;
        const std::string_view entries = flag_entries(node_flags_, layout.node_count(), files_, log_);
        if (log_.has_error()) return;
        if (node_flags_.entry_size != 4) {
            if (auto bits = other_bits(entries, node_flags_.entry_size, {}, "gocad_flags", [](std::uint64_t) { return 0u; })) {
                head_.info.attributes.push_back(std::move(*bits));
            }
            return;
        }
        auto values = std::get<std::vector<std::uint32_t>>(decode_array(entries, ArrayStorage::uint32, layout.node_count()));
        bool usual = true;
        for (std::uint64_t node = 0; usual && node < values.size(); ++node) usual = values[node] == layout.node_flags(node);
        if (usual) return;
        Attribute a;
        a.name = "gocad_flags";
        a.values = std::move(values);
        a.annotations.emplace_back(flags_annotation, "flags of nodes");
        head_.info.attributes.push_back(std::move(a));
    }

    void read_regions(const SGridLayout& layout) {
        if (log_.has_error()) return;
        if (region_flags_.line == 0) return object_.keep_region_records("cells");
        const std::string_view entries = flag_entries(region_flags_, layout.node_count(), files_, log_);
        if (log_.has_error()) return;
        const auto thing = [&](std::uint64_t node) { return layout.cell_of_node(node); };
        read_region_bits(entries, region_flags_.entry_size, head_.regions, region_flags_.line, log_, thing);
        if (log_.has_error()) return;
        if (auto rest = other_bits(entries, region_flags_.entry_size, head_.regions, "gocad_region_flags", thing)) {
            head_.info.attributes.push_back(std::move(*rest));
        }
        for (RegionBit& region : head_.regions) {
            if (region.name == dead_cells_region) {
                grid_.dead_cells.assign(layout.cell_count(), 0);
                for (const std::uint32_t cell : region.members) grid_.dead_cells[cell] = 1;
                continue;
            }
            head_.info.annotations.push_back({"gocad.region_bit", std::to_string(region.bit) + ' ' + region.name});
            head_.info.sets.push_back({std::move(region.name), AttributeLocation::cell, std::move(region.members)});
        }
    }

    // `SPLIT i j k x y z id b0 ... b7`
    void read_split(TextCursor& line) {
        StructuredGrid::Split split;
        std::array<std::int64_t, 3> node{};
        bool good = true;
        for (std::int64_t& n : node) good = good && line.integer(n) == NumberStatus::ok && n >= 0 && n < no_index;
        for (double& c : split.position) good = good && line.real(c) == NumberStatus::ok;
        good = good && line.integer(split.id) == NumberStatus::ok;
        std::uint32_t cells = 0;
        for (std::uint32_t bit = 0; good && bit < 8; ++bit) {
            const std::string_view flag = line.token();
            good = flag == "0" || flag == "1";
            if (flag == "1") cells |= 1u << bit;
        }
        if (!good) {
            log_.add("F012", line.line(), 0, "SPLIT: expected i j k x y z, an id and eight times 0 or 1");
            return;
        }
        for (const double c : split.position) {
            if (!std::isfinite(c)) log_.add("F006", line.line(), 0, "SPLIT: the position is not finite");
        }
        for (std::size_t d = 0; d < 3; ++d) split.node[d] = static_cast<std::uint32_t>(node[d]);
        split.cells = static_cast<std::uint8_t>(cells);
        grid_.splits.push_back(split);
        split_lines_.push_back(line.line());
    }

    void settle_splits() {
        for (std::size_t s = 0; s < grid_.splits.size(); ++s) {
            StructuredGrid::Split& split = grid_.splits[s];
            if (head_.depth()) split.position[2] = -split.position[2];
            for (std::size_t d = 0; d < 3; ++d) {
                if (split.node[d] < grid_.dims[d]) continue;
                log_.add("F007", split_lines_[s], 0, "SPLIT: the node is outside of the grid", "SPLIT");
            }
        }
    }

    // `FACE_SET name count`, then count pairs of node id and direction over any number of lines.
    void read_face_set(TextCursor& line) {
        StructuredGrid::FaceSet set;
        set.name = line.quoted_token();
        std::int64_t count = 0;
        const std::uint64_t first_line = line.line();
        if (set.name.empty() || line.integer(count) != NumberStatus::ok || count < 0) {
            log_.add("F012", line.line(), 0, "FACE_SET: expected a name and a count");
            return;
        }
        while (static_cast<std::int64_t>(set.faces.size()) < count) {
            if (line.at_line_end()) {
                if (line.next_line()) continue;
                log_.add("F008", first_line, 0, [&] {
                    return "FACE_SET " + set.name + ": expected " + std::to_string(count) + " faces, found " +
                           std::to_string(set.faces.size());
                });
                return;
            }
            std::int64_t node = 0, direction = 0;
            if (line.integer(node) != NumberStatus::ok || line.integer(direction) != NumberStatus::ok || node < 0 || node >= no_index ||
                direction < 0 || direction > 2) {
                log_.add("F012", line.line(), 0, [&] {
                    return "FACE_SET " + set.name + ": expected a node id and a direction (0, 1 or 2); " + std::to_string(count) +
                           " faces are announced, " + std::to_string(set.faces.size()) + " were found";
                });
                return;
            }
            set.faces.push_back({static_cast<std::uint32_t>(node), static_cast<std::uint32_t>(direction)});
        }
        grid_.face_sets.push_back(std::move(set));
        face_set_lines_.push_back(first_line);
    }

    void settle_face_sets(const SGridLayout& layout) {
        std::unordered_set<std::int64_t> split_ids;
        for (const StructuredGrid::Split& split : grid_.splits) split_ids.insert(split.id);
        for (std::size_t s = 0; s < grid_.face_sets.size(); ++s) {
            for (const auto& [node, direction] : grid_.face_sets[s].faces) {
                if (node < layout.node_count() || split_ids.contains(node)) continue;
                log_.add(
                    "F007", face_set_lines_[s], 0, [&] { return "FACE_SET: there is no node " + std::to_string(node); }, "FACE_SET", node);
            }
        }
    }

    // `MODEL_LAYER region ... END`: the list may run over several lines.
    void keep_layer(TextCursor& line) {
        std::string record(trimmed(line.line_text()));
        const auto ends = [](std::string_view text) {
            const std::size_t blank = text.find_last_of(" \t");
            return same_word(blank == std::string_view::npos ? text : text.substr(blank + 1), "END");
        };
        while (!ends(record)) {
            if (!line.next_line()) {
                log_.add("F004", line.line(), 0, "MODEL_LAYER: expected END before the end of the object");
                return;
            }
            record += ' ';
            record += trimmed(line.line_text());
        }
        head_.info.annotations.push_back({"gocad.model_layer", std::move(record)});
    }

    ObjectScanner& scanner_;
    ObjectLog& log_;
    ArrayObject object_;
    ObjectHead& head_ = object_.head;
    CompanionFiles& files_ = object_.files;
    LatticeAxes& counts_ = object_.axes;
    IndexedPropertyList& properties_ = object_.properties;
    StructuredGrid grid_;
    FlagsRecords points_, node_flags_, region_flags_;
    bool cells_by_default_ = false, double_points_ = false;
    std::string ascii_file_;
    std::uint64_t ascii_line_ = 0;
    std::vector<std::uint64_t> split_lines_, face_set_lines_;
};

}  // namespace

/// SGrid: a curvilinear grid with points and properties in companion files.
Result<void> read_sgrid(ObjectScanner& scanner) { return SGridReader(scanner).run(); }

}  // namespace geomend::gocad
